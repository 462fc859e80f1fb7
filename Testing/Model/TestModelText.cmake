# Compiles the model's text as GLSL 1.50. Run as a script, with
#   VALIDATOR    glslangValidator
#   HOST         TestModelText.frag
#   MODEL        the directory of the model
#   OUTPUT       where to write the whole shader
file(READ "${MODEL}/ReliefPreludeGLSL.glsl" prelude)

# The texts that C++ includes, in the order in which it does.
file(STRINGS "${MODEL}/ReliefModel.h" includes REGEX "^#include \"[A-Za-z]+\\.glsl\"")
list(REMOVE_DUPLICATES includes)
set(model)
foreach (include IN LISTS includes)
  string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" name "${include}")
  file(READ "${MODEL}/${name}" text)
  string(APPEND model "${text}")
endforeach ()
if (NOT model)
  message(FATAL_ERROR "ReliefModel.h includes no GLSL")
endif ()

file(READ "${HOST}" shader)
string(REPLACE "//RELIEF::Prelude" "${prelude}" shader "${shader}")
string(REPLACE "//RELIEF::Model" "${model}" shader "${shader}")
file(WRITE "${OUTPUT}" "${shader}")
execute_process(COMMAND "${VALIDATOR}" "${OUTPUT}" RESULT_VARIABLE result)
if (result)
  message(FATAL_ERROR "The model is not valid GLSL 1.50")
endif ()
