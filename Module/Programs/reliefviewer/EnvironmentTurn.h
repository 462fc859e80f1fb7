// SPDX-License-Identifier: BSD-3-Clause
#ifndef EnvironmentTurn_h
#define EnvironmentTurn_h

#include "vtkWeakPointer.h"

#include <optional>

class vtkReliefEnvironment;

namespace reliefviewer
{

class Document;

/// Turns a scene's environment after the mouse: one step for undo from beginning to end. Angles are
/// where the mouse is, in degrees, counter-clockwise; none where it has no direction.
class EnvironmentTurn
{
public:
  explicit EnvironmentTurn(Document* document)
    : Shown(document)
  {
  }

  bool IsUnderWay() const { return this->UnderWay; }
  /// Returns false if there is nothing to turn.
  bool Start(const std::optional<double>& angle);
  /// Returns how the environment stands now, if that has changed. An environment that is gone ends
  /// the turn.
  std::optional<double> Follow(const std::optional<double>& angle);
  void End();
  /// Turns it back and ends.
  void Cancel();

private:
  /// Null if it is no longer the scene's.
  vtkReliefEnvironment* Environment() const;

  Document* Shown;
  bool UnderWay = false;
  vtkWeakPointer<vtkReliefEnvironment> Turned;
  double Before = 0.0;
  double By = 0.0;
  std::optional<double> Mouse;
};

}

#endif
