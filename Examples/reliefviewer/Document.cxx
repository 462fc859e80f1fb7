// SPDX-License-Identifier: BSD-3-Clause
#include "Document.h"

#include "Failure.h"
#include "MessageLog.h"

#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefScene.h"
#include "vtkReliefSceneFile.h"

#include <QElapsedTimer>
#include <QFile>

#include <algorithm>

namespace reliefviewer
{

using reliefshade::Failure;

//------------------------------------------------------------------------------
/// A change of the scene from one text to another.
class Document::Step : public QUndoCommand
{
public:
  Step(Document* document, const QString& what, std::string before, std::string after)
    : QUndoCommand(what)
    , Owner(document)
    , Before(std::move(before))
    , After(std::move(after))
  {
    this->Age.start();
  }

  int id() const override { return 1; }

  /// The same change again, within a second, is one step with it: turns of the wheel, held keys.
  bool mergeWith(const QUndoCommand* next) override
  {
    if (next->text() != this->text() || this->Age.elapsed() > 1000)
    {
      return false;
    }
    this->After = static_cast<const Step*>(next)->After;
    this->Age.restart();
    return true;
  }

  void undo() override { this->Apply(this->Before); }
  void redo() override
  {
    if (this->Done) // the first time it is there already
    {
      this->Apply(this->After);
    }
    this->Done = true;
  }

private:
  void Apply(const std::string& text)
  {
    try
    {
      this->Owner->Restore(text);
    }
    catch (const Failure& failure)
    {
      // The picture of the environment is gone: there is no way back, nor to what is saved.
      this->setObsolete(true);
      this->Owner->Undo.resetClean();
      emit this->Owner->refused(failure.what());
    }
  }

  Document* Owner;
  std::string Before;
  std::string After;
  QElapsedTimer Age;
  bool Done = false;
};

//------------------------------------------------------------------------------
Document::Document(QObject* parent)
  : QObject(parent)
{
  this->NewScene();
}

//------------------------------------------------------------------------------
int Document::NumberOfLights() const
{
  return this->EditedScene->GetLights()->GetNumberOfItems();
}

//------------------------------------------------------------------------------
void Document::SetField(const QString& file, Field field)
{
  this->OpenField.Frame.ToMap(this->EditedScene);
  this->OpenField = std::move(field);
  this->HeightsFile = file;
  this->OpenField.Frame.ToHeights(this->EditedScene);
  emit this->fieldChanged();
  emit this->changed();
}

//------------------------------------------------------------------------------
void Document::ReadScene(const QString& file)
{
  const std::string name = QFile::encodeName(file).toStdString();
  vtkNew<vtkReliefSceneFile> reader;
  reader->SetFileName(name.c_str());
  reader->SetScene(this->EditedScene);
  if (!reader->Read())
  {
    throw Failure(name, reliefshade::withoutName(reliefshade::takeError(), name));
  }
  this->OpenField.Frame.ToHeights(this->EditedScene);
  this->StartAnew(file);
}

//------------------------------------------------------------------------------
void Document::WriteScene(const QString& file)
{
  const std::string name = QFile::encodeName(file).toStdString();
  vtkNew<vtkReliefSceneFile> writer;
  writer->SetFileName(name.c_str());
  writer->SetScene(this->EditedScene);
  bool written = false;
  this->OnMap([&] { written = writer->Write(); });
  if (!written)
  {
    throw Failure(name, reliefshade::withoutName(reliefshade::takeError(), name));
  }
  this->File = file;
  this->Undo.setClean();
  emit this->changed();
}

//------------------------------------------------------------------------------
void Document::NewScene()
{
  vtkNew<vtkReliefSceneFile> text;
  text->SetScene(this->EditedScene);
  text->FromText(
    R"({"reliefScene": 1, "lights": [{"kind": "sun", "azimuth": 315, "altitude": 45}]})");
  this->OpenField.Frame.ToHeights(this->EditedScene);
  this->StartAnew(QString());
}

//------------------------------------------------------------------------------
void Document::StartAnew(const QString& file)
{
  this->File = file;
  if (std::exchange(this->StepUnderWay, false))
  {
    emit this->stepping(false);
  }
  this->Selected = 0;
  this->Current = this->Text();
  this->Undo.clear();
  emit this->changed();
  emit this->selectionChanged();
}

//------------------------------------------------------------------------------
void Document::OnMap(const std::function<void()>& step) const
{
  vtkReliefScene* scene = this->EditedScene;
  std::vector<std::array<double, 3>> positions;
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    positions.push_back({});
    light->GetPosition(positions.back().data());
  }
  const double heightScale = scene->GetHeightScale();

