// SPDX-License-Identifier: BSD-3-Clause
#ifndef VtkStep_h
#define VtkStep_h

#include <functional>

class vtkAlgorithm;

namespace relief::raster
{
/// Runs a step of one of VTK's readers or writers. What it reports, itself or its executive, is not
/// printed; it is thrown as a Failure with the reader's or writer's code.
void RunVtkStep(vtkAlgorithm* algorithm, const std::function<void()>& step);
}

#endif
