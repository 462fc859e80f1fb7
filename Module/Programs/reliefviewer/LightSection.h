// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightSection_h
#define LightSection_h

#include "Section.h"

class QListWidget;
class QPushButton;

namespace reliefviewer
{

/// The lights: their list, and all of the selected one.
class LightSection : public Section
{
  Q_OBJECT

public:
  LightSection(Document* document, QWidget* parent);

  void AddSun();
  void AddLamp();
  void Remove();

signals:
  /// The selected light is to become a lamp, or a sun.
  void switchWanted();

private:
  void AddList();
  void AddLightFields();
  void AddSunFields();
  void AddLampFields();
  void RefreshList();
  /// Whether some sun has an angular diameter.
  bool HasDiscs() const;

  /// Of the selected light: azimuth clockwise from north, altitude, in degrees.
  std::array<double, 2> SunAngles() const;
  void SetSunAngles(double azimuth, double altitude);
  double LampCoordinate(int axis) const;
  void SetLampCoordinate(int axis, double value);

  QListWidget* List;
  QPushButton* RemoveButton;
  /// Of a sun in the zenith, which has none of its own: the last one that it had.
  mutable double Azimuth = relief::parameters::UsualAzimuth;
};

}

#endif