  this->OpenField.Frame.ToMap(scene);
  step();

  scene->SetHeightScale(heightScale);
  auto position = positions.begin();
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    light->SetPosition((position++)->data());
  }
}

//------------------------------------------------------------------------------
std::string Document::Text() const
{
  vtkNew<vtkReliefSceneFile> file;
  file->SetScene(this->EditedScene);
  std::string text;
  this->OnMap([&] { text = file->ToText(); });
  if (text.empty())
  {
    throw Failure("", reliefshade::takeError());
  }
  return text;
}

//------------------------------------------------------------------------------
void Document::FromText(const std::string& text, vtkReliefScene* scene) const
{
  vtkNew<vtkReliefSceneFile> file;
  file->SetScene(scene);
  if (!file->FromText(text))
  {
    throw Failure("", reliefshade::takeError());
  }
  this->OpenField.Frame.ToHeights(scene);
}

//------------------------------------------------------------------------------
void Document::Restore(const std::string& text)
{
  this->FromText(text, this->EditedScene);
  this->Current = text;
  this->SelectLight(this->Selected);
  emit this->changed();
}

//------------------------------------------------------------------------------
void Document::Edit(const QString& what, const std::function<void()>& change)
{
  change();
  this->Change();
  if (!this->StepUnderWay)
  {
    this->Commit(what);
  }
}

//------------------------------------------------------------------------------
void Document::FitHeights()
{
  const double exact = this->OpenField.FittingScale();
  if (exact == 0.0)
  {
    emit this->refused(tr("The relief is flat: no scale makes its heights span anything"));
    return;
  }
  // Two digits are enough, and read well.
  const double scale =
    QString::number(exact, 'g', 2).toDouble() * this->OpenField.Heights.HeightUnit;
  this->Edit(tr("Fit heights"), [this, scale] { this->EditedScene->SetHeightScale(scale); });
}

//------------------------------------------------------------------------------
void Document::StartStep()
{
  if (!this->StepUnderWay)
  {
    this->StepUnderWay = true;
    emit this->stepping(true);
  }
}

//------------------------------------------------------------------------------
void Document::Change()
{
  this->SelectLight(this->Selected);
  if (reliefshade::hasError())
  {
    emit this->refused(QString::fromStdString(reliefshade::takeError()));
  }
  emit this->changed();
}

//------------------------------------------------------------------------------
void Document::EndStep(const QString& what)
{
  if (this->StepUnderWay)
  {
    this->StepUnderWay = false;
    this->Commit(what);
    emit this->stepping(false);
  }
}

//------------------------------------------------------------------------------
void Document::Commit(const QString& what)
{
  std::string text;
  try
  {
    text = this->Text();
  }
  catch (const Failure& failure)
  {
    emit this->refused(failure.what()); // a number that no file holds
    return;
  }
  if (text != this->Current)
  {
    std::string before = std::exchange(this->Current, std::move(text));
    this->Undo.push(new Step(this, what, std::move(before), this->Current));
  }
}

//------------------------------------------------------------------------------
vtkLight* Document::SelectedLight() const
{
  return vtkLight::SafeDownCast(this->EditedScene->GetLights()->GetItemAsObject(this->Selected));
}

//------------------------------------------------------------------------------
void Document::SelectLight(int index)
{
  const int selected = std::max(0, std::min(index, this->NumberOfLights() - 1));
  if (selected != this->Selected)
  {
    this->Selected = selected;
    emit this->selectionChanged();
  }
}

}
