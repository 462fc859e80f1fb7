# Compiles headers that most files include once for all of them, which halves the time of a build. Not for the first
# build of all: that one shows that every file includes what it needs.
#   cmake -DCMAKE_PROJECT_INCLUDE="$PWD/.ci/precompile.cmake" ...
function (relief_list_targets directory result)
  get_property(found DIRECTORY "${directory}" PROPERTY BUILDSYSTEM_TARGETS)
  get_property(below DIRECTORY "${directory}" PROPERTY SUBDIRECTORIES)
  foreach (folder IN LISTS below)
    relief_list_targets("${folder}" more)
    list(APPEND found ${more})
  endforeach ()
  set("${result}" ${found} PARENT_SCOPE)
endfunction ()

# A header is compiled for each way of compiling, here by what the code may be linked into, by a target that is
# nothing else.
function (relief_precompile name independent)
  file(WRITE "${CMAKE_BINARY_DIR}/precompiled/${name}.cxx" "")
  add_library(${name} OBJECT "${CMAKE_BINARY_DIR}/precompiled/${name}.cxx")
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE "${independent}")
  target_link_libraries(${name} PRIVATE VTK::CommonExecutionModel VTK::RenderingCore)
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <cmath> <functional> <limits> <map> <memory> <mutex> <optional> <sstream> <string> <vector>
    <vtkCommand.h> <vtkDoubleArray.h> <vtkFloatArray.h> <vtkImageAlgorithm.h> <vtkImageData.h> <vtkInformation.h>
    <vtkInformationVector.h> <vtkNew.h> <vtkPointData.h> <vtkSMPTools.h> <vtkSmartPointer.h>
    <vtkStreamingDemandDrivenPipeline.h> <vtkUnsignedCharArray.h>)
endfunction ()

function (relief_precompile_all)
  relief_precompile(relief_precompiled_shared ON)
  relief_precompile(relief_precompiled_programs OFF)
  relief_list_targets("${CMAKE_SOURCE_DIR}" targets)
  foreach (target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if (target MATCHES "^(ReliefModel|reliefModelTests|ReliefHard.*|relief_precompiled.*)$")
      continue () # without VTK
    elseif (type STREQUAL "SHARED_LIBRARY" OR type STREQUAL "MODULE_LIBRARY")
      target_precompile_headers(${target} REUSE_FROM relief_precompiled_shared)
    elseif (type STREQUAL "EXECUTABLE" AND target MATCHES "Tests$")
      target_precompile_headers(${target} REUSE_FROM relief_precompiled_programs)
    endif ()
  endforeach ()
endfunction ()

cmake_language(DEFER DIRECTORY "${CMAKE_SOURCE_DIR}" CALL relief_precompile_all)
