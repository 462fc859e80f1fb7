// SPDX-License-Identifier: BSD-3-Clause

// Every field of the panel changes the scene and the picture, in one step that can be undone.

#include "ViewerTest.h"

#include "SceneParameters.h"
#include "Section.h"

#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"

#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QScrollArea>
#include <QSlider>
#include <QToolButton>

#include <cmath>

using namespace reliefviewer;

using Number = double (*)(vtkReliefScene*);
using Colour = const double* (*)(vtkReliefScene*);
Q_DECLARE_METATYPE(Number)
Q_DECLARE_METATYPE(Colour)

namespace
{

vtkLight* firstLight(vtkReliefScene* scene)
{
  return vtkLight::SafeDownCast(scene->GetLights()->GetItemAsObject(0));
}

/// Scenes in which fields show.
const char* const Plain =
  R"({"reliefScene": 1, "lights": [{"kind": "sun", "azimuth": 315, "altitude": 30}]})";
const char* const Lamp =
  R"({"reliefScene": 1, "lights": [{"kind": "point", "position": [1500, 2900, 1200]}]})";
const char* const Shiny =
  R"({"reliefScene": 1, "lights": [{"kind": "sun", "azimuth": 315, "altitude": 30}],
  "material": {"specularCoefficient": 0.5, "specularRange": [0.2, 0.9], "specularPower": 2}})";
const char* const Backlit =
  R"({"reliefScene": 1, "lights": [{"kind": "sun", "azimuth": 315, "altitude": -40}],
  "material": {"useFloor": true, "floorHeight": -20, "forwardScatterCoefficient": 0.5,
  "subsurfaceDepth": 90, "forwardScatterRange": [0.1, 0.9], "forwardScatterPower": 2}})";
const char* const Sky = R"({"reliefScene": 1,
  "environment": {"image": "clearSky", "azimuth": 300, "altitude": 30, "numberOfSamples": 32}})";
const char* const Thin =
  R"({"reliefScene": 1, "lights": [{"kind": "sun", "azimuth": 315, "altitude": 30}],
  "material": {"attenuation": "Exponential", "density": 0.02}})";
const char* const Steps = R"({"reliefScene": 1, "integrator": "FixedStep", "numberOfSteps": 16,
  "lights": [{"kind": "sun", "azimuth": 315, "altitude": 20}]})";

}

class TestViewerPanel : public ViewerTest
{
  Q_OBJECT

private slots:
  void numbers_data();
  void numbers();
  void colours_data();
  void colours();
  void cancelledColour();
  void choices_data();
  void choices();
  void checks();
  void automaticDepth();
  void fitHeights();
  void rangesPushEachOther();
  void environmentFromPicture();
  void numbersBeyondTheSlider();
  void exactNumbersStayExact();
  void wheelScrollsThePanel();
  void nothingIsOutOfReach();
  void everyParameterHasAField();
  void infiniteRadius();

private:
  Window With(const char* scene);
};

//------------------------------------------------------------------------------
ViewerTest::Window TestViewerPanel::With(const char* scene)
{
  this->Write("with.json", scene);
  Window window = this->NewWindow(this->Hills());
  if (!window->Open(this->Path("with.json")))
  {
    qFatal("The scene is not read");
  }
  for (Section* section : window->findChildren<Section*>())
  {
    section->SetOpen(true);
  }
  QTest::qWait(20);
  return window;
}

