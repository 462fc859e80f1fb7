// SPDX-License-Identifier: BSD-3-Clause
#ifndef NumberRow_h
#define NumberRow_h

#include <QWidget>

#include <limits>

class QSlider;

namespace reliefviewer
{

class NumberBox;

/// Which numbers a row takes, and which of them its slider reaches.
struct NumberRange
{
  double Least = 0.0;
  double Greatest = 1.0;
  double SliderFrom = 0.0;
  double SliderTo = 1.0;
  /// The slider's value goes with this power of its way: above 1 it is finer near its beginning.
  double Power = 1.0;

  static constexpr double Unlimited = std::numeric_limits<double>::max();
};

/// A number: a slider, and a field for those who know what they want. It keeps no value of its own
/// beyond what it shows.
class NumberRow : public QWidget
{
  Q_OBJECT

public:
  explicit NumberRow(QWidget* parent = nullptr);

  void SetRange(const NumberRange& range);
  /// Shows a value; tells nobody.
  void Show(double value);
  void SetSuffix(const QString& suffix);
  void SetDigits(int digits);
  void HideSlider();
  /// Shown in place of the least number.
  void SetWordForLeast(const QString& word);

signals:
  /// The user changes the value: once, or again and again between pressed and released.
  void edited(double value);
  void pressed();
  void released();

private:
  double SliderValue(int position) const;

  NumberRange Range;
  QSlider* Way;
  NumberBox* Box;
};

}

#endif
