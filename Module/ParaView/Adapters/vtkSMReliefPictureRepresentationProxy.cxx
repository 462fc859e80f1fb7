// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMReliefPictureRepresentationProxy.h"

#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"

#include <string>

vtkStandardNewMacro(vtkSMReliefPictureRepresentationProxy);

//------------------------------------------------------------------------------
vtkSMReliefPictureRepresentationProxy::vtkSMReliefPictureRepresentationProxy() = default;

//------------------------------------------------------------------------------
vtkSMReliefPictureRepresentationProxy::~vtkSMReliefPictureRepresentationProxy() = default;

//------------------------------------------------------------------------------
bool vtkSMReliefPictureRepresentationProxy::SetRepresentationType(const char* type)
{
  if (type && std::string(type) == "Picture" && this->GetUsingScalarColoring())
  {
    vtkSMPropertyHelper array(this, "ColorArrayName");
    array.SetInputArrayToProcess(array.GetInputArrayAssociation(), "");
    vtkSMPropertyHelper(this, "LookupTable", true).RemoveAllValues();
    this->UpdateVTKObjects();
  }
  return this->Superclass::SetRepresentationType(type);
}

//------------------------------------------------------------------------------
void vtkSMReliefPictureRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