//------------------------------------------------------------------------------
void TestViewerPanel::numbers_data()
{
  QTest::addColumn<QString>("key");
  QTest::addColumn<QByteArray>("scene");
  QTest::addColumn<Number>("get");
  QTest::addColumn<double>("share"); // of the slider's way
  QTest::addColumn<QString>("typed");
  QTest::addColumn<bool>("seen");
  using S = vtkReliefScene*;
  const auto row = [](const char* key, const char* scene, Number get, double share,
                     const char* typed, bool seen = true)
  { QTest::newRow(key) << key << QByteArray(scene) << get << share << typed << seen; };
  row(
    "heightScale", Plain, [](S s) { return s->GetHeightScale(); }, 0.6, "-1.5");
  row(
    "subsurfaceDepth", Plain, [](S s) { return s->GetMaterial()->GetSubsurfaceDepth(); }, 0.5,
    "12.5");
  row(
    "density", Thin, [](S s) { return s->GetMaterial()->GetDensity(); }, 0.5, "0.125");
  row(
    "lightIntensity", Plain, [](S s) { return firstLight(s)->GetIntensity(); }, 0.2, "0.5");
  row(
    "sunAzimuth", Plain,
    [](S s)
    { return std::atan2(firstLight(s)->GetPosition()[0], firstLight(s)->GetPosition()[1]); },
    0.3, "290");
  row(
    "sunAltitude", Plain, [](S s) { return firstLight(s)->GetPosition()[2]; }, 0.8, "12");
  row(
    "sunDiameter", Plain, [](S s) { return vtkReliefScene::GetAngularDiameter(firstLight(s)); },
    0.7, "5");
  row(
    "lampX", Lamp, [](S s) { return firstLight(s)->GetPosition()[0]; }, 0.8, "1200.25");
  row(
    "lampY", Lamp, [](S s) { return firstLight(s)->GetPosition()[1]; }, 0.3, "2500");
  row(
    "lampDistance", Lamp, [](S s) { return firstLight(s)->GetPosition()[2]; }, 0.7, "250");
  row(
    "specularCoefficient", Plain, [](S s) { return s->GetMaterial()->GetSpecularCoefficient(); },
    0.4, "1");
  row(
    "specularFrom", Shiny, [](S s) { return s->GetMaterial()->GetSpecularRange()[0]; }, 0.8, "0.1");
  row(
    "specularTo", Shiny, [](S s) { return s->GetMaterial()->GetSpecularRange()[1]; }, 0.8, "1.25");
  row(
    "specularPower", Shiny, [](S s) { return s->GetMaterial()->GetSpecularPower(); }, 0.5, "0.5");
  row(
    "forwardScatterCoefficient", Backlit,
    [](S s) { return s->GetMaterial()->GetForwardScatterCoefficient(); }, 0.9, "0.25");
  row(
    "scatterFrom", Backlit, [](S s) { return s->GetMaterial()->GetForwardScatterRange()[0]; }, 0.7,
    "0");
  row(
    "scatterTo", Backlit, [](S s) { return s->GetMaterial()->GetForwardScatterRange()[1]; }, 0.85,
    "1.5");
  row(
    "scatterPower", Backlit, [](S s) { return s->GetMaterial()->GetForwardScatterPower(); }, 0.4,
    "0.5");
  row(
    "floorHeight", Backlit, [](S s) { return s->GetMaterial()->GetFloorHeight(); }, 0.7, "-150");
  row(
    "environmentIntensity", Sky, [](S s) { return s->GetEnvironment()->GetIntensity(); }, 0.3,
    "0.25");
  row(
    "environmentTurn", Sky, [](S s) { return s->GetEnvironment()->GetRotationZ(); }, 0.5, "-400");
  row(
    "environmentTilt", Sky, [](S s) { return s->GetEnvironment()->GetTilt(); }, 0.6, "45");
  row(
    "environmentSamples", Sky, [](S s) { return 1.0 * s->GetEnvironment()->GetNumberOfSamples(); },
    0.3, "16");
  row(
    "skyAzimuth", Sky, [](S s) { return s->GetEnvironment()->GetClearSkyParameters()[0]; }, 0.3,
    "90");
  row(
    "skyAltitude", Sky, [](S s) { return s->GetEnvironment()->GetClearSkyParameters()[1]; }, 0.9,
    "10");
  row(
    "skyTurbidity", Sky, [](S s) { return s->GetEnvironment()->GetClearSkyParameters()[2]; }, 0.9,
    "2.5");
  // A looser tolerance is seen in single samples at most.
  row(
    "tolerance", Plain, [](S s) { return s->GetTolerance(); }, 0.9, "0", false);
  row(
    "numberOfSteps", Steps, [](S s) { return 1.0 * s->GetNumberOfSteps(); }, 0.5, "3");
}

