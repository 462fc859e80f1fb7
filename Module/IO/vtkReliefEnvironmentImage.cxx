// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefEnvironmentImage.h"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkReliefEnvironment.h"

#include "EnvironmentPicture.h"
#include "FileGuard.h"

vtkStandardNewMacro(vtkReliefEnvironmentImage);

//------------------------------------------------------------------------------
bool vtkReliefEnvironmentImage::Read(vtkReliefEnvironment* environment, const char* fileName)
{
  if (!environment)
  {
    vtkGenericWarningMacro(
      "vtkReliefEnvironmentImage::Read: null was given, a vtkReliefEnvironment "
      "is expected; nothing is read.");
    return false;
  }
  const std::string reason = vtkReliefEnvironmentImage::TryToRead(environment, fileName);
  if (!reason.empty())
  {
    vtkErrorWithObjectMacro(environment,
      "Cannot read \"" << relief::io::Shortened(fileName ? fileName : "", relief::io::LongestName)
                       << "\": " << relief::io::Brief(reason) << "; the old image is kept.");
  }
  return reason.empty();
}

//------------------------------------------------------------------------------
std::string vtkReliefEnvironmentImage::TryToRead(
  vtkReliefEnvironment* environment, const char* fileName)
{
  if (!environment)
  {
    return "there is no environment for it";
  }
  const relief::io::EnvironmentPicture picture =
    relief::io::ReadEnvironmentPicture(fileName ? fileName : "");
  if (picture.Image)
  {
    environment->SetImage(picture.Image);
    environment->SetFileName(fileName);
  }
  return picture.Reason;
}
