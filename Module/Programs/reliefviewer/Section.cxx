// SPDX-License-Identifier: BSD-3-Clause
#include "Section.h"

#include "WheelGuard.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

#include <utility>

namespace reliefviewer
{

namespace
{

/// The name of the step that a field's change makes.
QString stepName(const FieldName& name)
{
  return Section::tr("Change %1").arg(name.Label.toLower());
}

}

//------------------------------------------------------------------------------
Section::Section(const QString& title, Document* document, QWidget* parent)
  : QWidget(parent)
  , Shown(document)
  , Heading(new QToolButton(this))
  , Fields(new QWidget(this))
{
  this->Heading->setText(title);
  this->Heading->setCheckable(true);
  this->Heading->setStyleSheet(QStringLiteral(
    "QToolButton { border: none; border-radius: 3px; padding: 4px; font-weight: bold;"
    " background: palette(midlight); }"
    "QToolButton:hover, QToolButton:focus { background: palette(mid); }"));
  this->Heading->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  this->Heading->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  this->Heading->setObjectName(QStringLiteral("heading"));
  connect(this->Heading, &QToolButton::toggled, this,
    [this](bool open)
    {
      this->Heading->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
      this->Fields->setVisible(open);
    });
  this->Heading->setArrowType(Qt::RightArrow);
  this->Fields->hide();

  auto* groups = new QVBoxLayout(this->Fields);
  groups->setContentsMargins(10, 5, 6, 8);
  groups->setSpacing(5);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(this->Heading);
  layout->addWidget(this->Fields);
}

//------------------------------------------------------------------------------
bool Section::IsOpen() const
{
  return this->Heading->isChecked();
}

//------------------------------------------------------------------------------
void Section::SetOpen(bool open)
{
  this->Heading->setChecked(open);
}

//------------------------------------------------------------------------------
void Section::Refresh()
{
  for (const auto& refresher : this->Refreshers)
  {
    refresher();
  }
}

//------------------------------------------------------------------------------
// Each group of rows is a widget: rows that are hidden one by one would leave gaps.
QFormLayout* Section::Rows()
{
  if (!this->Group)
  {
    this->Group = new QWidget(this->Fields);
    auto* rows = new QFormLayout(this->Group);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    rows->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    rows->setVerticalSpacing(5);
    this->Fields->layout()->addWidget(this->Group);
  }
  return static_cast<QFormLayout*>(this->Group->layout());
}

//------------------------------------------------------------------------------
void Section::AddRow(const FieldName& name, QWidget* widget)
{
  auto* label = new QLabel(name.Label, this->Fields);
  // One column for the labels of all sections.
  label->setFixedWidth(this->fontMetrics().horizontalAdvance(QStringLiteral("Scattering depth")));
  label->setToolTip(name.Tip);
  label->setBuddy(widget);
  widget->setObjectName(name.Key);
  widget->setToolTip(name.Tip);
  widget->setAccessibleName(name.Label);
  this->Rows()->addRow(label, widget);
  this->Last = widget;
}

//------------------------------------------------------------------------------
void Section::AddWide(QWidget* widget)
{
  this->Rows()->addRow(widget);
}

//------------------------------------------------------------------------------
void Section::ShowLastRowsOnlyIf(const Condition& condition)
{
  QWidget* group = std::exchange(this->Group, nullptr);
  this->AddRefresher([group, condition] { group->setVisible(condition()); });
}

//------------------------------------------------------------------------------
NumberRow* Section::AddNumber(const FieldName& name, const std::function<NumberRange()>& range,
  const Getter& get, const Setter& set)
{
  auto* row = new NumberRow(this->Fields);
  this->AddRow(name, row);
  connect(row, &NumberRow::pressed, this->Shown, &Document::StartStep);
  connect(row, &NumberRow::edited, this->Shown,
    [this, name, set](double value)
    { this->Shown->Edit(stepName(name), [&set, value] { set(value); }); });
  connect(
    row, &NumberRow::released, this->Shown, [this, name] { this->Shown->EndStep(stepName(name)); });
  this->AddRefresher(
    [row, range, get]
    {
      row->SetRange(range());
      row->Show(get());
    });
  return row;
}

//------------------------------------------------------------------------------
NumberRow* Section::AddNumber(
  const FieldName& name, const NumberRange& range, const Getter& get, const Setter& set)
{
  return this->AddNumber(
    name, [range] { return range; }, get, set);
}

//------------------------------------------------------------------------------
void Section::AddColor(const FieldName& name, const ColorGetter& get, const ColorSetter& set)
{
  auto* button = new ColorButton(this->Fields);
  this->AddRow(name, button);
  connect(button, &ColorButton::pressedDialog, this->Shown, &Document::StartStep);
  connect(button, &ColorButton::edited, this->Shown,
    [this, name, set](const ColorButton::Color& color)
    { this->Shown->Edit(stepName(name), [&set, &color] { set(color.data()); }); });
  connect(button, &ColorButton::releasedDialog, this->Shown,
    [this, name] { this->Shown->EndStep(stepName(name)); });
  this->AddRefresher(
    [button, get]
    {
      const double* color = get();
      button->Show({ color[0], color[1], color[2] });
    });
}

//------------------------------------------------------------------------------
void Section::AddCheck(
  const FieldName& name, const std::function<bool()>& get, const std::function<void(bool)>& set)
{
  auto* box = new QCheckBox(this->Fields);
  this->AddRow(name, box);
  connect(box, &QCheckBox::clicked, this->Shown,
    [this, name, set](bool on) { this->Shown->Edit(stepName(name), [&set, on] { set(on); }); });
  this->AddRefresher([box, get] { box->setChecked(get()); });
}

//------------------------------------------------------------------------------
void Section::AddChoice(const FieldName& name, const QStringList& words,
  const std::function<int()>& get, const std::function<void(int)>& set)
{
  auto* box = new QComboBox(this->Fields);
  box->addItems(words);
  new WheelGuard(box);
  this->AddRow(name, box);
  connect(box, QOverload<int>::of(&QComboBox::activated), this->Shown,
    [this, name, set](int choice)
    { this->Shown->Edit(stepName(name), [&set, choice] { set(choice); }); });
  this->AddRefresher([box, get] { box->setCurrentIndex(get()); });
}

}
