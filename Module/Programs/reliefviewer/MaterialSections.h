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

private:
  void AddHeightScale();
  void AddDepth();
};

/// Highlights: k_s and their falloff.
class HighlightSection : public Section
{
  Q_OBJECT

public:
  HighlightSection(Document* document, QWidget* parent);
};

/// Light from behind: k_f, its falloff and the floor.
class ScatteringSection : public Section
{
  Q_OBJECT

public:
  ScatteringSection(Document* document, QWidget* parent);

private:
  void AddFloor();
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
