// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefRefresher_h
#define ReliefRefresher_h

#include "vtkWeakPointer.h"

class vtkCallbackCommand;
class vtkObject;
class vtkRenderWindow;
class vtkRenderWindowInteractor;

/// Asks a window's interactor for another frame, soon but after all that waits already.
class ReliefRefresher
{
public:
  ReliefRefresher() = default;
  ~ReliefRefresher();
  ReliefRefresher(const ReliefRefresher&) = delete;
  void operator=(const ReliefRefresher&) = delete;

  /// Whether a window has an interactor that can be asked: one that runs and has timers.
  bool CanAsk(vtkRenderWindow* window);

  /// Asks, where that is possible.
  void Ask(vtkRenderWindow* window);

private:
  static void OnTimer(vtkObject* caller, unsigned long event, void* self, void* timer);
  void Follow(vtkRenderWindowInteractor* interactor);
  void Forget();

  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  unsigned long Observer = 0;
  bool HasTimers = false;
  int Timer = 0; // 0 for none
};

#endif