//------------------------------------------------------------------------------
void TestViewerPanel::numbers()
{
  QFETCH(QString, key);
  QFETCH(QByteArray, scene);
  QFETCH(Number, get);
  QFETCH(double, share);
  QFETCH(QString, typed);
  QFETCH(bool, seen);
  const Window window = this->With(scene.constData());
  Document* document = window->Opened();
  auto* row = Find(window.get(), qPrintable(key));
  auto* box = row->findChild<QDoubleSpinBox*>("box");
  QVERIFY(row->isVisible());
  QImage before;
  COMPLETE_PICTURE(before, window);
  const std::string text = document->Text();
  const double old = get(document->Scene());

  DragSlider(row, share);
  const double slid = get(document->Scene());
  QVERIFY(slid != old);
  QCOMPARE(document->Steps()->count(), 1);
  QVERIFY(!document->InStep());
  QImage after;
  COMPLETE_PICTURE(after, window);
  QVERIFY(!seen || after != before);

  Type(row, typed);
  QVERIFY(get(document->Scene()) != slid);
  QCOMPARE(box->value(), typed.toDouble());
  QVERIFY(document->Steps()->count() >= 1);
  QImage last;
  COMPLETE_PICTURE(last, window);
  QVERIFY(!seen || last != after);

  while (document->Steps()->canUndo())
  {
    document->Steps()->undo();
  }
  QVERIFY(document->Text() == text);
  QVERIFY(std::abs(get(document->Scene()) - old) <= 1e-9 * std::abs(old));
  QImage undone;
  COMPLETE_PICTURE(undone, window);
  QCOMPARE(undone, before);
}

//------------------------------------------------------------------------------
void TestViewerPanel::colours_data()
{
  QTest::addColumn<QString>("key");
  QTest::addColumn<QByteArray>("scene");
  QTest::addColumn<Colour>("get");
  using S = vtkReliefScene*;
  const auto row = [](const char* key, const char* scene, Colour get)
  { QTest::newRow(key) << key << QByteArray(scene) << get; };
  row("diffuseColor", Plain,
    [](S s) -> const double* { return s->GetMaterial()->GetDiffuseColor(); });
  row("baseColor", Plain, [](S s) -> const double* { return s->GetMaterial()->GetBaseColor(); });
  row("specularColor", Shiny,
    [](S s) -> const double* { return s->GetMaterial()->GetSpecularColor(); });
  row("lightColor", Plain, [](S s) -> const double* { return firstLight(s)->GetDiffuseColor(); });
}

//------------------------------------------------------------------------------
void TestViewerPanel::colours()
{
  QFETCH(QString, key);
  QFETCH(QByteArray, scene);
  QFETCH(Colour, get);
  const Window window = this->With(scene.constData());
  QImage before;
  COMPLETE_PICTURE(before, window);
  QImage while_;
  InDialog<QColorDialog>(
    [&](QColorDialog* dialog)
    {
      dialog->setCurrentColor(QColor(10, 200, 30)); // one that is not kept
      dialog->setCurrentColor(QColor(255, 188, 0));
      QVERIFY(QTest::qWaitFor([&] { return !(while_ = Picture(window.get())).isNull(); }));
      dialog->accept();
    });
  QTest::mouseClick(Find(window.get(), qPrintable(key)), Qt::LeftButton);
  const double* colour = get(window->Opened()->Scene());
  QCOMPARE(colour[0], 1.0);
  QVERIFY(std::abs(colour[1] - 0.503) < 1e-3); // 188 / 255 of sRGB, linear
  QCOMPARE(colour[2], 0.0);
  QVERIFY(!while_.isNull() && while_ != before); // it is seen while the dialog is open
  QCOMPARE(window->Opened()->Steps()->count(), 1);
  QImage after;
  COMPLETE_PICTURE(after, window);
  QCOMPARE(after, while_);
  window->Opened()->Steps()->undo();
  QImage undone;
  COMPLETE_PICTURE(undone, window);
  QCOMPARE(undone, before);
}

