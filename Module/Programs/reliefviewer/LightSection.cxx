// SPDX-License-Identifier: BSD-3-Clause
#include "LightSection.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkReliefAngles.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <QHBoxLayout>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>

namespace reliefviewer
{

namespace parameters = relief::parameters;
using parameters::Owner;

namespace
{

constexpr double Unlimited = NumberRange::Unlimited;

double roundedAngle(double degrees)
{
  return std::round(degrees * 1e9) / 1e9;
}

}

//------------------------------------------------------------------------------
LightSection::LightSection(Document* document, QWidget* parent)
  : Section(tr("Lights"), document, parent)
  , List(new QListWidget(this->Body()))
  , RemoveButton(new QPushButton(tr("Remove"), this->Body()))
{
  this->AddList();
  this->AddLightFields();
  this->AddSunFields();
  this->AddLampFields();
  // For all suns.
  this->AddOtherParameters(Owner::Scene, parameters::Group::Lights);
  this->ShowLastRowsOnlyIf([this] { return this->HasDiscs(); });
  connect(document, &Document::selectionChanged, this, &Section::Refresh);
}

//------------------------------------------------------------------------------
void LightSection::AddList()
{
  this->List->setObjectName(QStringLiteral("lights"));
  this->List->setProperty("parameter", QStringLiteral("Light.Switch")); // its check marks
  this->AddWide(this->List);
  auto* buttons = new QWidget(this->Body());
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  auto* sun = new QPushButton(tr("Add sun"), buttons);
  auto* lamp = new QPushButton(tr("Add lamp"), buttons);
  sun->setObjectName(QStringLiteral("addSun"));
  lamp->setObjectName(QStringLiteral("addLamp"));
  this->RemoveButton->setObjectName(QStringLiteral("removeLight"));
  for (QPushButton* button : { sun, lamp, this->RemoveButton })
  {
    row->addWidget(button);
  }
  this->AddWide(buttons);
  this->ShowLastRowsOnlyIf([] { return true; });

  connect(sun, &QPushButton::clicked, this, &LightSection::AddSun);
  connect(lamp, &QPushButton::clicked, this, &LightSection::AddLamp);
  connect(this->RemoveButton, &QPushButton::clicked, this, &LightSection::Remove);
  connect(this->List, &QListWidget::currentRowChanged, this,
    [this](int row)
    {
      if (this->Edited()->Scene()->GetLights()->GetNumberOfItems() > 0)
      {
        this->Edited()->SelectLight(row);
      }
    });
  connect(this->List, &QListWidget::itemChanged, this,
    [this](QListWidgetItem* item)
    {
      auto* light = vtkLight::SafeDownCast(
        this->Edited()->Scene()->GetLights()->GetItemAsObject(this->List->row(item)));
      if (light && light->GetSwitch() != (item->checkState() == Qt::Checked))
      {
        this->Edited()->Edit(
          tr("Switch light"), [light] { light->SetSwitch(!light->GetSwitch()); });
      }
    });
  this->AddRefresher([this] { this->RefreshList(); });
}

//------------------------------------------------------------------------------
void LightSection::RefreshList()
{
  const QSignalBlocker quiet(this->List);
  vtkLightCollection* lights = this->Edited()->Scene()->GetLights();
  const int count = lights->GetNumberOfItems();
  this->RemoveButton->setEnabled(count > 0);
  if (this->List->count() != count)
  {
    this->List->clear();
    for (int i = 0; i < count; ++i)
    {
      this->List->addItem(new QListWidgetItem);
    }
  }
  for (int i = 0; i < count; ++i)
  {
    auto* light = vtkLight::SafeDownCast(lights->GetItemAsObject(i));
    QListWidgetItem* item = this->List->item(i);
    item->setFlags(QListWidgetItem().flags());
    item->setText(light->GetPositional() ? tr("Lamp %1").arg(i + 1) : tr("Sun %1").arg(i + 1));
    item->setCheckState(light->GetSwitch() ? Qt::Checked : Qt::Unchecked);
  }
  this->List->setCurrentRow(this->Edited()->SelectedLightIndex());
  if (count == 0)
  {
    const bool dark = this->Edited()->Scene()->GetEnvironment() != nullptr;
    auto* item =
      new QListWidgetItem(dark ? tr("None: the environment alone shines")
                               : tr("None: the default sun shines, from %1\u00b0, %2\u00b0")
                                   .arg(parameters::UsualAzimuth)
                                   .arg(parameters::UsualAltitude));
    item->setFlags(Qt::NoItemFlags);
    this->List->addItem(item);
  }
  // All of a few lights are seen; many are scrolled.
  const int lines = std::max(2, std::min(count, 6));
  this->List->setFixedHeight(lines * this->List->sizeHintForRow(0) + 2 * this->List->frameWidth());
}

//------------------------------------------------------------------------------
void LightSection::AddSun()
{
  vtkReliefScene* scene = this->Edited()->Scene();
  this->Edited()->Edit(
    tr("Add sun"), [scene] { scene->AddSun(parameters::UsualAzimuth, parameters::UsualAltitude); });
  this->Edited()->SelectLight(scene->GetLights()->GetNumberOfItems() - 1);
}

//------------------------------------------------------------------------------
void LightSection::AddLamp()
{
  vtkReliefScene* scene = this->Edited()->Scene();
  const Field& field = this->Edited()->OpenedField();
  this->Edited()->Edit(tr("Add lamp"),
    [scene, &field]
    {
      // In the upper left, where cartographers have their light.
      vtkNew<vtkLight> lamp;
      lamp->SetLightTypeToSceneLight();
      lamp->PositionalOn();
      lamp->SetPosition(field.At(0, 0.25), field.At(1, 0.75),
        field.Mean * scene->GetHeightScale() + 0.3 * field.Size());
      scene->AddLight(lamp);
    });
  this->Edited()->SelectLight(scene->GetLights()->GetNumberOfItems() - 1);
}

//------------------------------------------------------------------------------
void LightSection::Remove()
{
  if (vtkLight* light = this->Edited()->SelectedLight())
  {
    this->Edited()->Edit(
      tr("Remove light"), [this, light] { this->Edited()->Scene()->RemoveLight(light); });
  }
}

//------------------------------------------------------------------------------
void LightSection::AddLightFields()
{
  const auto light = [this] { return this->Edited()->SelectedLight(); };
  this->AddChoice(
    { "lightKind", tr("Kind"), tr("A sun is infinitely far, a lamp stands at a place.") },
    { tr("Sun"), tr("Lamp") }, [=] { return light() && light()->GetPositional() ? 1 : 0; },
    [=](int kind)
    {
      if (kind != (light()->GetPositional() ? 1 : 0))
      {
        emit this->switchWanted();
      }
    });
  this->AddParameter(Owner::Light, "DiffuseColor", { QStringLiteral("lightColor") });
  FieldOptions intensity;
  intensity.Key = QStringLiteral("lightIntensity");
  intensity.Range = [] { return NumberRange{ 0.0, Unlimited, 0.0, 4.0, 2.0 }; };
  this->AddParameter(Owner::Light, "Intensity", intensity);
  this->ShowLastRowsOnlyIf([=] { return light() != nullptr; });
}

//------------------------------------------------------------------------------
bool LightSection::HasDiscs() const
{
  vtkLightCollection* lights = this->Edited()->Scene()->GetLights();
  bool any = false;
  for (int i = 0; i < lights->GetNumberOfItems(); ++i)
  {
    auto* light = vtkLight::SafeDownCast(lights->GetItemAsObject(i));
    any = any || (!light->GetPositional() && vtkReliefScene::GetAngularDiameter(light) > 0.0);
  }
  return any;
}

//------------------------------------------------------------------------------
std::array<double, 2> LightSection::SunAngles() const
{
  vtkLight* sun = this->Edited()->SelectedLight();
  if (!sun || sun->GetPositional())
  {
    return { 0.0, 0.0 };
  }
  double toward[3];
  vtkMath::Subtract(sun->GetPosition(), sun->GetFocalPoint(), toward);
  double azimuth;
  double altitude;
  vtkReliefAngles(toward, azimuth, altitude);
  if (toward[0] != 0.0 || toward[1] != 0.0)
  {
    this->Azimuth = roundedAngle(azimuth);
  }
  return { this->Azimuth, roundedAngle(altitude) };
}

//------------------------------------------------------------------------------
void LightSection::SetSunAngles(double azimuth, double altitude)
{
  vtkNew<vtkReliefScene> other;
  if (vtkLight* there = other->AddSun(azimuth, altitude))
  {
    vtkLight* sun = this->Edited()->SelectedLight();
    this->Azimuth = azimuth;
    sun->SetFocalPoint(there->GetFocalPoint());
    sun->SetPosition(there->GetPosition());
  }
}

//------------------------------------------------------------------------------
void LightSection::AddSunFields()
{
  vtkReliefScene* scene = this->Edited()->Scene();
  const auto light = [this] { return this->Edited()->SelectedLight(); };
  this
    ->AddNumber(
      { "sunAzimuth", tr("Azimuth"), tr("Clockwise from north.") },
      { -Unlimited, Unlimited, 0.0, 360.0 }, [this] { return this->SunAngles()[0]; },
      [this](double value) { this->SetSunAngles(value, this->SunAngles()[1]); })
    ->SetSuffix(QStringLiteral("\u00b0"));
  this
    ->AddNumber(
      { "sunAltitude", tr("Altitude"), tr("Above the horizon.") },
      [scene]
      {
        const double least = scene->GetMaterial()->GetUseFloor() ? -90.0 : 0.0;
        return NumberRange{ -90.0, 90.0, least, 90.0 };
      },
      [this] { return this->SunAngles()[1]; },
      [this](double value) { this->SetSunAngles(this->SunAngles()[0], value); })
    ->SetSuffix(QStringLiteral("\u00b0"));
  this->AddParameter(Owner::Light, "AngularDiameter", { QStringLiteral("sunDiameter") });
  this->ShowLastRowsOnlyIf([=] { return light() && !light()->GetPositional(); });
}

//------------------------------------------------------------------------------
double LightSection::LampCoordinate(int axis) const
{
  vtkLight* lamp = this->Edited()->SelectedLight();
  if (!lamp)
  {
    return 0.0;
  }
  const double value = lamp->GetPosition()[axis];
  return axis < 2 ? this->Edited()->OpenedField().Frame.CoordinateToMap(axis, value) : value;
}

//------------------------------------------------------------------------------
void LightSection::SetLampCoordinate(int axis, double value)
{
  vtkLight* lamp = this->Edited()->SelectedLight();
  double position[3];
  lamp->GetPosition(position);
  position[axis] =
    axis < 2 ? this->Edited()->OpenedField().Frame.CoordinateToHeights(axis, value) : value;
  lamp->SetPosition(position);
}

//------------------------------------------------------------------------------
void LightSection::AddLampFields()
{
  const auto light = [this] { return this->Edited()->SelectedLight(); };
  const QString names[2] = { tr("East (x)"), tr("North (y)") };
  for (int axis = 0; axis < 2; ++axis)
  {
    this
      ->AddNumber(
        { axis == 0 ? "lampX" : "lampY", names[axis],
          tr("In coordinates of the map, as reliefshade has them.") },
        [this, axis]
        {
          const Field& field = this->Edited()->OpenedField();
          const double length = field.Length(axis) > 0.0 ? field.Length(axis) : 1.0;
          const double begin = field.At(axis, 0.0);
          return NumberRange{ -Unlimited, Unlimited, field.Frame.CoordinateToMap(axis, begin),
            field.Frame.CoordinateToMap(axis, begin + length) };
        },
        [this, axis] { return this->LampCoordinate(axis); },
        [this, axis](double value) { this->SetLampCoordinate(axis, value); })
      ->SetDigits(9);
  }
  const auto ground = [this]
  { return this->Edited()->OpenedField().Mean * this->Edited()->Scene()->GetHeightScale(); };
  this->AddNumber(
    { "lampDistance", tr("Distance"),
      tr("How far the lamp is above the mean height of the relief.") },
    [this]
    {
      return NumberRange{ -Unlimited, Unlimited, 0.0, 2.0 * this->Edited()->OpenedField().Size(),
        2.0 };
    },
    [=] { return this->LampCoordinate(2) - ground(); },
    [=](double value) { this->SetLampCoordinate(2, value + ground()); });
  this->ShowLastRowsOnlyIf([=] { return light() && light()->GetPositional(); });
}

}
