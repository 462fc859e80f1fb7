# Installs BUILD_DIRECTORY somewhere and moves the result to PREFIX: nothing in it may depend on where
# it was installed.
set(first "${PREFIX}-before-the-move")
file(REMOVE_RECURSE "${first}" "${PREFIX}")
set(configuration)
if (CONFIGURATION)
  set(configuration --config "${CONFIGURATION}")
endif ()
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIRECTORY}" --prefix "${first}" ${configuration}
  RESULT_VARIABLE result)
if (NOT result EQUAL 0)
  message(FATAL_ERROR "cmake --install failed")
endif ()
file(RENAME "${first}" "${PREFIX}")
