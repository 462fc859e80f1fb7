// SPDX-License-Identifier: BSD-3-Clause
#include "WheelGuard.h"

#include <QEvent>
#include <QWidget>

namespace reliefviewer
{

//------------------------------------------------------------------------------
WheelGuard::WheelGuard(QWidget* widget)
  : QObject(widget)
{
  widget->setFocusPolicy(Qt::StrongFocus); // not by the wheel
  widget->installEventFilter(this);
}

//------------------------------------------------------------------------------
bool WheelGuard::eventFilter(QObject* widget, QEvent* event)
{
  if (event->type() == QEvent::Wheel && !static_cast<QWidget*>(widget)->hasFocus())
  {
    event->ignore();
    return true;
  }
  return false;
}

}
