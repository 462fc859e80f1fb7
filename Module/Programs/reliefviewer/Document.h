// SPDX-License-Identifier: BSD-3-Clause
#ifndef Document_h
#define Document_h

#include "Field.h"

#include "vtkNew.h"
#include "vtkReliefScene.h"
#include "vtkSmartPointer.h"

#include <QObject>
#include <QUndoStack>

#include <functional>
#include <string>

class vtkLight;

namespace reliefviewer
{

/// What is open: a height field and a scene. All that the viewer shows and its panel edits is in
/// the vtkReliefScene, and nowhere else. Steps for undo are copies of the scene, with its lamps on
/// the map, so that they outlive another field.
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
  /// Lamps keep their place on the map, as they do for reliefshade. Heights get the field's usual
  /// scale if those before had theirs, unless a scene's file named it; steps for undo as well.
  void SetField(const QString& file, Field field);
  /// The same field with another mask, or none. The scene stays, and so do its steps: like the
  /// heights, a mask is none of them.
  void SetMasked(Field field);

  /// Empty until a scene was read or written.
  QString SceneFile() const { return this->File; }
  /// These throw a Failure that names the file, and then change nothing.
  void ReadScene(const QString& file);
  void WriteScene(const QString& file);
  /// Throws a Failure if saving under that name would replace what is open: the field, its mask,
  /// the picture of the environment or, unless it is the scene that is saved, its file.
  void CheckTarget(const QString& file, bool isScene) const;
  /// One sun in the north-west, the rest as by default.
  void NewScene();

  /// The scene as its file has it. Throws a Failure.
  std::string Text() const;
  /// Makes another scene the same as reliefshade gets it, in the frame of the heights. It shares
  /// nothing with the one that is shown.
  void CopyTo(vtkReliefScene* scene) const;

  /// Changes the scene by one step for undo, or as part of the step that is under way.
  void Edit(const QString& what, const std::function<void()>& change);
  /// Scales the heights for a good first picture, as reliefshade --height-scale auto does.
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
  void maskChanged();
  /// The scene is another than before, by whatever way.
  void changed();
  /// A step begins or ends: what is shown may be less exact in between.
  void stepping(bool on);
  void selectionChanged();
  /// A message for the user: what was chosen for him.
  void told(const QString& message);
  /// A message for the user: the scene refused a change.
  void refused(const QString& message);

private:
  class Step;
  using Copy = vtkSmartPointer<vtkReliefScene>;
  /// The scene as files have it, in the frame of the map.
  Copy OnMap() const;
  void Restore(const Copy& copy);
  void Commit(const QString& what);
  void StartAnew(const QString& file);
  void UseUsualScale(double before);
  int NumberOfLights() const;

  vtkNew<vtkReliefScene> EditedScene;
  Field OpenField;
  QString HeightsFile;
  QString File;
  QUndoStack Undo;
  Copy Current; // after the last step
  bool StepUnderWay = false;
  bool ScaleIsNamed = false; // by the scene's file
  int Selected = 0;
};

}

#endif
