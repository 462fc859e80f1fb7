// SPDX-License-Identifier: BSD-3-Clause
#ifndef Panel_h
#define Panel_h

#include <QScrollArea>

#include <vector>

namespace reliefviewer
{

class Document;
class EnvironmentSection;
class LightSection;
class Section;

/// All that can be changed of a scene, in sections that fold.
class Panel : public QScrollArea
{
  Q_OBJECT

public:
  explicit Panel(Document* document, QWidget* parent = nullptr);

  LightSection* Lights() const { return this->LightsPart; }
  EnvironmentSection* Environment() const { return this->EnvironmentPart; }

  /// Which sections are open, to be remembered.
  QStringList OpenSections() const;
  void SetOpenSections(const QStringList& names);

private:
  std::vector<Section*> Sections;
  LightSection* LightsPart;
  EnvironmentSection* EnvironmentPart;
};

}

#endif
