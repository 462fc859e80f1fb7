// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefParameters.h"

#include "SceneParameters.h"
#include "vtkObjectFactory.h"

namespace parameters = relief::parameters;

vtkStandardNewMacro(vtkReliefParameters);

namespace
{
// An empty one for an index that does not exist.
const parameters::Parameter& At(int index)
{
  static const parameters::Parameter none;
  const auto& all = parameters::All();
  return index >= 0 && index < static_cast<int>(all.size()) ? all[index] : none;
}

bool IsThere(int index)
{
  return *At(index).Name != '\0';
}
}

//------------------------------------------------------------------------------
int vtkReliefParameters::GetNumberOfParameters()
{
  return static_cast<int>(parameters::All().size());
}

std::string vtkReliefParameters::GetOwner(int index)
{
  return IsThere(index) ? parameters::NameOf(At(index).Of) : "";
}

std::string vtkReliefParameters::GetName(int index)
{
  return At(index).Name;
}

std::string vtkReliefParameters::GetKey(int index)
{
  return At(index).Key;
}

std::string vtkReliefParameters::GetKind(int index)
{
  return IsThere(index) ? parameters::NameOf(At(index).Is) : "";
}

std::string vtkReliefParameters::GetHelp(int index)
{
  return At(index).Help;
}

std::string vtkReliefParameters::GetLabel(int index)
{
  return At(index).Label;
}

std::string vtkReliefParameters::GetUnit(int index)
{
  return At(index).Unit;
}

int vtkReliefParameters::GetNumberOfComponents(int index)
{
  return IsThere(index) ? parameters::Size(At(index)) : 0;
}

double vtkReliefParameters::GetDefault(int index, int component)
{
  return component >= 0 && component < 3 ? At(index).Default[component] : 0.0;
}

double vtkReliefParameters::GetMinimum(int index)
{
  return IsThere(index) ? At(index).Taken.Least : 0.0;
}

double vtkReliefParameters::GetMaximum(int index)
{
  return IsThere(index) ? At(index).Taken.Greatest : 0.0;
}

bool vtkReliefParameters::GetMinimumOpen(int index)
{
  return At(index).Taken.Open;
}

int vtkReliefParameters::GetNumberOfChoices(int index)
{
  return static_cast<int>(At(index).Choices.size());
}

std::string vtkReliefParameters::GetChoice(int index, int choice)
{
  return choice >= 0 && choice < GetNumberOfChoices(index) ? At(index).Choices[choice].Name : "";
}

std::string vtkReliefParameters::GetOption(int index)
{
  return At(index).Option ? At(index).Option : "";
}

//------------------------------------------------------------------------------
void vtkReliefParameters::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfParameters: " << GetNumberOfParameters() << "\n";
}
