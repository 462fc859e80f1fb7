// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefRefresher.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"

//------------------------------------------------------------------------------
ReliefRefresher::~ReliefRefresher()
{
  this->Forget();
}

//------------------------------------------------------------------------------
void ReliefRefresher::Forget()
{
  if (this->Interactor)
  {
    this->Interactor->RemoveObserver(this->Observer);
    if (this->Timer)
    {
      this->Interactor->DestroyTimer(this->Timer);
    }
  }
  this->Interactor = nullptr;
  this->Timer = 0;
}

//------------------------------------------------------------------------------
void ReliefRefresher::Follow(vtkRenderWindowInteractor* interactor)
{
  this->Forget();
  this->Interactor = interactor;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(this);
  command->SetCallback(&ReliefRefresher::OnTimer);
  // Before the interactor's style, which would take the timer for its own.
  this->Observer = interactor->AddObserver(vtkCommand::TimerEvent, command, 1.0f);
  // Interactors that are embedded in another toolkit need not have timers.
  const int timer = interactor->CreateOneShotTimer(1000000);
  this->HasTimers = timer != 0;
  if (timer)
  {
    interactor->DestroyTimer(timer);
  }
}

//------------------------------------------------------------------------------
bool ReliefRefresher::CanAsk(vtkRenderWindow* window)
{
  vtkRenderWindowInteractor* interactor = window->GetInteractor();
  if (!interactor || !interactor->GetInitialized() || !interactor->GetEnabled())
  {
    return false;
  }
  if (this->Interactor != interactor)
  {
    this->Follow(interactor);
  }
  return this->HasTimers;
}

//------------------------------------------------------------------------------
void ReliefRefresher::Ask(vtkRenderWindow* window)
{
  if (this->CanAsk(window))
  {
    // One that has been asked for before may have passed unseen: while somebody holds the
    // interactor's focus, as a dragged dot does, nobody else hears of timers.
    if (this->Timer)
    {
      this->Interactor->DestroyTimer(this->Timer);
    }
    this->Timer = this->Interactor->CreateOneShotTimer(1);
  }
}

//------------------------------------------------------------------------------
void ReliefRefresher::OnTimer(vtkObject*, unsigned long, void* data, void* timer)
{
  auto* self = static_cast<ReliefRefresher*>(data);
  if (!self->Timer || !timer || *static_cast<int*>(timer) != self->Timer)
  {
    return;
  }
  self->Timer = 0;
  if (vtkRenderWindow* window = self->Interactor->GetRenderWindow())
  {
    window->Render();
  }
}
