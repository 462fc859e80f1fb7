// SPDX-License-Identifier: BSD-3-Clause
#include "Panel.h"

#include "EnvironmentSection.h"
#include "LightSection.h"
#include "MaterialSections.h"

#include <QScrollBar>
#include <QVBoxLayout>

namespace reliefviewer
{

//------------------------------------------------------------------------------
Panel::Panel(Document* document, QWidget* parent)
  : QScrollArea(parent)
{
  auto* content = new QWidget(this);
  this->LightsPart = new LightSection(document, content);
  this->EnvironmentPart = new EnvironmentSection(document, content);
  auto* relief = new ReliefSection(document, content);
  auto* highlights = new HighlightSection(document, content);
  auto* scattering = new ScatteringSection(document, content);
  auto* accuracy = new AccuracySection(document, content);
  this->LightsPart->setObjectName(QStringLiteral("lightsSection"));
  this->EnvironmentPart->setObjectName(QStringLiteral("environmentSection"));
  relief->setObjectName(QStringLiteral("reliefSection"));
  highlights->setObjectName(QStringLiteral("highlightSection"));
  scattering->setObjectName(QStringLiteral("scatteringSection"));
  accuracy->setObjectName(QStringLiteral("accuracySection"));
  this->Sections = { relief, this->LightsPart, this->EnvironmentPart, highlights, scattering,
    accuracy };

  auto* layout = new QVBoxLayout(content);
  layout->setContentsMargins(2, 2, 2, 2);
  layout->setSpacing(2);
  for (Section* section : this->Sections)
  {
    layout->addWidget(section);
  }
  layout->addStretch(1);
  relief->SetOpen(true);
  this->LightsPart->SetOpen(true);

  this->setWidget(content);
  this->setWidgetResizable(true);
  this->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  this->setFrameShape(QFrame::NoFrame);
  content->ensurePolished();
  this->setMinimumWidth(
    content->minimumSizeHint().width() + this->verticalScrollBar()->sizeHint().width());

  const auto refresh = [this]
  {
    for (Section* section : this->Sections)
    {
      section->Refresh();
    }
  };
  connect(document, &Document::changed, this, refresh);
  refresh();
}

//------------------------------------------------------------------------------
QStringList Panel::OpenSections() const
{
  QStringList names;
  for (const Section* section : this->Sections)
  {
    if (section->IsOpen())
    {
      names += section->objectName();
    }
  }
  return names;
}

//------------------------------------------------------------------------------
void Panel::SetOpenSections(const QStringList& names)
{
  for (Section* section : this->Sections)
  {
    section->SetOpen(names.contains(section->objectName()));
  }
}

}
