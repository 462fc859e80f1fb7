// SPDX-License-Identifier: BSD-3-Clause
// Defaults, refusals and printing of vtkReliefMaterial.
#include "vtkReliefMaterial.h"

#include "ReliefTestUtilities.h"

#include <limits>
#include <sstream>

int TestReliefMaterial(int, char*[])
{
  int Failures = 0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  vtkNew<vtkReliefMaterial> material;

  // Defaults.
  CHECK(material->GetBaseColor()[0] == 0.0 && material->GetDiffuseColor()[1] == 1.0 &&
    material->GetSpecularColor()[2] == 1.0);
  CHECK(
    material->GetSpecularCoefficient() == 0.0 && material->GetForwardScatterCoefficient() == 0.0);
  CHECK(material->GetSpecularRange()[0] == 0.0 && material->GetSpecularRange()[1] == 1.0);
  CHECK(
    material->GetForwardScatterRange()[0] == 0.0 && material->GetForwardScatterRange()[1] == 1.0);
  CHECK(material->GetSpecularPower() == 1.0 && material->GetForwardScatterPower() == 1.0);
  CHECK(material->GetAutomaticSubsurfaceDepth() && !material->GetUseFloor());
  CHECK(material->GetOffsetMode() == vtkReliefMaterial::TangentPlane &&
    material->GetAttenuation() == vtkReliefMaterial::Reciprocal);
  CHECK(material->GetDensity() == 1.0 && material->GetFloorHeight() == 0.0);

  // Setting a depth turns the automatic one off, even to the value it has.
  material->SetSubsurfaceDepth(material->GetSubsurfaceDepth());
  CHECK(!material->GetAutomaticSubsurfaceDepth());
  material->SetSubsurfaceDepth(0.0);
  CHECK(material->GetSubsurfaceDepth() == 0.0);

  // What is out of range is refused with one message that names the value, and changes nothing.
  MessageKeeper messages(material);
  const vtkMTimeType before = material->GetMTime();
  for (double bad : { -1.0, nan, infinity, -infinity })
  {
    std::ostringstream text;
    text << bad;
    material->SetSubsurfaceDepth(bad);
    CHECK(messages.OneError(text.str()));
    material->SetDensity(bad);
    CHECK(messages.OneError(text.str()));
    material->SetSpecularPower(bad);
    CHECK(messages.OneError(text.str()));
    material->SetForwardScatterPower(bad);
    CHECK(messages.OneError(text.str()));
    material->SetSpecularCoefficient(bad);
    CHECK(messages.OneError(text.str()));
    material->SetForwardScatterCoefficient(bad);
    CHECK(messages.OneError(text.str()));
    material->SetDiffuseColor(0.5, bad, 0.5);
    CHECK(messages.OneError(text.str()));
    material->SetBaseColor(bad, 0.5, 0.5);
    CHECK(messages.OneError(text.str()));
    material->SetSpecularColor(0.5, 0.5, bad);
    CHECK(messages.OneError(text.str()));
  }
  material->SetSpecularCoefficient(1.0001);
  CHECK(messages.OneError("1.0001"));
  material->SetForwardScatterCoefficient(2.0);
  CHECK(messages.OneError("2"));
  material->SetFloorHeight(nan);
  CHECK(messages.OneError("nan"));
  material->SetSpecularRange(0.5, 0.25);
  CHECK(messages.OneError("(0.5, 0.25)"));
  material->SetForwardScatterRange(nan, 1.0);
  CHECK(messages.OneError("nan"));
  material->SetOffsetMode(3);
  CHECK(messages.OneError("3"));
  material->SetAttenuation(-1);
  CHECK(messages.OneError("-1"));
  CHECK(material->GetMTime() == before);
  CHECK(material->GetSubsurfaceDepth() == 0.0 && material->GetSpecularRange()[1] == 1.0);

  // The ends of ranges are taken.
  material->SetSpecularCoefficient(1.0);
  material->SetForwardScatterCoefficient(1.0);
  material->SetSpecularRange(0.5, 0.5);
  material->SetDensity(0.0);
  material->SetDiffuseColor(4.0, 0.0, 0.0);
  CHECK(messages.Silent());
  CHECK(material->GetMTime() > before);

  std::ostringstream printed;
  material->Print(printed);
  for (const char* name : { "BaseColor", "DiffuseColor", "SpecularColor", "SpecularCoefficient",
         "ForwardScatterCoefficient", "SpecularRange", "SpecularPower", "ForwardScatterRange",
         "ForwardScatterPower", "SubsurfaceDepth", "AutomaticSubsurfaceDepth", "OffsetMode",
         "Attenuation", "Density", "UseFloor", "FloorHeight" })
  {
    CHECK(printed.str().find(std::string(name) + ":") != std::string::npos);
  }
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
