// SPDX-License-Identifier: BSD-3-Clause
#ifndef Gdal_h
#define Gdal_h

#include <string>

namespace reliefshade
{

/// While one lives, GDAL prints nothing: the first failure is kept for Take().
class GdalErrors
{
public:
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  void operator=(const GdalErrors&) = delete;

  /// The failure, or what to say if GDAL gave no reason; it is forgotten then.
  static std::string Take(const std::string& otherwise);
  static bool Any();
};

}

#endif
