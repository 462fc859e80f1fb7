# Compiles headers that most files include once for all of them, which halves the time of a build. Each file includes
# what it needs all the same: .ci/full builds without this, and .ci/style reads files without it.
function (relief_list_targets directory result)
  get_property(found DIRECTORY "${directory}" PROPERTY BUILDSYSTEM_TARGETS)
  get_property(below DIRECTORY "${directory}" PROPERTY SUBDIRECTORIES)
  foreach (folder IN LISTS below)
    relief_list_targets("${folder}" more)
    list(APPEND found ${more})
  endforeach ()
  set("${result}" ${found} PARENT_SCOPE)
endfunction ()

# Headers are compiled for each way of compiling, here by what the code may be linked into, by a target that is
# nothing else.
function (relief_precompile name independent)
  file(WRITE "${PROJECT_BINARY_DIR}/precompiled/${name}.cxx" "")
  add_library(${name} OBJECT "${PROJECT_BINARY_DIR}/precompiled/${name}.cxx")
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE "${independent}")
  target_link_libraries(${name} PRIVATE VTK::CommonExecutionModel)
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <cmath> <functional> <limits> <map> <memory> <mutex> <optional> <sstream> <string> <vector>
    <vtkCommand.h> <vtkDoubleArray.h> <vtkFloatArray.h> <vtkImageAlgorithm.h> <vtkImageData.h> <vtkInformation.h>
    <vtkInformationVector.h> <vtkNew.h> <vtkPointData.h> <vtkSMPTools.h> <vtkSmartPointer.h>
    <vtkStreamingDemandDrivenPipeline.h> <vtkUnsignedCharArray.h>)
endfunction ()

relief_list_targets("${PROJECT_SOURCE_DIR}" relief_targets)
relief_precompile(relief_precompiled_shared ON)
relief_precompile(relief_precompiled_programs OFF)
foreach (target IN LISTS relief_targets)
  get_target_property(type ${target} TYPE)
  get_target_property(libraries ${target} LINK_LIBRARIES)
  if (target STREQUAL reliefModelTests)
    target_precompile_headers(reliefModelTests PRIVATE
      <algorithm> <cmath> <functional> <limits> <random> <string> <vector> <glm/common.hpp> <glm/geometric.hpp>
      <gtest/gtest.h>)
  elseif (NOT libraries MATCHES "VTK::")
    continue ()
  elseif (target MATCHES "^(reliefshadeRanks|reliefviewer|TestViewer.*)$")
    continue () # compiled in a way of its own, by what MPI and Qt ask for
  elseif (type STREQUAL "SHARED_LIBRARY" OR type STREQUAL "MODULE_LIBRARY" OR target STREQUAL reliefviewerParts)
    target_precompile_headers(${target} REUSE_FROM relief_precompiled_shared)
  elseif (type STREQUAL "EXECUTABLE" OR target STREQUAL reliefshadeFiles)
    target_precompile_headers(${target} REUSE_FROM relief_precompiled_programs)
  endif ()
endforeach ()
