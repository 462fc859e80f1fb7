// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentSection.h"

#include "vtkReliefEnvironment.h"
#include "vtkReliefScene.h"

#include <QFileInfo>
#include <QPushButton>

namespace reliefviewer
{

namespace
{
constexpr double Unlimited = NumberRange::Unlimited;
}

//------------------------------------------------------------------------------
EnvironmentSection::EnvironmentSection(Document* document, QWidget* parent)
  : Section(tr("Environment"), document, parent)
  , Picture(new QPushButton(this->Body()))
{
  this->AddSource();
  this->AddSkyFields();
  this->AddCommonFields();
}

//------------------------------------------------------------------------------
EnvironmentSection::~EnvironmentSection() = default;

//------------------------------------------------------------------------------
vtkReliefEnvironment* EnvironmentSection::Environment() const
{
  return this->Edited()->Scene()->GetEnvironment();
}

//------------------------------------------------------------------------------
void EnvironmentSection::AddSource()
{
  vtkReliefScene* scene = this->Edited()->Scene();
  this->AddCheck(
    { "environment", tr("On"), tr("Light from all around.") },
    [this] { return this->Environment() != nullptr; },
    [this, scene](bool on)
    {
      if (!on)
      {
        this->Removed = this->Environment();
        scene->SetEnvironment(nullptr);
        return;
      }
      if (!this->Removed)
      {
        this->Removed = vtkSmartPointer<vtkReliefEnvironment>::New();
        this->Removed->SetImageToClearSky(315.0, 45.0);
        this->Removed->SetIntensity(0.3);
      }
      scene->SetEnvironment(this->Removed);
      this->Removed = nullptr;
    });
  this->ShowLastRowsOnlyIf([] { return true; });
  // In the order of vtkReliefEnvironment::ImageSources, without the first.
  this->AddChoice(
    { "environmentSource", tr("Light of"), tr("Where its colours come from.") },
    { tr("White sky"), tr("Clear sky"), tr("Picture") },
    [this] { return this->Environment() ? this->Environment()->GetImageSource() - 1 : 0; },
    [this](int choice)
    {
      // Only another picture is something new when it is chosen again.
      const int source = choice + 1;
      if (source == this->Environment()->GetImageSource() && source != vtkReliefEnvironment::File)
      {
        return;
      }
      switch (source)
      {
        case vtkReliefEnvironment::WhiteDome:
          this->Environment()->SetImageToWhiteDome();
          break;
        case vtkReliefEnvironment::ClearSky:
          this->Environment()->SetImageToClearSky(315.0, 45.0);
          break;
        default:
          emit this->pictureWanted();
      }
    });
  this->ShowLastRowsOnlyIf([this] { return this->Environment() != nullptr; });

  this->Picture->setObjectName(QStringLiteral("environmentPicture"));
  connect(this->Picture, &QPushButton::clicked, this, &EnvironmentSection::pictureWanted);
  this->AddWide(this->Picture);
  this->ShowLastRowsOnlyIf(
    [this]
    {
      const bool file =
        this->Environment() && this->Environment()->GetImageSource() == vtkReliefEnvironment::File;
      this->Picture->setText(file
          ? QFileInfo(QString::fromLocal8Bit(this->Environment()->GetFileName())).fileName()
          : QString());
      return file;
    });
}

//------------------------------------------------------------------------------
void EnvironmentSection::AddSkyFields()
{
  const auto parameter = [this](int which)
  { return this->Environment() ? this->Environment()->GetClearSkyParameters()[which] : 0.0; };
  const auto setParameter = [this, parameter](int which, double value)
  {
    double all[3] = { parameter(0), parameter(1), parameter(2) };
    all[which] = value;
    this->Environment()->SetImageToClearSky(all[0], all[1], all[2]);
  };
  this
    ->AddNumber(
      { "skyAzimuth", tr("Sun's azimuth"), tr("Of the sun of this sky, from north.") },
      { -Unlimited, Unlimited, 0.0, 360.0 }, [=] { return parameter(0); },
      [=](double value) { setParameter(0, value); })
    ->SetSuffix(QStringLiteral("\u00b0"));
  this
    ->AddNumber(
      { "skyAltitude", tr("Sun's altitude"), tr("Of the sun of this sky.") },
      { 0.0, 90.0, 0.0, 90.0 }, [=] { return parameter(1); },
      [=](double value) { setParameter(1, value); })
    ->SetSuffix(QStringLiteral("\u00b0"));
  this->AddNumber(
    { "skyTurbidity", tr("Haze"), tr("Turbidity of the air: 2 is very clear.") },
    { 2.0, 10.0, 2.0, 10.0 }, [=] { return parameter(2); },
    [=](double value) { setParameter(2, value); });
  this->ShowLastRowsOnlyIf(
    [this]
    {
      return this->Environment() &&
        this->Environment()->GetImageSource() == vtkReliefEnvironment::ClearSky;
    });
}

//------------------------------------------------------------------------------
void EnvironmentSection::AddCommonFields()
{
  this->AddNumber(
    { "environmentIntensity", tr("Intensity"), tr("What its colours are multiplied by.") },
    { 0.0, Unlimited, 0.0, 4.0, 2.0 },
    [this] { return this->Environment() ? this->Environment()->GetIntensity() : 0.0; },
    [this](double value) { this->Environment()->SetIntensity(value); });
  this
    ->AddNumber(
      { "environmentTurn", tr("Turn"), tr("About the vertical, counter-clockwise.") },
      { -Unlimited, Unlimited, 0.0, 360.0 },
      [this] { return this->Environment() ? this->Environment()->GetRotationZ() : 0.0; },
      [this](double value) { this->Environment()->SetRotationZ(value); })
    ->SetSuffix(QStringLiteral("\u00b0"));
  this
    ->AddNumber(
      { "environmentTilt", tr("Tilt"), tr("Leans its zenith toward the south.") },
      { -Unlimited, Unlimited, -180.0, 180.0 },
      [this] { return this->Environment() ? this->Environment()->GetTilt() : 0.0; },
      [this](double value) { this->Environment()->SetTilt(value); })
    ->SetSuffix(QStringLiteral("\u00b0"));
  this->AddNumber(
    { "environmentSamples", tr("Samples"),
      tr("How many lights stand for it. Best a multiple of 8.") },
    { 1.0, 65536.0, 8.0, 1024.0, 2.0 },
    [this] { return this->Environment() ? this->Environment()->GetNumberOfSamples() : 0.0; },
    [this](double value) { this->Environment()->SetNumberOfSamples(static_cast<int>(value)); });
  this->AddChoice(
    { "environmentSampling", tr("Spread"), tr("How these lights are laid out.") },
    { tr("Uniform"), tr("Evenly"), tr("Where light is") },
    [this] { return this->Environment() ? this->Environment()->GetSampling() : 0; },
    [this](int sampling) { this->Environment()->SetSampling(sampling); });
  this->ShowLastRowsOnlyIf([this] { return this->Environment() != nullptr; });
}

}
