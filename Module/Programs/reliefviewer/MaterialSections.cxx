// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialSections.h"

#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <algorithm>

namespace reliefviewer
{

namespace parameters = relief::parameters;
using parameters::Group;
using parameters::Owner;

namespace
{

constexpr double Unlimited = NumberRange::Unlimited;

}

//------------------------------------------------------------------------------
ReliefSection::ReliefSection(Document* document, QWidget* parent)
  : Section(tr("Relief"), document, parent)
{
  this->AddHeightScale();
  this->AddParameter(Owner::Material, "DiffuseColor");
  this->AddParameter(Owner::Material, "BaseColor");
  this->AddDepth();
  this->AddParameter(Owner::Material, "OffsetMode");
  this->AddParameter(Owner::Material, "Attenuation");
  FieldOptions density;
  density.Range = [document] {
    return NumberRange{ 0.0, Unlimited, 0.0, 2.0 / document->OpenedField().MeanSpacing(), 3.0 };
  };
  this->AddParameter(Owner::Material, "Density", density);
  this->AddOtherParameters(Owner::Scene, Group::Relief);
  this->AddOtherParameters(Owner::Material, Group::Relief);
}

//------------------------------------------------------------------------------
void ReliefSection::AddHeightScale()
{
  Document* document = this->Edited();
  vtkReliefScene* scene = document->Scene();
  const auto unit = [document] { return document->OpenedField().Heights.HeightUnit; };
  FieldOptions options;
  options.Range = [document]
  {
    const double fitting = document->OpenedField().FittingScale;
    return NumberRange{ -Unlimited, Unlimited, 0.0, fitting > 0.0 ? 5.0 * fitting : 10.0, 3.0 };
  };
  options.Get = [=] { return scene->GetHeightScale() / unit(); };
  options.Set = [=](double value) { scene->SetHeightScale(value * unit()); };
  this->AddParameter(Owner::Scene, "HeightScale", options);
}

//------------------------------------------------------------------------------
void ReliefSection::AddDepth()
{
  Document* document = this->Edited();
  const auto material = [document] { return document->Scene()->GetMaterial(); };
  FieldOptions automatic;
  automatic.Set = [=](double on)
  {
    // What was seen stays: only the drag of the slider changes it.
    material()->SetSubsurfaceDepth(document->OpenedField().MeanSpacing());
    material()->SetAutomaticSubsurfaceDepth(on != 0.0);
  };
  this->AddParameter(Owner::Material, "AutomaticSubsurfaceDepth", automatic);
  FieldOptions depth;
  depth.Range = [document] {
    return NumberRange{ 0.0, Unlimited, 0.0, 100.0 * document->OpenedField().MeanSpacing(), 3.0 };
  };
  depth.Get = [=]
  {
    return material()->GetAutomaticSubsurfaceDepth() ? document->OpenedField().MeanSpacing()
                                                     : material()->GetSubsurfaceDepth();
  };
  this->AddParameter(Owner::Material, "SubsurfaceDepth", depth);
}

//------------------------------------------------------------------------------
HighlightSection::HighlightSection(Document* document, QWidget* parent)
  : Section(tr("Highlights"), document, parent)
{
  this->AddParameter(Owner::Material, "SpecularCoefficient");
  this->AddParameter(Owner::Material, "SpecularColor");
  FieldOptions range;
  range.Key = QStringLiteral("specular");
  this->AddParameter(Owner::Material, "SpecularRange", range);
  this->AddOtherParameters(Owner::Material, Group::Highlights);
}

//------------------------------------------------------------------------------
ScatteringSection::ScatteringSection(Document* document, QWidget* parent)
  : Section(tr("Light from behind"), document, parent)
{
  this->AddFloor();
  this->AddParameter(Owner::Material, "ForwardScatterCoefficient");
  FieldOptions range;
  range.Key = QStringLiteral("scatter");
  this->AddParameter(Owner::Material, "ForwardScatterRange", range);
  FieldOptions power;
  power.Key = QStringLiteral("scatterPower");
  this->AddParameter(Owner::Material, "ForwardScatterPower", power);
  this->AddOtherParameters(Owner::Material, Group::Backlight);
}

//------------------------------------------------------------------------------
void ScatteringSection::AddFloor()
{
  Document* document = this->Edited();
  const auto material = [document] { return document->Scene()->GetMaterial(); };
  FieldOptions floor;
  floor.Set = [=](double on)
  {
    const Field& field = document->OpenedField();
    const double scale = document->Scene()->GetHeightScale();
    if (on != 0.0 && material()->GetFloorHeight() == 0.0)
    {
      // A floor that is never above the relief, and thin enough to be seen through.
      const double low = std::min(field.Lowest * scale, field.Highest * scale);
      material()->SetFloorHeight(std::min(0.0, low));
    }
    material()->SetUseFloor(on != 0.0);
  };
  this->AddParameter(Owner::Material, "UseFloor", floor);
  FieldOptions height;
  height.Range = [document]
  {
    const Field& field = document->OpenedField();
    const double scale = document->Scene()->GetHeightScale();
    const double low = std::min(field.Lowest * scale, field.Highest * scale);
    const double high = std::max(field.Lowest * scale, field.Highest * scale);
    const double range = high > low ? high - low : field.Size();
    return NumberRange{ -Unlimited, Unlimited, low - range, high };
  };
  this->AddParameter(Owner::Material, "FloorHeight", height);
}

//------------------------------------------------------------------------------
AccuracySection::AccuracySection(Document* document, QWidget* parent)
  : Section(tr("Accuracy"), document, parent)
{
  this->AddOtherParameters(Owner::Scene, Group::Accuracy);
  this->AddOtherParameters(Owner::Material, Group::Accuracy);
}

}
