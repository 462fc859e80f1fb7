// SPDX-License-Identifier: BSD-3-Clause
#ifndef Document_h
#define Document_h

#include "Field.h"

#include "vtkNew.h"
#include "vtkReliefScene.h"

#include <QObject>
#include <QUndoStack>

#include <functional>
#include <string>

class vtkLight;

namespace reliefviewer
{

/// What is open: a height field and a scene. All that the viewer shows and its panel edits is in
/// the vtkReliefScene, and nowhere else. Steps for undo are the scene's text, as files have it.
class Document : public QObject
{
  Q_OBJECT

public:
  explicit Document(QObject* parent = nullptr);

  /// In the frame of the heights: lamps in the units of their spacing, from their first sample.
  vtkReliefScene* Scene() const { return this->EditedScene; }

  bool HasField() const { return this->OpenField.Heights.Heights != nullptr; }
  const Field& OpenedField() const { return this->OpenField; }
  QString FieldFile() const { return this->HeightsFile; }
  /// Lamps keep their place on the map, as they do for reliefshade.
  void SetField(const QString& file, Field field);

  /// Empty until a scene was read or written.
  QString SceneFile() const { return this->File; }
  /// These throw a Failure that names the file, and then change nothing.
  void ReadScene(const QString& file);
  void WriteScene(const QString& file);
  /// One sun in the north-west, the rest as by default.
  void NewScene();

  /// The scene as its file has it. Throws a Failure.
  std::string Text() const;
  /// Fills a scene, in the frame of the heights, from such a text. Throws a Failure.
  void FromText(const std::string& text, vtkReliefScene* scene) const;

  /// Changes the scene by one step for undo, or as part of the step that is under way.
  void Edit(const QString& what, const std::function<void()>& change);
  /// Scales the heights so that they span a tenth of the field's longer side. For files whose
  /// heights are in another unit than their spacing.
  void FitHeights();
  /// A step of many changes, such as the drag of a slider. Change tells of changes that were made
  /// from elsewhere.
  void StartStep();
  void Change();
  void EndStep(const QString& what);
  bool InStep() const { return this->StepUnderWay; }

  QUndoStack* Steps() { return &this->Undo; }

  /// The light that the panel edits; null if there is none.
  vtkLight* SelectedLight() const;
  int SelectedLightIndex() const { return this->Selected; }
  void SelectLight(int index);

signals:
  void fieldChanged();
  /// The scene is another than before, by whatever way.
  void changed();
  /// A step begins or ends: what is shown may be less exact in between.
  void stepping(bool on);
  void selectionChanged();
  /// A message for the user: the scene refused a change.
  void refused(const QString& message);

private:
  class Step;
  void Restore(const std::string& text);
  void Commit(const QString& what);
  /// Runs a step while the scene is as files have it, in the frame of the map.
  void OnMap(const std::function<void()>& step) const;
  void StartAnew(const QString& file);
  int NumberOfLights() const;

  vtkNew<vtkReliefScene> EditedScene;
  Field OpenField;
  QString HeightsFile;
  QString File;
  QUndoStack Undo;
  std::string Current; // the text after the last step
  bool StepUnderWay = false;
  int Selected = 0;
};

}

#endif
