// SPDX-License-Identifier: BSD-3-Clause
#include "NumberBox.h"

#include "WheelGuard.h"

#include <algorithm>
#include <cmath>

namespace reliefviewer
{

//------------------------------------------------------------------------------
NumberBox::NumberBox(QWidget* parent)
  : QDoubleSpinBox(parent)
{
  this->setDecimals(15);
  this->setKeyboardTracking(false);
  new WheelGuard(this);
  QLocale plain = this->locale();
  plain.setNumberOptions(QLocale::OmitGroupSeparator);
  this->setLocale(plain);
}

//------------------------------------------------------------------------------
QString NumberBox::textFromValue(double value) const
{
  return this->locale().toString(value, 'g', this->Digits);
}

//------------------------------------------------------------------------------
double NumberBox::Parse(QString text, bool& ok) const
{
  if (!this->suffix().isEmpty() && text.endsWith(this->suffix()))
  {
    text.chop(this->suffix().size());
  }
  const double value = this->locale().toDouble(text.trimmed(), &ok);
  ok = ok && std::isfinite(value);
  return value;
}

//------------------------------------------------------------------------------
double NumberBox::valueFromText(const QString& text) const
{
  if (!text.isEmpty() && text == this->specialValueText())
  {
    return this->minimum();
  }
  bool ok = false;
  const double value = this->Parse(text, ok);
  bool shown = false;
  // The text that stands for the value is the value, with the digits that are not shown.
  if (!ok || value == this->Parse(this->textFromValue(this->value()), shown))
  {
    return this->value();
  }
  return value;
}

//------------------------------------------------------------------------------
QValidator::State NumberBox::validate(QString& text, int&) const
{
  if (!text.isEmpty() && text == this->specialValueText())
  {
    return QValidator::Acceptable;
  }
  bool ok = false;
  const double value = this->Parse(text, ok);
  if (ok && value >= this->minimum() && value <= this->maximum())
  {
    return QValidator::Acceptable;
  }
  const QString allowed = QStringLiteral("+-eE. ") + this->locale().decimalPoint() + this->suffix();
  const bool possible = std::all_of(
    text.begin(), text.end(), [&allowed](QChar c) { return c.isDigit() || allowed.contains(c); });
  return possible ? QValidator::Intermediate : QValidator::Invalid;
}

//------------------------------------------------------------------------------
void NumberBox::stepBy(int steps)
{
  const double magnitude = std::max(std::abs(this->value()), this->Smallest);
  const double step = std::pow(10.0, std::floor(std::log10(magnitude) + 1e-9) - 1.0);
  // On a grid of steps, so that ten steps from 1 are 2 and not 2.0000000000000004.
  const double value = std::round(this->value() / step + steps) * step;
  this->setValue(QString::number(value, 'g', 12).toDouble());
  this->selectAll();
}

}
