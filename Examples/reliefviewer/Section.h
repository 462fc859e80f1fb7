// SPDX-License-Identifier: BSD-3-Clause
#ifndef Section_h
#define Section_h

#include "ColorButton.h"
#include "Document.h"
#include "NumberRow.h"

#include <QStringList>
#include <QWidget>

#include <functional>
#include <vector>

class QFormLayout;
class QLabel;
class QToolButton;

namespace reliefviewer
{

/// What a field of the panel is called.
struct FieldName
{
  /// The name of its widget.
  QString Key;
  QString Label;
  QString Tip;
};

/// A part of the panel under a heading that folds it. Its fields read what they show from the
/// document's scene, and write what the user enters to it.
class Section : public QWidget
{
  Q_OBJECT

public:
  Section(const QString& title, Document* document, QWidget* parent = nullptr);

  bool IsOpen() const;
  void SetOpen(bool open);

  /// Reads all fields from the scene.
  void Refresh();

protected:
  using Condition = std::function<bool()>;
  using Getter = std::function<double()>;
  using Setter = std::function<void(double)>;
  using ColourGetter = std::function<const double*()>;
  using ColourSetter = std::function<void(const double*)>;

  Document* Edited() const { return this->Shown; }
  QWidget* Body() const { return this->Fields; }

  NumberRow* AddNumber(const FieldName& name, std::function<NumberRange()> range, const Getter& get,
    const Setter& set);
  NumberRow* AddNumber(
    const FieldName& name, const NumberRange& range, const Getter& get, const Setter& set);
  /// A number between 0 and 1.
  NumberRow* AddShare(const FieldName& name, const Getter& get, const Setter& set);
  void AddColour(const FieldName& name, const ColourGetter& get, const ColourSetter& set);
  void AddCheck(
    const FieldName& name, const std::function<bool()>& get, const std::function<void(bool)>& set);
  void AddChoice(const FieldName& name, const QStringList& words, const std::function<int()>& get,
    const std::function<void(int)>& set);
  void AddWide(QWidget* widget);
  /// Rows that were added since the last call, or since the beginning, are only there on a
  /// condition.
  void ShowLastRowsOnlyIf(const Condition& condition);
  /// More to do in Refresh().
  void AddRefresher(const std::function<void()>& refresher)
  {
    this->Refreshers.push_back(refresher);
  }

private:
  QFormLayout* Rows();
  void AddRow(const FieldName& name, QWidget* widget);

  Document* Shown;
  QToolButton* Heading;
  QWidget* Fields;
  QWidget* Group = nullptr; // where rows are added; null before the first one
  std::vector<std::function<void()>> Refreshers;
};

}

#endif
