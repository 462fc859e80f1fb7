// SPDX-License-Identifier: BSD-3-Clause
#ifndef FuzzMessages_h
#define FuzzMessages_h

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"

/// Counts the errors that VTK's classes report while it lives, and keeps them from being printed.
class FuzzMessages
{
public:
  FuzzMessages()
  {
    this->Window->Errors = 0;
    vtkOutputWindow::SetInstance(this->Window);
  }
  ~FuzzMessages() { vtkOutputWindow::SetInstance(nullptr); }
  FuzzMessages(const FuzzMessages&) = delete;
  void operator=(const FuzzMessages&) = delete;

  int Count() const { return this->Window->Errors; }

private:
  class vtkCounter : public vtkOutputWindow
  {
  public:
    static vtkCounter* New() { VTK_STANDARD_NEW_BODY(vtkCounter); }
    void DisplayText(const char*) override {}
    void DisplayErrorText(const char*) override { ++this->Errors; }
    void DisplayWarningText(const char*) override {}
    void DisplayGenericWarningText(const char*) override {}
    void DisplayDebugText(const char*) override {}
    int Errors = 0;
  };
  vtkNew<vtkCounter> Window;
};

#endif