//------------------------------------------------------------------------------
void TestViewerPanel::cancelledColour()
{
  const Window window =
    this->With(R"({"reliefScene": 1, "material": {"diffuseColor": [0.123456, 1.5, 0.7]}})");
  const std::string text = window->Opened()->Text();
  InDialog<QColorDialog>(
    [](QColorDialog* dialog)
    {
      dialog->setCurrentColor(Qt::red);
      dialog->reject();
    });
  QTest::mouseClick(Find(window.get(), "diffuseColor"), Qt::LeftButton);
  QVERIFY(window->Opened()->Text() == text);
  QCOMPARE(window->Opened()->Steps()->count(), 0);
  // Accepted as it is: the digits that 8 bits do not hold are kept.
  InDialog<QColorDialog>([](QColorDialog* dialog) { dialog->accept(); });
  QTest::mouseClick(Find(window.get(), "diffuseColor"), Qt::LeftButton);
  QVERIFY(window->Opened()->Text() == text);
}

//------------------------------------------------------------------------------
void TestViewerPanel::choices_data()
{
  QTest::addColumn<QString>("key");
  QTest::addColumn<QByteArray>("scene");
  QTest::addColumn<int>("choice");
  QTest::addColumn<Number>("get");
  using S = vtkReliefScene*;
  const auto row = [](const char* key, const char* scene, int choice, Number get)
  { QTest::newRow(key) << key << QByteArray(scene) << choice << get; };
  row("offsetMode", Plain, 1, [](S s) { return 1.0 * s->GetMaterial()->GetOffsetMode(); });
  row("attenuation", Plain, 1, [](S s) { return 1.0 * s->GetMaterial()->GetAttenuation(); });
  row("integrator", Plain, 1, [](S s) { return 1.0 * s->GetIntegrator(); });
  row("lightKind", Plain, 1, [](S s) { return 1.0 * firstLight(s)->GetPositional(); });
  row("environmentSource", Sky, 0, [](S s) { return s->GetEnvironment()->GetImageSource() - 1.0; });
  row("environmentSampling", Sky, 0, [](S s) { return 1.0 * s->GetEnvironment()->GetSampling(); });
}

//------------------------------------------------------------------------------
void TestViewerPanel::choices()
{
  QFETCH(QString, key);
  QFETCH(QByteArray, scene);
  QFETCH(int, choice);
  QFETCH(Number, get);
  const Window window = this->With(scene.constData());
  QImage before;
  COMPLETE_PICTURE(before, window);
  auto* box = Find<QComboBox>(window.get(), qPrintable(key));
  const int old = box->currentIndex();
  QCOMPARE(get(window->Opened()->Scene()), 1.0 * old);
  box->setFocus();
  QTest::keyClick(box, choice == 0 ? Qt::Key_Home : Qt::Key_End);
  if (box->currentIndex() != choice) // a list of three
  {
    QTest::keyClick(box, Qt::Key_Up);
  }
  QCOMPARE(get(window->Opened()->Scene()), 1.0 * choice);
  QImage after;
  COMPLETE_PICTURE(after, window);
  QVERIFY(after != before);
  while (window->Opened()->Steps()->canUndo())
  {
    window->Opened()->Steps()->undo();
  }
  QCOMPARE(box->currentIndex(), old);
  QImage undone;
  COMPLETE_PICTURE(undone, window);
  QCOMPARE(undone, before);
}

