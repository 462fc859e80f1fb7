// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefMessages_h
#define vtkReliefMessages_h

/// @file
/// Keeps an object's first error, for another one to report. Private to the module.

#include "vtkCommand.h"

#include <string>

class vtkReliefFirstMessage : public vtkCommand
{
public:
  static vtkReliefFirstMessage* New() { return new vtkReliefFirstMessage; }
  vtkTypeMacro(vtkReliefFirstMessage, vtkCommand);

  /// The text without what vtkErrorMacro puts before and behind it.
  void Execute(vtkObject*, unsigned long, void* data) override
  {
    if (this->Text.empty())
    {
      this->Text = static_cast<const char*>(data);
      const std::size_t begin = this->Text.find("): ");
      this->Text.erase(0, begin == std::string::npos ? 0 : begin + 3);
      this->Text.erase(this->Text.find_last_not_of(" \n") + 1);
    }
  }

  std::string Text;
};

#endif
