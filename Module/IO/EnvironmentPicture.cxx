// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPicture.h"

#include "vtkCallbackCommand.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenImageIOReader.h"

namespace relief::io
{
//------------------------------------------------------------------------------
EnvironmentPicture ReadEnvironmentPicture(const std::string& fileName)
{
  vtkNew<vtkOpenImageIOReader> reader;
  vtkNew<vtkCallbackCommand> silence; // whoever asks reports it, in his own name
  reader->AddObserver(vtkCommand::ErrorEvent, silence);
  reader->SetFileName(fileName.c_str());
  reader->Update();
  if (reader->GetErrorCode() != vtkErrorCode::NoError)
  {
    return { nullptr, reader->GetErrorReason() };
  }
  return { reader->GetOutput(), std::string() };
}
}
