// SPDX-License-Identifier: BSD-3-Clause

// Pictures, layers and scenes that the viewer saves are those of reliefshade, and the other way
// round.

#include "ViewerTest.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkOpenImageIOReader.h"
#include "vtkPointData.h"
#include "vtkReliefMaterial.h"

#include <QAction>
#include <QFileDialog>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProgressDialog>
#include <QPushButton>

#include <cstring>

using namespace reliefviewer;

class TestViewerSaving : public ViewerTest
{
  Q_OBJECT

private slots:
  void sceneDrivesReliefshade_data();
  void sceneDrivesReliefshade();
  void reliefshadesSceneDrivesTheViewer();
  void pictureIsFullResolution();
  void layers();
  void byDialogs();
  void failuresLeaveNothing();
  void whatIsOpenIsKept();
  void cancelled();
  void sceneIsReopened();
  void closingAsks();

private:
  vtkSmartPointer<vtkImageData> Image(const QString& name) const;
  bool Same(const QString& one, const QString& other) const;
};

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> TestViewerSaving::Image(const QString& name) const
{
  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(qPrintable(this->Path(name)));
  reader->Update();
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
/// Whether two pictures have the same samples, bit for bit.
bool TestViewerSaving::Same(const QString& one, const QString& other) const
{
  const auto a = this->Image(one);
  const auto b = this->Image(other);
  vtkDataArray* x = a->GetPointData()->GetScalars();
  vtkDataArray* y = b->GetPointData()->GetScalars();
  return x && y && x->GetDataType() == y->GetDataType() &&
    x->GetNumberOfValues() == y->GetNumberOfValues() && x->GetNumberOfValues() > 0 &&
    std::memcmp(x->GetVoidPointer(0), y->GetVoidPointer(0),
      static_cast<std::size_t>(x->GetNumberOfValues()) * x->GetDataTypeSize()) == 0;
}

//------------------------------------------------------------------------------
void TestViewerSaving::sceneDrivesReliefshade_data()
{
  QTest::addColumn<QString>("heights");
  QTest::addColumn<QString>("picture");
  QTest::newRow("projected, PNG") << this->Hills() << "picture.png";
  QTest::newRow("projected, OpenEXR") << this->Hills() << "picture.exr";
  const QString jacksboro = QString::fromLocal8Bit(qgetenv("RELIEFSHADE_DATA")) + "/jacksboro.tif";
  QTest::newRow("geographic, PNG") << jacksboro << "picture.png";
  QTest::newRow("geographic, TIFF") << jacksboro << "picture.tif";
}

//------------------------------------------------------------------------------
void TestViewerSaving::sceneDrivesReliefshade()
{
  QFETCH(QString, heights);
  QFETCH(QString, picture);
  const Window window = this->NewWindow(heights);
  Trigger(window.get(), "addLampAction");
  ReliefView* view = window->View();
  const QPoint lamp = DotAt(window.get(), 1);
  Drag(view, lamp, lamp + QPoint(57, 31));
  Drag(view, DotAt(window.get(), 0), DotAt(window.get(), 0) + QPoint(-23, 17));
  Type(Find(window.get(), "heightScale"), "1.7");
  Type(Find(window.get(), "lightIntensity"), "0.6");
  Type(Find(window.get(), "specularCoefficient"), "0.25");
  DragSlider(Find(window.get(), "subsurfaceDepth"), 0.4);
  QVERIFY(window->SavePicture(this->Path(picture)));
  QVERIFY(window->SaveScene(this->Path("scene.json")));
  const QString again = "again." + picture.section('.', -1);
  this->Reliefshade({ heights, again, "--scene", "scene.json" });
  QVERIFY(this->Same(picture, again));
  // And it is the scene that does it.
  this->Reliefshade({ heights, again });
  QVERIFY(!this->Same(picture, again));
}

//------------------------------------------------------------------------------
void TestViewerSaving::reliefshadesSceneDrivesTheViewer()
{
  const QString heights = this->Hills();
  this->Reliefshade({ heights, "first.png", "--height-scale", "2", "--diffuse", "0.9,0.7,0.5",
    "--ks", "0.2", "--depth", "0.7", "--sun", "300.5,20,0.8", "--point", "1300,2345.67,900,0.5",
    "--sun-diameter", "2", "--tolerance", "0.001", "--save-scene", "first.json" });
  const Window window = this->NewWindow(heights);
  QVERIFY(window->Open(this->Path("first.json")));
  QVERIFY(window->SavePicture(this->Path("second.png")));
  QVERIFY(this->Same("first.png", "second.png"));
  QVERIFY(window->SaveScene(this->Path("second.json")));
  QCOMPARE(QJsonDocument::fromJson(this->Read("second.json")),
    QJsonDocument::fromJson(this->Read("first.json")));
}

//------------------------------------------------------------------------------
void TestViewerSaving::pictureIsFullResolution()
{
  const Window window = this->NewWindow(this->Hills("large.asc", 700, 500));
  window->resize(500, 400);
  window->View()->Zoom(4.0);
  QVERIFY(window->SavePicture(this->Path("large.png")));
  const QImage picture(this->Path("large.png"));
  QCOMPARE(picture.size(), QSize(700, 500));
}

//------------------------------------------------------------------------------
void TestViewerSaving::layers()
{
  const QString heights = this->Hills();
  const Window window = this->NewWindow(heights);
  Type(Find(window.get(), "specularCoefficient"), "0.3");
  QVERIFY(window->SaveLayers(this->Path("layers.exr")));
  QVERIFY(window->SaveScene(this->Path("layers.json")));
  this->Reliefshade({ heights, "--layers", "expected.exr", "--scene", "layers.json" });
  QCOMPARE(this->Read("layers.exr").size(), this->Read("expected.exr").size());
  QVERIFY(this->Same("layers.exr", "expected.exr"));
  for (const char* name : { "illumination", "normals", "diffuse", "specular" })
  {
    QVERIFY2(this->Read("layers.exr").toLower().contains(name), name);
  }
}

//------------------------------------------------------------------------------
void TestViewerSaving::byDialogs()
{
  const Window window = this->NewWindow(this->Hills());
  QStringList suggested;
  InDialog<QFileDialog>(
    [&suggested](QFileDialog* dialog)
    {
      suggested = dialog->selectedFiles();
      dialog->reject();
    });
  Trigger(window.get(), "savePicture");
  QVERIFY(suggested.value(0).endsWith("/hills-shaded.png"));
  ChooseFile(this->Path("chosen"));
  Trigger(window.get(), "savePicture");
  QCOMPARE(QImage(this->Path("chosen.png")).size(), QSize(64, 48));
  QCOMPARE(this->Said.takeFirst(), QString("chosen.png is saved"));
  ChooseFile(this->Path("chosen"));
  Trigger(window.get(), "saveLayers");
  QVERIFY(QFile::exists(this->Path("chosen.exr")));
  QCOMPARE(this->Said.takeFirst(), QString("chosen.exr is saved"));
  ChooseFile(this->Path("chosen"));
  Trigger(window.get(), "saveScene");
  QCOMPARE(window->Opened()->SceneFile(), this->Path("chosen.json"));
  QCOMPARE(this->Said.takeFirst(), QString("chosen.json is saved"));
  // Now it has a name.
  Type(Find(window.get(), "heightScale"), "2");
  QVERIFY(window->isWindowModified());
  Trigger(window.get(), "saveScene");
  QVERIFY(!window->isWindowModified());
  const QJsonObject scene = QJsonDocument::fromJson(this->Read("chosen.json")).object();
  QCOMPARE(scene["heightScale"].toDouble(), 2.0);
}

//------------------------------------------------------------------------------
void TestViewerSaving::failuresLeaveNothing()
{
  const Window window = this->NewWindow(this->Hills());
  const auto fails = [this](const QString& name, const std::function<bool(const QString&)>& save)
  {
    QString message;
    Answer(QMessageBox::Ok, &message);
    QVERIFY(!save(this->Path(name)));
    QVERIFY2(message.contains(this->Path(name)), qPrintable(message));
    QVERIFY(!QFile::exists(this->Path(name)));
  };
  const auto picture = [&window](const QString& file) { return window->SavePicture(file); };
  const auto layers = [&window](const QString& file) { return window->SaveLayers(file); };
  const auto scene = [&window](const QString& file) { return window->SaveScene(file); };
  fails("no/such/folder.png", picture);
  fails("no-format.xyz", picture);
  fails("no/such/folder.exr", layers);
  fails("no/such/folder.json", scene);
  QVERIFY(window->Opened()->SceneFile().isEmpty());
  // Afterwards all is well.
  QVERIFY(window->SavePicture(this->Path("fine.png")));
}

//------------------------------------------------------------------------------
void TestViewerSaving::whatIsOpenIsKept()
{
  this->Write("sky.ppm", "P6 2 1 255\n......");
  QVERIFY(this->Hills() == this->Path("hills.asc"));
  this->Write(
    "open.json", R"({"reliefScene": 1, "environment": {"image": "file", "file": "sky.ppm"}})");
  const Window window = this->NewWindow(this->Path("hills.asc"));
  QVERIFY(window->Open(this->Path("open.json")));
  QVERIFY(QFile::link(this->Path("hills.asc"), this->Path("link.json")));
  QVERIFY(QFile::link(this->Path("open.json"), this->Path("link.exr")));
  const auto refuses =
    [this](const QString& name, const QString& original, const std::function<bool(QString)>& save)
  {
    const QByteArray before = this->Read(original);
    QString message;
    Answer(QMessageBox::Ok, &message);
    QVERIFY(!save(this->Path(name)));
    QVERIFY2(message.startsWith(this->Path(name) + ": "), qPrintable(message));
    QVERIFY2(message.endsWith("; choose another name"), qPrintable(message));
    QCOMPARE(this->Read(original), before);
    QVERIFY(!before.isEmpty());
  };
  const auto picture = [&window](const QString& file) { return window->SavePicture(file); };
  const auto layers = [&window](const QString& file) { return window->SaveLayers(file); };
  const auto scene = [&window](const QString& file) { return window->SaveScene(file); };
  refuses("hills.asc", "hills.asc", picture);
  refuses("../" + QFileInfo(this->Folder.path()).fileName() + "/hills.asc", "hills.asc", scene);
  refuses("link.json", "hills.asc", scene);
  QVERIFY(QFile::copy(this->Path("hills.asc"), this->Path("mask.asc")));
  QVERIFY(window->OpenMask(this->Path("mask.asc")));
  refuses("mask.asc", "mask.asc", picture);
  refuses("mask.asc", "mask.asc", scene);
  refuses("sky.ppm", "sky.ppm", picture);
  refuses("sky.ppm", "sky.ppm", scene);
  refuses("open.json", "open.json", picture);
  refuses("link.exr", "open.json", layers);
  QCOMPARE(window->Opened()->SceneFile(), this->Path("open.json"));
  // The scene's own file is where it belongs.
  QVERIFY(window->SaveScene(this->Path("open.json")));
  QVERIFY(this->Read("open.json").contains("heightScale"));
}

//------------------------------------------------------------------------------
void TestViewerSaving::cancelled()
{
  const Window window = this->NewWindow(this->Hills("large.asc", 900, 900));
  this->Write("slow.json", R"({"reliefScene": 1, "tolerance": 0,
    "environment": {"image": "whiteDome", "numberOfSamples": 512}})");
  QVERIFY(window->Open(this->Path("slow.json")));
  this->Write("slow.png", "old");
  bool progressed = false;
  InDialog<QProgressDialog>(
    [&progressed](QProgressDialog* dialog)
    {
      progressed = QTest::qWaitFor([dialog] { return dialog->value() > 0; }, 60000) &&
        dialog->labelText().contains("slow.png");
      QTest::mouseClick(dialog->findChild<QPushButton*>(), Qt::LeftButton);
    });
  QVERIFY(!window->SavePicture(this->Path("slow.png")));
  QVERIFY(progressed);
  QCOMPARE(this->Read("slow.png"), QByteArray("old"));
  // What was cancelled stays so: the next one is whole.
  QVERIFY(window->Open(this->Hills()));
  Trigger(window.get(), "presetSun");
  QVERIFY(window->SavePicture(this->Path("quick.png")));
  QCOMPARE(QImage(this->Path("quick.png")).size(), QSize(64, 48));
}

