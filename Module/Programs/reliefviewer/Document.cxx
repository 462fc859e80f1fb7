// SPDX-License-Identifier: BSD-3-Clause
#include "Document.h"

#include "Failure.h"
#include "MessageLog.h"
#include "OutputFile.h"
#include "SceneParameters.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefSceneFile.h"

#include <QElapsedTimer>
#include <QFile>

#include <algorithm>

namespace reliefviewer
{

using reliefshade::Failure;
namespace parameters = relief::parameters;

namespace
{

std::string encoded(const QString& file)
{
  return QFile::encodeName(file).toStdString();
}

bool sameLight(vtkLight* a, vtkLight* b)
{
  double placeA[6];
  double placeB[6];
  a->GetTransformedPosition(placeA);
  b->GetTransformedPosition(placeB);
  a->GetTransformedFocalPoint(placeA + 3);
  b->GetTransformedFocalPoint(placeB + 3);
  return a->GetPositional() == b->GetPositional() && std::equal(placeA, placeA + 6, placeB) &&
    parameters::Same(a, b);
}

/// Skies that were made anew are the same where they are made of the same.
bool sameImage(vtkReliefEnvironment* a, vtkReliefEnvironment* b)
{
  const int source = a->GetImageSource();
  const double* made = a->GetClearSkyParameters();
  return source == b->GetImageSource() &&
    (source == vtkReliefEnvironment::WhiteDome ||
      (source == vtkReliefEnvironment::ClearSky &&
        std::equal(made, made + 3, b->GetClearSkyParameters())) ||
      a->GetImage() == b->GetImage());
}

/// Whether two scenes give the same picture.
bool sameScene(vtkReliefScene* a, vtkReliefScene* b)
{
  vtkReliefEnvironment* skyA = a->GetEnvironment();
  vtkReliefEnvironment* skyB = b->GetEnvironment();
  if (!parameters::Same(a, b) || !parameters::Same(a->GetMaterial(), b->GetMaterial()) ||
    a->GetLights()->GetNumberOfItems() != b->GetLights()->GetNumberOfItems() || !skyA != !skyB)
  {
    return false;
  }
  for (int i = 0; i < a->GetLights()->GetNumberOfItems(); ++i)
  {
    if (!sameLight(vtkLight::SafeDownCast(a->GetLights()->GetItemAsObject(i)),
          vtkLight::SafeDownCast(b->GetLights()->GetItemAsObject(i))))
    {
      return false;
    }
  }
  return !skyA || (sameImage(skyA, skyB) && parameters::Same(skyA, skyB));
}

}

//------------------------------------------------------------------------------
/// A change of the scene from one copy to another.
class Document::Step : public QUndoCommand
{
public:
  Step(Document* document, const QString& what, Copy before, Copy after)
    : QUndoCommand(what)
    , Owner(document)
    , Before(std::move(before))
    , After(std::move(after))
  {
    this->Age.start();
  }

  int id() const override { return 1; }

  /// Another height scale for scenes that have the one before.
  void Rescale(double before, double after) const
  {
    for (vtkReliefScene* scene : { this->Before.Get(), this->After.Get() })
    {
      scene->SetHeightScale(scene->GetHeightScale() == before ? after : scene->GetHeightScale());
    }
  }

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

