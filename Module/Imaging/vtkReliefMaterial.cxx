// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefMaterial.h"

#include "SceneParameters.h"
#include "vtkObjectFactory.h"

namespace parameters = relief::parameters;

vtkStandardNewMacro(vtkReliefMaterial);

//------------------------------------------------------------------------------
vtkReliefMaterial::vtkReliefMaterial()
{
  parameters::SetDefaults(this);
}

//------------------------------------------------------------------------------
vtkReliefMaterial::~vtkReliefMaterial() = default;

//------------------------------------------------------------------------------
// What each of these takes is in the table of parameters.
void vtkReliefMaterial::SetBaseColor(double r, double g, double b)
{
  parameters::Set(this, this->BaseColor, { r, g, b }, "BaseColor");
}

void vtkReliefMaterial::SetDiffuseColor(double r, double g, double b)
{
  parameters::Set(this, this->DiffuseColor, { r, g, b }, "DiffuseColor");
}

void vtkReliefMaterial::SetSpecularColor(double r, double g, double b)
{
  parameters::Set(this, this->SpecularColor, { r, g, b }, "SpecularColor");
}

void vtkReliefMaterial::SetSpecularCoefficient(double value)
{
  parameters::Set(this, this->SpecularCoefficient, value, "SpecularCoefficient");
}

void vtkReliefMaterial::SetForwardScatterCoefficient(double value)
{
  parameters::Set(this, this->ForwardScatterCoefficient, value, "ForwardScatterCoefficient");
}

void vtkReliefMaterial::SetSpecularRange(double lo, double hi)
{
  parameters::Set(this, this->SpecularRange, { lo, hi, 0.0 }, "SpecularRange");
}

void vtkReliefMaterial::SetSpecularPower(double value)
{
  parameters::Set(this, this->SpecularPower, value, "SpecularPower");
}

void vtkReliefMaterial::SetForwardScatterRange(double lo, double hi)
{
  parameters::Set(this, this->ForwardScatterRange, { lo, hi, 0.0 }, "ForwardScatterRange");
}

void vtkReliefMaterial::SetForwardScatterPower(double value)
{
  parameters::Set(this, this->ForwardScatterPower, value, "ForwardScatterPower");
}

void vtkReliefMaterial::SetOffsetMode(int mode)
{
  parameters::Set(this, this->OffsetMode, mode, "OffsetMode");
}

void vtkReliefMaterial::SetAttenuation(int attenuation)
{
  parameters::Set(this, this->Attenuation, attenuation, "Attenuation");
}

void vtkReliefMaterial::SetDensity(double value)
{
  parameters::Set(this, this->Density, value, "Density");
}

void vtkReliefMaterial::SetFloorHeight(double value)
{
  parameters::Set(this, this->FloorHeight, value, "FloorHeight");
}

//------------------------------------------------------------------------------
void vtkReliefMaterial::SetSubsurfaceDepth(double value)
{
  parameters::Set(this, this->SubsurfaceDepth, value, "SubsurfaceDepth");
  if (this->SubsurfaceDepth == value) // it was taken
  {
    this->SetAutomaticSubsurfaceDepth(false);
  }
}

//------------------------------------------------------------------------------
double vtkReliefMaterial::GetDepthFor(const double spacing[2])
{
  return this->AutomaticSubsurfaceDepth ? (spacing[0] + spacing[1]) / 2.0 : this->SubsurfaceDepth;
}

//------------------------------------------------------------------------------
void vtkReliefMaterial::DeepCopy(vtkReliefMaterial* other)
{
  if (other && other != this)
  {
    parameters::Copy(other, this);
  }
}

//------------------------------------------------------------------------------
void vtkReliefMaterial::ShallowCopy(vtkReliefMaterial* other)
{
  this->DeepCopy(other);
}

//------------------------------------------------------------------------------
void vtkReliefMaterial::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  parameters::Print(this, os, indent);
}