//------------------------------------------------------------------------------
void TestViewerSaving::sceneIsReopened()
{
  std::string text;
  QImage before;
  {
    const Window window = this->NewWindow(this->Hills());
    Trigger(window.get(), "presetSunAndSky");
    Trigger(window.get(), "addLampAction");
    Type(Find(window.get(), "lampDistance"), "777");
    Type(Find(window.get(), "specularPower"), "12");
    QVERIFY(window->SaveScene(this->Path("kept.json")));
    QVERIFY(!window->isWindowModified());
    text = window->Opened()->Text();
    COMPLETE_PICTURE(before, window);
  }
  const Window window = this->NewWindow(this->Hills());
  QVERIFY(window->Open(this->Path("kept.json")));
  QVERIFY(window->Opened()->Text() == text);
  window->Opened()->SelectLight(1);
  QImage after;
  COMPLETE_PICTURE(after, window);
  QCOMPARE(after, before);
}

//------------------------------------------------------------------------------
void TestViewerSaving::closingAsks()
{
  const Window window = this->NewWindow(this->Hills());
  Type(Find(window.get(), "heightScale"), "2.5");
  QString message;
  Answer(QMessageBox::Cancel, &message);
  QVERIFY(!window->close());
  QVERIFY(message.contains("not saved"));
  QVERIFY(window->isVisible());
  // A new scene would take the changes away as well.
  Answer(QMessageBox::Cancel);
  Trigger(window.get(), "newScene");
  QVERIFY(window->isWindowModified());
  // Saved, with the name asked for.
  InDialog<QMessageBox>(
    [this](QMessageBox* box)
    {
      ChooseFile(this->Path("closing.json"));
      QTest::mouseClick(box->button(QMessageBox::Save), Qt::LeftButton);
    });
  QVERIFY(window->close());
  QVERIFY(this->Read("closing.json").contains("2.5"));
  QCOMPARE(this->Said.takeFirst(), QString("closing.json is saved"));

  const Window other = this->NewWindow(this->Hills());
  Type(Find(other.get(), "heightScale"), "3.5");
  Answer(QMessageBox::Discard);
  QVERIFY(other->close());
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerSaving>(argc, argv);
}

#include "TestViewerSaving.moc"
