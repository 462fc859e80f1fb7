// SPDX-License-Identifier: BSD-3-Clause
#ifndef Provenance_h
#define Provenance_h

#include <map>
#include <string>

class vtkImageReliefShading;

namespace reliefshade
{

/// What headers say of how a picture was made, by GDAL's names of metadata: the program, the
/// model's version, the tolerance, a hash of the heights, and what verify() returned, unless it is
/// empty.
std::map<std::string, std::string> provenance(
  vtkImageReliefShading* shading, const std::string& verified);

}

#endif
