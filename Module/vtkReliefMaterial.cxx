// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefMaterial.h"

#include "vtkObjectFactory.h"
#include "vtkReliefSetters.h"

vtkStandardNewMacro(vtkReliefMaterial);

#define vtkReliefThisClass vtkReliefMaterial
vtkReliefSetColorBody(BaseColor);
vtkReliefSetColorBody(DiffuseColor);
vtkReliefSetColorBody(SpecularColor);
vtkReliefSetNumberBody(
  SpecularCoefficient, double, value >= 0.0 && value <= 1.0, "a number in [0, 1]");
vtkReliefSetNumberBody(
  ForwardScatterCoefficient, double, value >= 0.0 && value <= 1.0, "a number in [0, 1]");
vtkReliefSetFalloffRangeBody(SpecularRange);
vtkReliefSetNumberBody(SpecularPower, double, value >= 0.0, "a finite number of at least 0");
vtkReliefSetFalloffRangeBody(ForwardScatterRange);
vtkReliefSetNumberBody(ForwardScatterPower, double, value >= 0.0, "a finite number of at least 0");
vtkReliefSetNumberBody(OffsetMode, int, value == Vertical || value == SurfaceNormal,
  "Vertical (0) or SurfaceNormal (1)");
vtkReliefSetNumberBody(Attenuation, int, value == Reciprocal || value == Exponential,
  "Reciprocal (0) or Exponential (1)");
vtkReliefSetNumberBody(Density, double, value >= 0.0, "a finite number of at least 0");
vtkReliefSetNumberBody(FloorHeight, double, true, "a finite number");

//------------------------------------------------------------------------------
void vtkReliefMaterial::SetSubsurfaceDepth(double value)
{
  if (!std::isfinite(value) || value < 0.0)
  {
    vtkErrorMacro(
      "SetSubsurfaceDepth: " << value << " was given, a finite number of at least 0 is expected; "
                             << this->SubsurfaceDepth << " is kept.");
    return;
  }
  if (this->SubsurfaceDepth != value || this->AutomaticSubsurfaceDepth)
  {
    this->SubsurfaceDepth = value;
    this->AutomaticSubsurfaceDepth = false;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkReliefMaterial::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  auto printColor = [&](const char* name, const double c[3])
  { os << indent << name << ": (" << c[0] << ", " << c[1] << ", " << c[2] << ")\n"; };
  printColor("BaseColor", this->BaseColor);
  printColor("DiffuseColor", this->DiffuseColor);
  printColor("SpecularColor", this->SpecularColor);
  os << indent << "SpecularCoefficient: " << this->SpecularCoefficient << "\n";
  os << indent << "ForwardScatterCoefficient: " << this->ForwardScatterCoefficient << "\n";
  os << indent << "SpecularRange: (" << this->SpecularRange[0] << ", " << this->SpecularRange[1]
     << ")\n";
  os << indent << "SpecularPower: " << this->SpecularPower << "\n";
  os << indent << "ForwardScatterRange: (" << this->ForwardScatterRange[0] << ", "
     << this->ForwardScatterRange[1] << ")\n";
  os << indent << "ForwardScatterPower: " << this->ForwardScatterPower << "\n";
  os << indent << "SubsurfaceDepth: " << this->SubsurfaceDepth << "\n";
  os << indent << "AutomaticSubsurfaceDepth: " << (this->AutomaticSubsurfaceDepth ? "On" : "Off")
     << "\n";
  os << indent << "OffsetMode: " << (this->OffsetMode == Vertical ? "Vertical" : "SurfaceNormal")
     << "\n";
  os << indent
     << "Attenuation: " << (this->Attenuation == Reciprocal ? "Reciprocal" : "Exponential") << "\n";
  os << indent << "Density: " << this->Density << "\n";
  os << indent << "UseFloor: " << (this->UseFloor ? "On" : "Off") << "\n";
  os << indent << "FloorHeight: " << this->FloorHeight << "\n";
}
