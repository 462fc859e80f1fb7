// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentSection.h"

#include "vtkReliefEnvironment.h"
#include "vtkReliefScene.h"

#include <QFileInfo>
#include <QPushButton>

namespace reliefviewer
{

namespace parameters = relief::parameters;

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
        this->Removed->SetImageToClearSky(parameters::UsualAzimuth, parameters::UsualAltitude);
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
          this->Environment()->SetImageToClearSky(
            parameters::UsualAzimuth, parameters::UsualAltitude);
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
  using parameters::Owner;
  this->SetPresence([this] { return this->Environment() != nullptr; });
  this->AddParameter(Owner::Environment, "Intensity", { QStringLiteral("environmentIntensity") });
  FieldOptions turn;
  turn.Key = QStringLiteral("environmentTurn");
  turn.Tip =
    tr("Turns the environment about the vertical, counter-clockwise seen from above. On the "
       "picture: drag with the right button, or with Ctrl.");
  this->AddParameter(Owner::Environment, "RotationZ", turn);
  this->AddParameter(Owner::Environment, "Tilt", { QStringLiteral("environmentTilt") });
  FieldOptions radius;
  radius.Key = QStringLiteral("environmentRadius");
  radius.Range = [this] {
    return NumberRange{ 0.0, Unlimited, 0.0, 10.0 * this->Edited()->OpenedField().Size(), 3.0 };
  };
  this->AddParameter(Owner::Environment, "Radius", radius);
  this->AddParameter(
    Owner::Environment, "NumberOfSamples", { QStringLiteral("environmentSamples") });
  this->AddParameter(Owner::Environment, "Sampling", { QStringLiteral("environmentSampling") });
  this->AddOtherParameters(
    Owner::Environment, parameters::Group::Environment, QStringLiteral("environment"));
  this->ShowLastRowsOnlyIf([this] { return this->Environment() != nullptr; });
}

}
