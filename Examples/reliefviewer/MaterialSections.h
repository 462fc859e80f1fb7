// SPDX-License-Identifier: BSD-3-Clause
#ifndef MaterialSections_h
#define MaterialSections_h

#include "Section.h"

namespace reliefviewer
{

/// The relief itself: its height scale, its colours, and how deep light goes.
class ReliefSection : public Section
{
  Q_OBJECT

public:
  ReliefSection(Document* document, QWidget* parent);
};

/// What has a falloff: where it begins, where it is full, and how it gets there.
class FalloffSection : public Section
{
  Q_OBJECT

protected:
  FalloffSection(const QString& title, Document* document, QWidget* parent)
    : Section(title, document, parent)
  {
  }

  struct Falloff
  {
    std::function<const double*()> Range;
    std::function<void(double, double)> SetRange;
    Getter Power;
    Setter SetPower;
  };

  /// The names of the fields begin with `key`; `angle` says what the cosine is of.
  void AddFalloff(const QString& key, const QString& angle, const Falloff& falloff);
};

/// Highlights: k_s and their falloff.
class HighlightSection : public FalloffSection
{
  Q_OBJECT

public:
  HighlightSection(Document* document, QWidget* parent);
};

/// Light from behind: k_f, its falloff and the floor.
class ScatteringSection : public FalloffSection
{
  Q_OBJECT

public:
  ScatteringSection(Document* document, QWidget* parent);
};

/// How it is computed.
class AccuracySection : public Section
{
  Q_OBJECT

public:
  AccuracySection(Document* document, QWidget* parent);
};

}

#endif
