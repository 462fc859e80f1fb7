// SPDX-License-Identifier: BSD-3-Clause

// The fields of a Section that the table of parameters describes.

#include "Section.h"

#include "vtkLight.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <QVariant>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace reliefviewer
{

namespace parameters = relief::parameters;
using parameters::Parameter;
using parameters::Values;

namespace
{

/// Where tests find which parameters have fields.
const char* const ParameterProperty = "parameter";

QString identity(const Parameter& parameter)
{
  return QStringLiteral("%1.%2").arg(parameters::NameOf(parameter.Of), parameter.Name);
}

NumberRange rangeOf(const Parameter& parameter)
{
  const double most = NumberRange::Unlimited;
  return { std::max(parameter.Taken.Least, -most), std::min(parameter.Taken.Greatest, most),
    parameter.SliderFrom, parameter.SliderTo, parameter.SliderPower };
}

}

//------------------------------------------------------------------------------
vtkObject* Section::OwnerOf(const Parameter& parameter) const
{
  vtkReliefScene* scene = this->Shown->Scene();
  switch (parameter.Of)
  {
    case parameters::Owner::Scene:
      return scene;
    case parameters::Owner::Material:
      return scene->GetMaterial();
    case parameters::Owner::Environment:
      return scene->GetEnvironment();
    default:
      return this->Shown->SelectedLight();
  }
}

//------------------------------------------------------------------------------
Section::Getter Section::ComponentGetter(const Parameter& parameter, int component) const
{
  return [this, &parameter, component]
  {
    vtkObject* owner = this->OwnerOf(parameter);
    return owner ? parameter.Get(owner)[component] : parameter.Default[component];
  };
}

//------------------------------------------------------------------------------
void Section::SetComponents(const Parameter& parameter, const Values& values) const
{
  if (vtkObject* owner = this->OwnerOf(parameter))
  {
    parameter.Set(owner, values);
  }
}

//------------------------------------------------------------------------------
void Section::AddParameter(
  parameters::Owner owner, const QString& name, const FieldOptions& options)
{
  const Parameter& parameter = parameters::Find(owner, name.toStdString());
  const bool conditional = parameter.With != nullptr;
  if (conditional && this->Group)
  {
    this->ShowLastRowsOnlyIf(this->Present);
  }
  this->AddField(parameter, options);
  if (conditional)
  {
    this->ShowLastRowsOnlyIf(
      [this, &parameter]
      {
        return this->Present() && this->OwnerOf(parameter) &&
          parameters::Counts(parameter, this->OwnerOf(parameter));
      });
  }
}

//------------------------------------------------------------------------------
void Section::AddOtherParameters(
  parameters::Owner owner, parameters::Group group, const QString& prefix)
{
  for (const Parameter* parameter : parameters::Of(owner))
  {
    if (parameter->In == group && this->Placed.count(parameter) == 0)
    {
      FieldOptions options;
      options.Key = prefix.isEmpty() ? QString() : prefix + QLatin1String(parameter->Name);
      this->AddParameter(owner, QLatin1String(parameter->Name), options);
    }
  }
}

//------------------------------------------------------------------------------
void Section::AddField(const Parameter& parameter, const FieldOptions& options)
{
  this->Placed.insert(&parameter);
  const FieldName name{ options.Key.isEmpty() ? QString::fromStdString(parameter.Key) : options.Key,
    options.Label.isEmpty() ? tr(parameter.Label) : options.Label,
    options.Tip.isEmpty() ? tr(parameter.Help) + QLatin1Char('.') : options.Tip };
  const auto get = this->ComponentGetter(parameter, 0);
  const auto set = options.Set ? options.Set : [this, &parameter](double value) {
    this->SetComponents(parameter, { value, 0.0, 0.0 });
  };
  switch (parameter.Is)
  {
    case parameters::Kind::Flag:
      this->AddCheck(
        name, [get] { return get() != 0.0; }, set);
      break;
    case parameters::Kind::Choice:
    {
      QStringList labels;
      for (const parameters::Choice& choice : parameter.Choices)
      {
        labels += tr(choice.Label.c_str());
      }
      this->AddChoice(
        name, labels, [get] { return static_cast<int>(get()); }, set);
      break;
    }
    case parameters::Kind::Color:
    {
      // The button wants an address.
      auto color = std::make_shared<Values>();
      this->AddColor(
        name,
        [this, &parameter, color]
        {
          vtkObject* owner = this->OwnerOf(parameter);
          *color = owner ? parameter.Get(owner) : Values{ 0.0, 0.0, 0.0 };
          return color->data();
        },
        [this, &parameter](const double* c) {
          this->SetComponents(parameter, { c[0], c[1], c[2] });
        });
      break;
    }
    case parameters::Kind::Range:
      this->AddRangeFields(parameter, options);
      return;
    default:
      this->AddNumberField(parameter, name, options);
  }
  this->Last->setProperty(ParameterProperty, identity(parameter));
}

//------------------------------------------------------------------------------
void Section::AddNumberField(
  const Parameter& parameter, const FieldName& name, const FieldOptions& options)
{
  const bool length = parameter.Is == parameters::Kind::Length;
  const bool count = parameter.Is == parameters::Kind::Count;
  const Getter plain = options.Get ? options.Get : this->ComponentGetter(parameter, 0);
  // A field has no number for infinity: 0, which no such length is, stands for it.
  const Getter get =
    !length ? plain : Getter([plain] { return std::isinf(plain()) ? 0.0 : plain(); });
  const Setter set = options.Set
    ? options.Set
    : Setter(
        [this, &parameter, length, count](double value)
        {
          const double infinite = std::numeric_limits<double>::infinity();
          const double meant = length && value == 0.0 ? infinite
            : count                                   ? std::floor(value)
                                                      : value;
          this->SetComponents(parameter, { meant, 0.0, 0.0 });
        });
  NumberRow* row = this->AddNumber(
    name, options.Range ? options.Range : [&parameter] { return rangeOf(parameter); }, get, set);
  if (parameter.Unit == std::string("degrees"))
  {
    row->SetSuffix(QStringLiteral("\u00b0"));
  }
  if (length)
  {
    row->SetWordForLeast(tr("infinite"));
  }
}

//------------------------------------------------------------------------------
// Neither end can pass the other: it takes it along.
void Section::AddRangeFields(const Parameter& parameter, const FieldOptions& options)
{
  const QString key = options.Key.isEmpty() ? QString::fromStdString(parameter.Key) : options.Key;
  const QString tip = options.Tip.isEmpty() ? tr(parameter.Help) + QLatin1Char('.') : options.Tip;
  const auto range = [&parameter] { return rangeOf(parameter); };
  const Getter from = this->ComponentGetter(parameter, 0);
  const Getter to = this->ComponentGetter(parameter, 1);
  this->AddNumber({ key + QStringLiteral("From"), tr("Begins at"), tip }, range, from,
    [this, &parameter, to](double value) {
      this->SetComponents(parameter, { value, std::max(value, to()), 0.0 });
    });
  this->Last->setProperty(ParameterProperty, identity(parameter));
  this->AddNumber({ key + QStringLiteral("To"), tr("Full at"), tip }, range, to,
    [this, &parameter, from](double value) {
      this->SetComponents(parameter, { std::min(value, from()), value, 0.0 });
    });
  this->Last->setProperty(ParameterProperty, identity(parameter));
}

}