//------------------------------------------------------------------------------
void TestViewerPanel::checks()
{
  const Window window = this->With(Plain);
  vtkReliefScene* scene = window->Opened()->Scene();
  auto* environment = Find<QCheckBox>(window.get(), "environment");
  QVERIFY(!Find(window.get(), "environmentTurn")->isVisible());
  environment->click();
  QVERIFY(scene->GetEnvironment() && Find(window.get(), "environmentTurn")->isVisible());
  Type(Find(window.get(), "environmentTurn"), "33");
  environment->click();
  QVERIFY(!scene->GetEnvironment());
  environment->click(); // as it was
  QCOMPARE(scene->GetEnvironment()->GetRotationZ(), 33.0);

  QVERIFY(!Find(window.get(), "floorHeight")->isVisible());
  Find<QCheckBox>(window.get(), "useFloor")->click();
  QVERIFY(scene->GetMaterial()->GetUseFloor() && Find(window.get(), "floorHeight")->isVisible());
  while (window->Opened()->Steps()->canUndo())
  {
    window->Opened()->Steps()->undo();
  }
  QVERIFY(!scene->GetMaterial()->GetUseFloor() && !scene->GetEnvironment());
  QVERIFY(!environment->isChecked());
}

//------------------------------------------------------------------------------
void TestViewerPanel::automaticDepth()
{
  const Window window = this->With(Plain);
  vtkReliefMaterial* material = window->Opened()->Scene()->GetMaterial();
  auto* automatic = Find<QCheckBox>(window.get(), "automaticSubsurfaceDepth");
  auto* depth = Find(window.get(), "subsurfaceDepth")->findChild<QDoubleSpinBox*>("box");
  QVERIFY(automatic->isChecked());
  QCOMPARE(depth->value(), 30.0); // the spacing
  DragSlider(Find(window.get(), "subsurfaceDepth"), 0.6);
  QVERIFY(!automatic->isChecked());
  QVERIFY(depth->value() > 300.0);
  automatic->click();
  material = window->Opened()->Scene()->GetMaterial();
  QVERIFY(material->GetAutomaticSubsurfaceDepth());
  QCOMPARE(depth->value(), 30.0);
  // Switched off, it stays what it was for the eye.
  QImage before;
  COMPLETE_PICTURE(before, window);
  automatic->click();
  QImage after;
  COMPLETE_PICTURE(after, window);
  QCOMPARE(after, before);
}

//------------------------------------------------------------------------------
void TestViewerPanel::fitHeights()
{
  this->Write("flat.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n5 5 5\n5 5 5\n");
  this->Write("tiny.asc",
    "ncols 11\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
    "0 1e5 0 1e5 0 1e5 0 1e5 0 1e5 0\n0 1e5 0 1e5 0 1e5 0 1e5 0 1e5 0\n");
  const Window window = this->NewWindow(this->Path("flat.asc"));
  Trigger(window.get(), "fitHeights");
  QVERIFY(this->Said.takeFirst().contains("flat"));
  QCOMPARE(window->Opened()->Steps()->count(), 0);
  QVERIFY(window->Open(this->Path("tiny.asc")));
  Trigger(window.get(), "fitHeights");
  QCOMPARE(window->Opened()->Scene()->GetHeightScale(), 7e-6);
  QCOMPARE(window->Opened()->Steps()->count(), 1);
}

//------------------------------------------------------------------------------
void TestViewerPanel::rangesPushEachOther()
{
  const Window window = this->With(Shiny);
  Type(Find(window.get(), "specularFrom"), "0.95");
  const auto range = [&] { return window->Opened()->Scene()->GetMaterial()->GetSpecularRange(); };
  QCOMPARE(range()[0], 0.95);
  QCOMPARE(range()[1], 0.95);
  Type(Find(window.get(), "specularTo"), "0.5");
  QCOMPARE(range()[0], 0.5);
  QCOMPARE(range()[1], 0.5);
}

