// SPDX-License-Identifier: BSD-3-Clause
#ifndef WheelGuard_h
#define WheelGuard_h

#include <QObject>

class QWidget;

namespace reliefviewer
{

/// Lets a widget have the wheel only while it has the focus: who scrolls the panel means to change
/// nothing that the mouse passes over.
class WheelGuard : public QObject
{
  Q_OBJECT

public:
  explicit WheelGuard(QWidget* widget);

  bool eventFilter(QObject* widget, QEvent* event) override;
};

}

#endif
