// SPDX-License-Identifier: BSD-3-Clause
#ifndef Section_h
#define Section_h

#include "ColorButton.h"
#include "Document.h"
#include "NumberRow.h"
#include "SceneParameters.h"

#include <QStringList>
#include <QWidget>

#include <functional>
#include <set>
#include <vector>

class QFormLayout;
class QLabel;
class QToolButton;
class vtkObject;

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

/// What a parameter's field has that the table of parameters does not say; all may be left out.
struct FieldOptions
{
  QString Key;   // of the widget: that of files
  QString Label; // the table's
  QString Tip;   // the table's
  std::function<NumberRange()> Range;
  std::function<double()> Get;
  std::function<void(double)> Set;
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
  using ColorGetter = std::function<const double*()>;
  using ColorSetter = std::function<void(const double*)>;

  Document* Edited() const { return this->Shown; }
  QWidget* Body() const { return this->Fields; }

  NumberRow* AddNumber(const FieldName& name, const std::function<NumberRange()>& range,
    const Getter& get, const Setter& set);
  NumberRow* AddNumber(
    const FieldName& name, const NumberRange& range, const Getter& get, const Setter& set);
  void AddColor(const FieldName& name, const ColorGetter& get, const ColorSetter& set);
  void AddCheck(
    const FieldName& name, const std::function<bool()>& get, const std::function<void(bool)>& set);
  void AddChoice(const FieldName& name, const QStringList& words, const std::function<int()>& get,
    const std::function<void(int)>& set);
  void AddWide(QWidget* widget);
  /// The field of a parameter, or the two of a range. It is there only while the parameter counts.
  void AddParameter(relief::parameters::Owner owner, const QString& name,
    const FieldOptions& options = FieldOptions());
  /// Those of the table that have no field yet: what is new in the table is in the panel as well.
  /// The names of their widgets begin with a prefix.
  void AddOtherParameters(relief::parameters::Owner owner, relief::parameters::Group group,
    const QString& prefix = QString());
  /// Where the section's rows are there at all. Default: always.
  void SetPresence(const Condition& present) { this->Present = present; }
  /// What a parameter belongs to; null if there is none.
  vtkObject* OwnerOf(const relief::parameters::Parameter& parameter) const;
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
  void AddField(const relief::parameters::Parameter& parameter, const FieldOptions& options);
  void AddNumberField(const relief::parameters::Parameter& parameter, const FieldName& name,
    const FieldOptions& options);
  void AddRangeFields(const relief::parameters::Parameter& parameter, const FieldOptions& options);
  Getter ComponentGetter(const relief::parameters::Parameter& parameter, int component) const;
  void SetComponents(
    const relief::parameters::Parameter& parameter, const relief::parameters::Values& values) const;

  Document* Shown;
  QToolButton* Heading;
  QWidget* Fields;
  QWidget* Group = nullptr; // where rows are added; null before the first one
  QWidget* Last = nullptr;  // that was added
  Condition Present = [] { return true; };
  std::set<const relief::parameters::Parameter*> Placed;
  std::vector<std::function<void()>> Refreshers;
};

}

#endif
