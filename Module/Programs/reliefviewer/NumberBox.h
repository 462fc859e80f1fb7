// SPDX-License-Identifier: BSD-3-Clause
#ifndef NumberBox_h
#define NumberBox_h

#include <QDoubleSpinBox>

namespace reliefviewer
{

/// A field for any number: shown in short, kept exact, and stepped by a tenth of its magnitude.
class NumberBox : public QDoubleSpinBox
{
  Q_OBJECT

public:
  explicit NumberBox(QWidget* parent = nullptr);

  /// The magnitude of steps from 0.
  void SetSmallest(double value) { this->Smallest = value; }
  /// Significant digits that are shown. Default: 6.
  void SetDigits(int digits) { this->Digits = digits; }

  QString textFromValue(double value) const override;
  double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& position) const override;
  void stepBy(int steps) override;

private:
  double Parse(QString text, bool& ok) const;

  double Smallest = 0.01;
  int Digits = 6;
};

}

#endif
