// SPDX-License-Identifier: BSD-3-Clause
#ifndef ColorButton_h
#define ColorButton_h

#include <QPushButton>

#include <array>

namespace reliefviewer
{

/// A linear RGB colour, as scenes have it. A click opens a dialog whose choice is seen at once.
class ColorButton : public QPushButton
{
  Q_OBJECT

public:
  using Color = std::array<double, 3>;

  explicit ColorButton(QWidget* parent = nullptr);

  /// Shows a colour; tells nobody.
  void Show(const Color& linear);

signals:
  void edited(const std::array<double, 3>& linear);
  void pressedDialog();
  void releasedDialog();

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  void Choose();

  Color Linear{ 0.0, 0.0, 0.0 };
};

}

#endif
