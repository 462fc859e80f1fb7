// SPDX-License-Identifier: BSD-3-Clause
#include "VtkStep.h"

#include "FileGuard.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

namespace relief::raster
{
namespace
{
/// The first message that comes, without what vtkErrorMacro puts before and behind it.
void KeepFirst(vtkObject*, unsigned long, void* kept, void* message)
{
  auto& text = *static_cast<std::string*>(kept);
  if (text.empty() && message)
  {
    text = static_cast<const char*>(message);
    const std::size_t begin = text.find("): ");
    text.erase(0, begin == std::string::npos ? 0 : begin + 3);
  }
}

//------------------------------------------------------------------------------
/// Keeps the first message of one kind while it lives: a step may throw, and the objects live on.
class Keeper
{
public:
  Keeper(vtkAlgorithm* algorithm, unsigned long event)
    : Objects{ algorithm, algorithm->GetExecutive() }
  {
    this->Command->SetCallback(&KeepFirst);
    this->Command->SetClientData(&this->Text);
    for (vtkObject* object : this->Objects)
    {
      object->AddObserver(event, this->Command);
    }
  }
  ~Keeper()
  {
    for (vtkObject* object : this->Objects)
    {
      object->RemoveObserver(this->Command);
    }
  }
  Keeper(const Keeper&) = delete;
  void operator=(const Keeper&) = delete;

  std::string Text;

private:
  vtkSmartPointer<vtkObject> Objects[2];
  vtkNew<vtkCallbackCommand> Command;
};
}

//------------------------------------------------------------------------------
void RunVtkStep(vtkAlgorithm* algorithm, const std::function<void()>& step)
{
  const Keeper errors(algorithm, vtkCommand::ErrorEvent);
  const Keeper warnings(algorithm, vtkCommand::WarningEvent); // only kept from being printed
  step();
  std::string error = errors.Text;
  const unsigned long code = algorithm->GetErrorCode();
  if (error.empty() && code != vtkErrorCode::NoError)
  {
    error = vtkErrorCode::GetStringFromErrorCode(code);
  }
  if (!error.empty())
  {
    throw io::Failure(
      code == vtkErrorCode::NoError ? vtkErrorCode::FileFormatError : code, io::OneLine(error));
  }
}
}
