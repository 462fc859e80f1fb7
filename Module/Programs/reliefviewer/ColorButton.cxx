// SPDX-License-Identifier: BSD-3-Clause
#include "ColorButton.h"

#include <QColorDialog>
#include <QColorSpace>
#include <QPainter>
#include <QPainterPath>
#include <QStyleOptionFocusRect>

#include <algorithm>

namespace reliefviewer
{

namespace
{

QColor toScreen(const ColorButton::Color& linear)
{
  const auto clamped = [&linear](int i)
  { return static_cast<float>(std::max(0.0, std::min(linear[i], 1.0))); };
  return QColorSpace(QColorSpace::SRgbLinear)
    .transformationToColorSpace(QColorSpace::SRgb)
    .map(QColor::fromRgbF(clamped(0), clamped(1), clamped(2)));
}

ColorButton::Color toLinear(const QColor& screen)
{
  const QColor linear = QColorSpace(QColorSpace::SRgb)
                          .transformationToColorSpace(QColorSpace::SRgbLinear)
                          .map(screen.toRgb());
  return { linear.redF(), linear.greenF(), linear.blueF() };
}

}

//------------------------------------------------------------------------------
ColorButton::ColorButton(QWidget* parent)
  : QPushButton(parent)
{
  this->setMinimumWidth(48);
  connect(this, &QPushButton::clicked, this, &ColorButton::Choose);
}

//------------------------------------------------------------------------------
void ColorButton::Show(const Color& linear)
{
  this->Linear = linear;
  this->setToolTip(tr("Linear red %1, green %2, blue %3")
                     .arg(linear[0], 0, 'g', 3)
                     .arg(linear[1], 0, 'g', 3)
                     .arg(linear[2], 0, 'g', 3));
  this->update();
}

//------------------------------------------------------------------------------
void ColorButton::Choose()
{
  const Color before = this->Linear;
  const QColor shown = toScreen(before);
  QColorDialog dialog(shown, this->window());
  dialog.setOption(QColorDialog::DontUseNativeDialog);
  dialog.setWindowTitle(this->accessibleName());
  emit this->pressedDialog();
  connect(&dialog, &QColorDialog::currentColorChanged, this,
    [this, &before, shown](const QColor& chosen)
    { emit this->edited(chosen.rgb() == shown.rgb() ? before : toLinear(chosen)); });
  if (dialog.exec() != QDialog::Accepted)
  {
    emit this->edited(before);
  }
  emit this->releasedDialog();
}

//------------------------------------------------------------------------------
void ColorButton::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath outline;
  outline.addRoundedRect(QRectF(this->rect()).adjusted(1.5, 1.5, -1.5, -1.5), 4.0, 4.0);
  const QColor color = toScreen(this->Linear);
  painter.fillPath(outline, this->isEnabled() ? color : this->palette().color(QPalette::Window));
  const bool marked = this->hasFocus() || this->underMouse();
  painter.setPen(this->palette().color(marked ? QPalette::Highlight : QPalette::Mid));
  painter.drawPath(outline);
}

}
