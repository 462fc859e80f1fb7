// SPDX-License-Identifier: BSD-3-Clause
#include "Gdal.h"

#include <cpl_error.h>
#include <gdal.h>

namespace
{

std::string firstFailure;

void CPL_STDCALL keepFailure(CPLErr severity, CPLErrorNum, const char* message)
{
  if (severity >= CE_Failure && firstFailure.empty())
  {
    firstFailure = message;
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
GdalErrors::GdalErrors()
{
  if (GDALGetDriverCount() == 0)
  {
    GDALAllRegister();
    // GDAL takes over libtiff's messages too, of OpenImageIO's files as well, and would print them.
    CPLSetErrorHandler(CPLQuietErrorHandler);
  }
  firstFailure.clear();
  CPLPushErrorHandler(keepFailure);
}

//------------------------------------------------------------------------------
GdalErrors::~GdalErrors()
{
  CPLPopErrorHandler();
}

//------------------------------------------------------------------------------
bool GdalErrors::Any()
{
  return !firstFailure.empty();
}

//------------------------------------------------------------------------------
std::string GdalErrors::Take(const std::string& otherwise)
{
  std::string text;
  text.swap(firstFailure);
  return text.empty() ? otherwise : text;
}

}
