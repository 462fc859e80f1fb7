# What a wheel needs beside what every build has: pyproject.toml builds it, upon VTK's SDK.

# The libraries of VTK's wheel lie beside the package.
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../vtkmodules")

# Linux has two kinds of std::string. VTK's wheels have the old one, where the compiler's default is the
# new one: asked is which one VTK's libraries were built with, by linking a function that takes a string.
if (UNIX AND NOT APPLE)
  set(string_probe "${CMAKE_BINARY_DIR}/CMakeFiles/StringProbe.cxx")
  file(WRITE "${string_probe}"
    "#include <vtksys/SystemTools.hxx>\nint main() { return vtksys::SystemTools::FileExists(std::string(\"a\")); }\n")
  foreach (kind IN ITEMS 1 0)
    try_compile(RELIEFSHADING_STRINGS_${kind} "${CMAKE_BINARY_DIR}/CMakeFiles/StringProbe${kind}" "${string_probe}"
      COMPILE_DEFINITIONS "-D_GLIBCXX_USE_CXX11_ABI=${kind}"
      LINK_LIBRARIES VTK::vtksys
      OUTPUT_VARIABLE string_output
      CXX_STANDARD 17)
    if (RELIEFSHADING_STRINGS_${kind})
      set(string_kind ${kind})
      break ()
    endif ()
  endforeach ()
  if (NOT DEFINED string_kind)
    message(FATAL_ERROR "Nothing can be linked with VTK's libraries:\n${string_output}")
  endif ()
  message(STATUS "VTK was built with _GLIBCXX_USE_CXX11_ABI=${string_kind}")
  add_compile_definitions("_GLIBCXX_USE_CXX11_ABI=${string_kind}")
endif ()

# Highway's library comes along: no other wheel has it.
get_target_property(highway_type hwy::hwy TYPE)
if (highway_type STREQUAL "SHARED_LIBRARY")
  install(FILES "$<TARGET_FILE:hwy::hwy>"
    DESTINATION "${CMAKE_INSTALL_LIBDIR}" RENAME "$<TARGET_SONAME_FILE_NAME:hwy::hwy>" COMPONENT runtime)
endif ()