//------------------------------------------------------------------------------
void TestViewerPanel::environmentFromPicture()
{
  QImage sky(8, 4, QImage::Format_RGB32);
  sky.fill(QColor(120, 160, 255));
  sky.save(this->Path("sky.png"));
  const Window window = this->With(Sky);
  QImage before;
  COMPLETE_PICTURE(before, window);
  ChooseFile(this->Path("sky.png"));
  auto* source = Find<QComboBox>(window.get(), "environmentSource");
  source->setFocus();
  QTest::keyClick(source, Qt::Key_End);
  vtkReliefEnvironment* environment = window->Opened()->Scene()->GetEnvironment();
  QCOMPARE(environment->GetImageSource(), static_cast<int>(vtkReliefEnvironment::File));
  QVERIFY(Find(window.get(), "environmentPicture")->isVisible());
  QImage after;
  COMPLETE_PICTURE(after, window);
  QVERIFY(after != before);
  QVERIFY(window->SaveScene(this->Path("with-sky.json")));
  QVERIFY(this->Read("with-sky.json").contains("\"sky.png\"")); // relative to its folder

  // It is in memory: its file is not needed for another field, or to save the scene.
  QVERIFY(QFile::rename(this->Path("sky.png"), this->Path("away.png")));
  QVERIFY(window->Open(this->Hills()));
  QCOMPARE(environment->GetImageSource(), static_cast<int>(vtkReliefEnvironment::File));
  QVERIFY(window->SaveScene(this->Path("with-sky.json")));
  QVERIFY(this->Read("with-sky.json").contains("\"sky.png\""));
  QVERIFY(QFile::rename(this->Path("away.png"), this->Path("sky.png")));

  // A bad one changes nothing.
  this->Write("bad.hdr", "nonsense");
  ChooseFile(this->Path("bad.hdr"));
  QString message;
  Answer(QMessageBox::Ok, &message);
  QTest::mouseClick(Find(window.get(), "environmentPicture"), Qt::LeftButton);
  QVERIFY2(message.contains("bad.hdr"), qPrintable(message));
  QVERIFY(QString(environment->GetFileName()).endsWith("sky.png"));
  QVERIFY(!window->isWindowModified());

  // Undo goes back to the sky and, without a file, to the picture, which is the very same.
  vtkImageData* image = environment->GetImage();
  window->Opened()->Steps()->undo();
  QCOMPARE(window->Opened()->Scene()->GetEnvironment()->GetImageSource(),
    static_cast<int>(vtkReliefEnvironment::ClearSky));
  QVERIFY(QFile::remove(this->Path("sky.png")));
  window->Opened()->Steps()->redo();
  environment = window->Opened()->Scene()->GetEnvironment();
  QVERIFY(environment->GetImage() == image);
  QVERIFY(QString(environment->GetFileName()).endsWith("sky.png"));
  Type(Find(window.get(), "environmentTilt"), "20");
  window->Opened()->Steps()->undo();
  QVERIFY(window->Opened()->Scene()->GetEnvironment()->GetImage() == image);
  QImage again;
  COMPLETE_PICTURE(again, window);
  QCOMPARE(again, after);
}

//------------------------------------------------------------------------------
void TestViewerPanel::numbersBeyondTheSlider()
{
  const Window window = this->With(Plain);
  Type(Find(window.get(), "lightIntensity"), "25");
  QCOMPARE(firstLight(window->Opened()->Scene())->GetIntensity(), 25.0);
  auto* slider = Find(window.get(), "lightIntensity")->findChild<QSlider*>();
  QCOMPARE(slider->value(), slider->maximum());
  // What no scene takes the field does not either.
  Type(Find(window.get(), "specularCoefficient"), "1.5");
  QVERIFY(window->Opened()->Scene()->GetMaterial()->GetSpecularCoefficient() <= 1.0);
  Type(Find(window.get(), "tolerance"), "-1");
  QCOMPARE(window->Opened()->Scene()->GetTolerance(), 0.0003);
  Type(Find(window.get(), "heightScale"), "1e-3");
  QCOMPARE(window->Opened()->Scene()->GetHeightScale(), 1e-3);
}

