// SPDX-License-Identifier: BSD-3-Clause
#ifndef DrawingPicture_h
#define DrawingPicture_h

#include "vtkSmartPointer.h"

class vtkImageData;

namespace reliefshade
{

struct Drawing;

/// Paints a drawing on white, as 8-bit red, green and blue. No window is opened.
vtkSmartPointer<vtkImageData> paint(const Drawing& drawing);

}

#endif
