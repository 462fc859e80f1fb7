// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefStatistics.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkReliefStatistics);

//------------------------------------------------------------------------------
std::string vtkReliefStatistics::GetEffectNames()
{
  const std::pair<int, const char*> names[] = { { Illumination, "Illumination" },
    { Normals, "Normals" }, { Specular, "Specular" }, { ForwardScatter, "ForwardScatter" },
    { BaseTexture, "BaseTexture" }, { DiffuseTexture, "DiffuseTexture" },
    { SpecularTexture, "SpecularTexture" } };
  std::string text;
  for (const auto& name : names)
  {
    if (this->EffectsEvaluated & name.first)
    {
      text += (text.empty() ? "" : " ") + std::string(name.second);
    }
  }
  return text;
}

//------------------------------------------------------------------------------
void vtkReliefStatistics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LightsTraced: " << this->LightsTraced << "\n";
  os << indent << "RaysTraced: " << this->RaysTraced << "\n";
  os << indent << "CellsVisited: " << this->CellsVisited << "\n";
  os << indent << "LightsReused: " << this->LightsReused << "\n";
  os << indent << "EffectsEvaluated: " << this->GetEffectNames() << "\n";
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "RegionsLeftOut: " << this->RegionsLeftOut << "\n";
  os << indent << "ToleranceTaken: " << this->ToleranceTaken << "\n";
}
