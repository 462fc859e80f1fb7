// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialSections.h"

#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <algorithm>

namespace reliefviewer
{

namespace
{

constexpr double Unlimited = NumberRange::Unlimited;

/// A cosine, of which falloffs begin and end at any.
NumberRange cosineRange()
{
  return { -Unlimited, Unlimited, -1.0, 1.0 };
}

/// An exponent.
NumberRange powerRange()
{
  return { 0.0, Unlimited, 0.0, 100.0, 3.0 };
}

}

//------------------------------------------------------------------------------
ReliefSection::ReliefSection(Document* document, QWidget* parent)
  : Section(tr("Relief"), document, parent)
{
  vtkReliefScene* scene = document->Scene();
  const auto material = [scene] { return scene->GetMaterial(); };
  const auto unit = [document] { return document->OpenedField().Heights.HeightUnit; };
  this->AddNumber(
    { "heightScale", tr("Height scale"),
      tr("What heights are multiplied by. Negative: inside out.") },
    [document]
    {
      const double fitting = document->OpenedField().FittingScale();
      return NumberRange{ -Unlimited, Unlimited, 0.0, fitting > 0.0 ? 5.0 * fitting : 10.0, 3.0 };
    },
    [=] { return scene->GetHeightScale() / unit(); },
    [=](double value) { scene->SetHeightScale(value * unit()); });
  this->AddColour(
    { "diffuseColor", tr("Diffuse"),
      tr("Colour of the light that has passed through the material.") },
    [=] { return material()->GetDiffuseColor(); },
    [=](const double* colour) { material()->SetDiffuseColor(colour); });
  this->AddColour(
    { "baseColor", tr("Base"), tr("Colour without any light.") },
    [=] { return material()->GetBaseColor(); },
    [=](const double* colour) { material()->SetBaseColor(colour); });
  this->AddCheck(
    { "automaticSubsurfaceDepth", tr("Automatic depth"),
      tr("Light is gathered one sample's width below the surface.") },
    [=] { return material()->GetAutomaticSubsurfaceDepth(); },
    [=](bool on)
    {
      // What was seen stays: only the drag of the slider changes it.
      material()->SetSubsurfaceDepth(document->OpenedField().MeanSpacing());
      material()->SetAutomaticSubsurfaceDepth(on);
    });
  this->AddNumber(
    { "subsurfaceDepth", tr("Depth t"),
      tr("How far below the surface light is gathered: stone at the left, wax at the "
         "right.") },
    [document] {
      return NumberRange{ 0.0, Unlimited, 0.0, 100.0 * document->OpenedField().MeanSpacing(), 3.0 };
    },
    [=]
    {
      return material()->GetAutomaticSubsurfaceDepth() ? document->OpenedField().MeanSpacing()
                                                       : material()->GetSubsurfaceDepth();
    },
    [=](double value) { material()->SetSubsurfaceDepth(value); });
  this->AddChoice(
    { "offsetMode", tr("Offset"),
      tr("Straight down, or along the surface's normal, which shades slopes as the "
         "cosine of the light's angle does.") },
    { tr("Vertical"), tr("Surface normal") }, [=] { return material()->GetOffsetMode(); },
    [=](int mode) { material()->SetOffsetMode(mode); });
  this->AddChoice(
    { "attenuation", tr("Attenuation"),
      tr("How the thickness r of material dims light: t / r, or exponentially.") },
    { tr("Reciprocal"), tr("Exponential") }, [=] { return material()->GetAttenuation(); },
    [=](int attenuation) { material()->SetAttenuation(attenuation); });
  this->ShowLastRowsOnlyIf([] { return true; });
  this->AddNumber(
    { "density", tr("Density"), tr("Of the exponential attenuation, per length.") },
    [document] {
      return NumberRange{ 0.0, Unlimited, 0.0, 2.0 / document->OpenedField().MeanSpacing(), 3.0 };
    },
    [=] { return material()->GetDensity(); }, [=](double value) { material()->SetDensity(value); });
  this->ShowLastRowsOnlyIf(
    [=] { return material()->GetAttenuation() == vtkReliefMaterial::Exponential; });
}

//------------------------------------------------------------------------------
void FalloffSection::AddFalloff(const QString& key, const QString& angle, const Falloff& falloff)
{
  // Neither end can pass the other: it takes it along.
  this->AddNumber(
    { key + "From", tr("Begins at"), tr("Cosine of %1 where it begins.").arg(angle) },
    cosineRange(), [=] { return falloff.Range()[0]; },
    [=](double from) { falloff.SetRange(from, std::max(from, falloff.Range()[1])); });
  this->AddNumber(
    { key + "To", tr("Full at"), tr("Cosine of %1 where it is full.").arg(angle) }, cosineRange(),
    [=] { return falloff.Range()[1]; },
    [=](double to) { falloff.SetRange(std::min(to, falloff.Range()[0]), to); });
  this->AddNumber({ key + "Power", tr("Power"), tr("Above 1 it is narrower, below 1 wider.") },
    powerRange(), falloff.Power, falloff.SetPower);
}

//------------------------------------------------------------------------------
HighlightSection::HighlightSection(Document* document, QWidget* parent)
  : FalloffSection(tr("Highlights"), document, parent)
{
  const auto material = [document] { return document->Scene()->GetMaterial(); };
  this->AddShare(
    { "specularCoefficient", tr("Share k_s"), tr("0: none. 1: nothing else.") },
    [=] { return material()->GetSpecularCoefficient(); },
    [=](double value) { material()->SetSpecularCoefficient(value); });
  this->AddColour(
    { "specularColor", tr("Colour"), tr("Colour of highlights.") },
    [=] { return material()->GetSpecularColor(); },
    [=](const double* colour) { material()->SetSpecularColor(colour); });
  this->AddFalloff("specular", tr("the angle between light and mirrored view"),
    { [=] { return material()->GetSpecularRange(); },
      [=](double from, double to) { material()->SetSpecularRange(from, to); },
      [=] { return material()->GetSpecularPower(); },
      [=](double value) { material()->SetSpecularPower(value); } });
}

//------------------------------------------------------------------------------
ScatteringSection::ScatteringSection(Document* document, QWidget* parent)
  : FalloffSection(tr("Light from behind"), document, parent)
{
  const auto material = [document] { return document->Scene()->GetMaterial(); };
  this->AddCheck(
    { "useFloor", tr("Floor"),
      tr("The material ends below, so that light comes through from behind.") },
    [=] { return material()->GetUseFloor(); },
    [=](bool on)
    {
      const Field& field = document->OpenedField();
      const double scale = document->Scene()->GetHeightScale();
      if (on && material()->GetFloorHeight() == 0.0)
      {
        // A floor that is never above the relief, and thin enough to be seen through.
        const double low = std::min(field.Lowest * scale, field.Highest * scale);
        material()->SetFloorHeight(std::min(0.0, low));
      }
      material()->SetUseFloor(on);
    });
  this->ShowLastRowsOnlyIf([] { return true; });
  this->AddNumber(
    { "floorHeight", tr("Floor height"), tr("In the unit of the scaled heights.") },
    [document]
    {
      const Field& field = document->OpenedField();
      const double scale = document->Scene()->GetHeightScale();
      const double low = std::min(field.Lowest * scale, field.Highest * scale);
      const double high = std::max(field.Lowest * scale, field.Highest * scale);
      const double range = high > low ? high - low : field.Size();
      return NumberRange{ -Unlimited, Unlimited, low - range, high };
    },
    [=] { return material()->GetFloorHeight(); },
    [=](double value) { material()->SetFloorHeight(value); });
  this->ShowLastRowsOnlyIf([=] { return material()->GetUseFloor(); });
  this->AddShare(
    { "forwardScatterCoefficient", tr("Share k_f"),
      tr("Share of the light that is scattered forward, and seen when the light is "
         "behind.") },
    [=] { return material()->GetForwardScatterCoefficient(); },
    [=](double value) { material()->SetForwardScatterCoefficient(value); });
  this->AddFalloff("scatter", tr("the angle between view and light's way"),
    { [=] { return material()->GetForwardScatterRange(); },
      [=](double from, double to) { material()->SetForwardScatterRange(from, to); },
      [=] { return material()->GetForwardScatterPower(); },
      [=](double value) { material()->SetForwardScatterPower(value); } });
}

//------------------------------------------------------------------------------
AccuracySection::AccuracySection(Document* document, QWidget* parent)
  : Section(tr("Accuracy"), document, parent)
{
  vtkReliefScene* scene = document->Scene();
  this->AddChoice(
    { "integrator", tr("Integrator"),
      tr("In closed form, or a fixed number of steps as the model was first "
         "published.") },
    { tr("Exact"), tr("Fixed steps") }, [=] { return scene->GetIntegrator(); },
    [=](int integrator) { scene->SetIntegrator(integrator); });
  this->ShowLastRowsOnlyIf([] { return true; });
  this->AddNumber(
    { "tolerance", tr("Tolerance"),
      tr("How far the illumination, 0 to 1, may be off. More is quicker.") },
    { 0.0, Unlimited, 0.0, 0.1, 3.0 }, [=] { return scene->GetTolerance(); },
    [=](double value) { scene->SetTolerance(value); });
  this->ShowLastRowsOnlyIf([=] { return scene->GetIntegrator() == vtkReliefScene::Exact; });
  this->AddNumber(
    { "numberOfSteps", tr("Steps"), tr("Along each ray.") }, { 1.0, 1000000.0, 1.0, 2048.0, 2.0 },
    [=] { return scene->GetNumberOfSteps(); },
    [=](double value) { scene->SetNumberOfSteps(static_cast<int>(value)); });
  this->ShowLastRowsOnlyIf([=] { return scene->GetIntegrator() == vtkReliefScene::FixedStep; });
}

}