  void undo() override { this->Owner->Restore(this->Before); }
  void redo() override
  {
    if (this->Done) // the first time it is there already
    {
      this->Owner->Restore(this->After);
    }
    this->Done = true;
  }

private:
  Document* Owner;
  Copy Before;
  Copy After;
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
  const double usual = this->OpenField.UsualScale;
  this->OpenField.Frame.ToMap(this->EditedScene);
  this->OpenField = std::move(field);
  this->HeightsFile = file;
  if (!this->ScaleIsNamed)
  {
    this->UseUsualScale(usual);
  }
  this->OpenField.Frame.ToHeights(this->EditedScene);
  emit this->fieldChanged();
  emit this->changed();
}

//------------------------------------------------------------------------------
void Document::SetMasked(Field field)
{
  this->OpenField = std::move(field);
  emit this->maskChanged();
  emit this->changed();
}

//------------------------------------------------------------------------------
// While the scene that is edited is in the frame of the map.
void Document::UseUsualScale(double before)
{
  const double after = this->OpenField.UsualScale;
  if (this->EditedScene->GetHeightScale() == before && after != 1.0)
  {
    emit this->told(tr("The heights have no unit: height scale %1 is taken").arg(after));
  }
  for (vtkReliefScene* scene : { this->EditedScene.Get(), this->Current.Get() })
  {
    scene->SetHeightScale(scene->GetHeightScale() == before ? after : scene->GetHeightScale());
  }
  for (int i = 0; i < this->Undo.count(); ++i)
  {
    static_cast<const Step*>(this->Undo.command(i))->Rescale(before, after);
  }
}

//------------------------------------------------------------------------------
void Document::ReadScene(const QString& file)
{
  const std::string name = encoded(file);
  vtkNew<vtkReliefSceneFile> reader;
  reader->SetFileName(name.c_str());
  reader->SetScene(this->EditedScene);
  if (!reader->Read())
  {
    reliefshade::takeError(); // it is told here
    throw Failure(name, reader->GetErrorReason());
  }
  this->ScaleIsNamed = reader->GetNamesHeightScale();
  if (!this->ScaleIsNamed)
  {
    this->EditedScene->SetHeightScale(this->OpenField.UsualScale);
  }
  this->OpenField.Frame.ToHeights(this->EditedScene);
  this->StartAnew(file);
}

//------------------------------------------------------------------------------
void Document::CheckTarget(const QString& file, bool isScene) const
{
  std::vector<reliefshade::NamedFile> open;
  const auto add = [&open](const std::string& name, const char* role)
  {
    if (!name.empty())
    {
      open.push_back({ name, role });
    }
  };
  add(encoded(this->HeightsFile), "the open height field");
  add(this->OpenField.MaskFile, "the open mask");
  vtkReliefEnvironment* environment = this->EditedScene->GetEnvironment();
  const char* picture = environment ? environment->GetFileName() : nullptr;
  add(picture ? picture : "", "the picture of the environment");
  if (!isScene)
  {
    add(encoded(this->File), "the open scene");
  }
  reliefshade::keepApart(open, { { encoded(file), isScene ? "the scene" : "the picture" } });
}

//------------------------------------------------------------------------------
void Document::WriteScene(const QString& file)
{
  this->CheckTarget(file, true);
  const std::string name = encoded(file);
  vtkNew<vtkReliefSceneFile> writer;
  writer->SetFileName(name.c_str());
  writer->SetScene(this->OnMap());
  if (!writer->Write())
  {
    reliefshade::takeError(); // it is told here
    throw Failure(name, writer->GetErrorReason());
  }
  this->File = file;
  this->Undo.setClean();
  emit this->changed();
}

//------------------------------------------------------------------------------
void Document::NewScene()
{
  vtkNew<vtkReliefScene> scene;
  scene->SetLightsToDefault();
  scene->SetHeightScale(this->OpenField.UsualScale);
  this->ScaleIsNamed = false;
  this->EditedScene->ShallowCopy(scene);
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
  this->Current = this->OnMap();
  this->Undo.clear();
  emit this->changed();
  emit this->selectionChanged();
}

//------------------------------------------------------------------------------
Document::Copy Document::OnMap() const
{
  auto copy = Copy::New();
  copy->CopySharingImage(this->EditedScene);
  this->OpenField.Frame.ToMap(copy);
  return copy;
}

//------------------------------------------------------------------------------
std::string Document::Text() const
{
  vtkNew<vtkReliefSceneFile> file;
  file->SetScene(this->OnMap());
  std::string text = file->ToText();
  if (text.empty())
  {
    reliefshade::takeError(); // it is told here
    throw Failure("", file->GetErrorReason());
  }
  return text;
}

//------------------------------------------------------------------------------
void Document::CopyTo(vtkReliefScene* scene) const
{
  scene->DeepCopy(this->OnMap());
  this->OpenField.Frame.ToHeights(scene);
}

//------------------------------------------------------------------------------
void Document::Restore(const Copy& copy)
{
  this->EditedScene->CopySharingImage(copy);
  this->OpenField.Frame.ToHeights(this->EditedScene);
  this->Current = copy;
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
  const double fitting = this->OpenField.FittingScale;
  if (fitting == 0.0)
  {
    emit this->refused(tr("The relief is flat: no scale makes it steep"));
    return;
  }
  const double scale = fitting * this->OpenField.Heights.HeightUnit;
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
  Copy copy = this->OnMap();
  if (!sameScene(copy, this->Current))
  {
    Copy before = std::exchange(this->Current, std::move(copy));
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