//------------------------------------------------------------------------------
void TestViewerPanel::exactNumbersStayExact()
{
  const Window window =
    this->With(R"({"reliefScene": 1, "heightScale": 0.12345678901234567, "tolerance": 1e-7})");
  auto* box = Find(window.get(), "heightScale")->findChild<QDoubleSpinBox*>("box");
  QCOMPARE(box->text(), QString("0.123457"));
  box->setFocus();
  QTest::keyClick(box, Qt::Key_Return);
  QCOMPARE(window->Opened()->Scene()->GetHeightScale(), 0.12345678901234567);
  QCOMPARE(window->Opened()->Steps()->count(), 0);
  // The arrow keys step by a tenth of the magnitude, and seconds of them are one step for undo.
  Type(Find(window.get(), "heightScale"), "1");
  for (int i = 0; i < 10; ++i)
  {
    QTest::keyClick(box, Qt::Key_Up);
  }
  QCOMPARE(box->value(), 2.0);
  QCOMPARE(window->Opened()->Steps()->count(), 1);
}

//------------------------------------------------------------------------------
void TestViewerPanel::wheelScrollsThePanel()
{
  const Window window = this->With(Plain);
  auto* row = Find(window.get(), "lightIntensity");
  const std::string text = window->Opened()->Text();
  window->View()->setFocus();
  for (QWidget* part :
    { static_cast<QWidget*>(row->findChild<QSlider*>()),
      static_cast<QWidget*>(row->findChild<QDoubleSpinBox*>()), Find(window.get(), "offsetMode") })
  {
    Wheel(part, part->rect().center(), -1);
  }
  QVERIFY(window->Opened()->Text() == text);
}

//------------------------------------------------------------------------------
// No field is cut off at the panel's side.
void TestViewerPanel::nothingIsOutOfReach()
{
  for (const char* scene : { Plain, Lamp, Backlit, Sky, Thin, Steps })
  {
    const Window window = this->With(scene);
    auto* panel = window->findChild<QScrollArea*>();
    for (NumberRow* row : window->findChildren<NumberRow*>())
    {
      if (row->isVisible())
      {
        const QPoint right = row->mapTo(panel, QPoint(row->width(), 0));
        QVERIFY2(right.x() <= panel->viewport()->width(), qPrintable(row->objectName()));
        QVERIFY2(row->findChild<QSlider*>()->width() >= 60, qPrintable(row->objectName()));
      }
    }
  }
}

//------------------------------------------------------------------------------
// What is in the table is in the panel, and shows what it means.
void TestViewerPanel::everyParameterHasAField()
{
  const Window window = this->With(Plain);
  QStringList there;
  for (QWidget* widget : window->findChildren<QWidget*>())
  {
    const QString name = widget->property("parameter").toString();
    if (!name.isEmpty())
    {
      there += name;
      QVERIFY2(name == "Light.Switch" || !widget->toolTip().isEmpty(), qPrintable(name));
    }
  }
  for (const auto& parameter : relief::parameters::All())
  {
    const QString name =
      QString("%1.%2").arg(relief::parameters::NameOf(parameter.Of), parameter.Name);
    QVERIFY2(there.contains(name), qPrintable(name));
  }
}

//------------------------------------------------------------------------------
void TestViewerPanel::infiniteRadius()
{
  const Window window = this->With(Sky);
  auto* box = Find(window.get(), "environmentRadius")->findChild<QDoubleSpinBox*>("box");
  const auto radius = [&] { return window->Opened()->Scene()->GetEnvironment()->GetRadius(); };
  QCOMPARE(box->text(), QString("infinite"));
  Type(Find(window.get(), "environmentRadius"), "5000");
  QCOMPARE(radius(), 5000.0);
  Type(Find(window.get(), "environmentRadius"), "0");
  QVERIFY(std::isinf(radius()));
  QCOMPARE(box->text(), QString("infinite"));
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerPanel>(argc, argv);
}

#include "TestViewerPanel.moc"
