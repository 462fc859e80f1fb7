// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentTurn.h"

#include "Document.h"

#include "vtkReliefEnvironment.h"
#include "vtkReliefScene.h"

#include <cmath>

namespace reliefviewer
{

//------------------------------------------------------------------------------
vtkReliefEnvironment* EnvironmentTurn::Environment() const
{
  vtkReliefEnvironment* environment = this->Shown->Scene()->GetEnvironment();
  return this->Turned == environment ? environment : nullptr;
}

//------------------------------------------------------------------------------
bool EnvironmentTurn::Start(const std::optional<double>& angle)
{
  this->Turned = this->Shown->HasField() ? this->Shown->Scene()->GetEnvironment() : nullptr;
  this->UnderWay = this->Turned != nullptr;
  if (this->UnderWay)
  {
    this->Before = this->Turned->GetRotationZ();
    this->By = 0.0;
    this->Mouse = angle;
    this->Shown->StartStep();
  }
  return this->UnderWay;
}

//------------------------------------------------------------------------------
std::optional<double> EnvironmentTurn::Follow(const std::optional<double>& angle)
{
  vtkReliefEnvironment* environment = this->Environment();
  if (!this->UnderWay || !environment)
  {
    this->End();
    return std::nullopt;
  }
  const std::optional<double> from = this->Mouse;
  this->Mouse = angle;
  if (!from || !angle)
  {
    return std::nullopt;
  }
  this->By += std::remainder(*angle - *from, 360.0);
  // A tenth of a degree reads well, and is less than a pixel.
  const double turned = std::fmod(std::round(10.0 * (this->Before + this->By)) / 10.0, 360.0);
  environment->SetRotationZ(turned < 0.0 ? turned + 360.0 : turned);
  this->Shown->Change();
  return environment->GetRotationZ();
}

//------------------------------------------------------------------------------
void EnvironmentTurn::End()
{
  if (this->UnderWay)
  {
    this->UnderWay = false;
    this->Shown->EndStep(Document::tr("Turn environment"));
  }
}

//------------------------------------------------------------------------------
void EnvironmentTurn::Cancel()
{
  if (vtkReliefEnvironment* environment = this->Environment())
  {
    environment->SetRotationZ(this->Before);
    this->Shown->Change();
  }
  this->End();
}

}
