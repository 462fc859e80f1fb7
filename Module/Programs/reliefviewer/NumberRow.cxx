// SPDX-License-Identifier: BSD-3-Clause
#include "NumberRow.h"

#include "NumberBox.h"
#include "WheelGuard.h"

#include <QHBoxLayout>
#include <QMouseEvent>
#include <QSignalBlocker>
#include <QSlider>
#include <QStyle>

#include <algorithm>
#include <cmath>

namespace reliefviewer
{

namespace
{
constexpr int Positions = 1000;

/// Its handle comes to where it is clicked.
class Slider : public QSlider
{
public:
  explicit Slider(QWidget* parent)
    : QSlider(Qt::Horizontal, parent)
  {
    this->setRange(0, Positions);
    this->setSingleStep(Positions / 100);
    this->setPageStep(Positions / 10);
    new WheelGuard(this);
  }

protected:
  void mousePressEvent(QMouseEvent* event) override
  {
    if (event->button() == Qt::LeftButton)
    {
      const int handle = this->style()->pixelMetric(QStyle::PM_SliderLength, nullptr, this);
      const int way = std::max(this->width() - handle, 1);
      const int position = QStyle::sliderValueFromPosition(0, Positions,
        event->pos().x() - handle / 2, way, this->layoutDirection() == Qt::RightToLeft);
      this->setSliderDown(true);
      this->setSliderPosition(position);
      event->accept();
      this->Grabbed = true;
      return;
    }
    QSlider::mousePressEvent(event);
  }
  void mouseMoveEvent(QMouseEvent* event) override
  {
    if (this->Grabbed)
    {
      const int handle = this->style()->pixelMetric(QStyle::PM_SliderLength, nullptr, this);
      const int way = std::max(this->width() - handle, 1);
      this->setSliderPosition(QStyle::sliderValueFromPosition(0, Positions,
        event->pos().x() - handle / 2, way, this->layoutDirection() == Qt::RightToLeft));
    }
  }
  void mouseReleaseEvent(QMouseEvent* event) override
  {
    if (this->Grabbed && event->button() == Qt::LeftButton)
    {
      this->Grabbed = false;
      this->setSliderDown(false);
    }
  }

private:
  bool Grabbed = false;
};
}

//------------------------------------------------------------------------------
NumberRow::NumberRow(QWidget* parent)
  : QWidget(parent)
  , Way(new Slider(this))
  , Box(new NumberBox(this))
{
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Way, 1);
  layout->addWidget(this->Box);
  this->Box->setFixedWidth(
    this->fontMetrics().horizontalAdvance(QStringLiteral("-0.000123 m")) + 28);
  this->Way->setMinimumWidth(40); // on a small screen the picture wants room
  this->setFocusProxy(this->Box);
  this->Way->setObjectName(QStringLiteral("slider"));
  this->Box->setObjectName(QStringLiteral("box"));
  connect(this->Way, &QSlider::sliderPressed, this, &NumberRow::pressed);
  connect(this->Way, &QSlider::sliderReleased, this, &NumberRow::released);
  connect(this->Way, &QSlider::valueChanged, this,
    [this](int position) { emit this->edited(this->SliderValue(position)); });
  connect(
    this->Box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &NumberRow::edited);
  this->SetRange(NumberRange());
}

//------------------------------------------------------------------------------
void NumberRow::SetRange(const NumberRange& range)
{
  const QSignalBlocker quiet(this->Box);
  this->Range = range;
  this->Box->setRange(range.Least, range.Greatest);
  this->Box->SetSmallest(0.01 * (range.SliderTo - range.SliderFrom));
}

//------------------------------------------------------------------------------
// To three digits of the slider's length: what it gives should read well.
double NumberRow::SliderValue(int position) const
{
  const double way = static_cast<double>(position) / Positions;
  const double length = this->Range.SliderTo - this->Range.SliderFrom;
  const double value = this->Range.SliderFrom + length * std::pow(way, this->Range.Power);
  const double reach = this->Range.Power > 1.0
    ? std::abs(value)
    : std::max(std::abs(this->Range.SliderFrom), std::abs(this->Range.SliderTo));
  if (!(reach > 0.0))
  {
    return value;
  }
  const double perUnit = std::pow(10.0, 2.0 - std::floor(std::log10(reach)));
  const double rounded = std::round(value * perUnit) / perUnit;
  return std::max(this->Range.Least, std::min(rounded, this->Range.Greatest));
}

//------------------------------------------------------------------------------
void NumberRow::Show(double value)
{
  const QSignalBlocker quietWay(this->Way);
  const QSignalBlocker quietBox(this->Box);
  if (this->Box->value() != value)
  {
    this->Box->setValue(value);
  }
  const double share =
    (value - this->Range.SliderFrom) / (this->Range.SliderTo - this->Range.SliderFrom);
  if (!this->Way->isSliderDown())
  {
    const double way = std::pow(std::max(0.0, std::min(share, 1.0)), 1.0 / this->Range.Power);
    this->Way->setValue(static_cast<int>(std::lround(way * Positions)));
  }
}

//------------------------------------------------------------------------------
void NumberRow::SetSuffix(const QString& suffix)
{
  this->Box->setSuffix(suffix);
}

//------------------------------------------------------------------------------
void NumberRow::SetDigits(int digits)
{
  this->Box->SetDigits(digits);
}

//------------------------------------------------------------------------------
void NumberRow::SetWordForLeast(const QString& word)
{
  this->Box->setSpecialValueText(word);
}

//------------------------------------------------------------------------------
void NumberRow::HideSlider()
{
  this->Way->hide();
  static_cast<QHBoxLayout*>(this->layout())->addStretch(1);
}

}
