// SPDX-License-Identifier: BSD-3-Clause

// Height fields and scenes come into the viewer; what cannot be read leaves it as it is.

#include "ViewerTest.h"

#include "vtkLight.h"
#include "vtkReliefScene.h"

#include <QAction>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QLabel>
#include <QMimeData>
#include <QProcess>
#include <QSettings>
#include <QStatusBar>
#include <QTextBrowser>

using namespace reliefviewer;

class TestViewerOpening : public ViewerTest
{
  Q_OBJECT

private slots:
  void empty();
  void heights();
  void georeference();
  void meshes();
  void heightsWithoutUnit();
  void turnedRasters();
  void doubtfulHeightsAreTold();
  void byDrop();
  void byDialog();
  void byArgument();
  void badFilesKeepWhatWasOpen();
  void badScenesKeepWhatWasOpen();
  void samplesWithoutDataAreSeenThrough();
  void lampsKeepTheirPlaceOnTheMap();
  void degreesAreAskedFor();
  void unknownKeysAreNamed();
  void helpListsTheKeys();
  void recentFiles();
  void remembersItsWindow();

private:
  static void Drop(MainWindow* window, const QStringList& files);
};

//------------------------------------------------------------------------------
void TestViewerOpening::Drop(MainWindow* window, const QStringList& files)
{
  QMimeData data;
  QList<QUrl> urls;
  for (const QString& file : files)
  {
    urls += QUrl::fromLocalFile(file);
  }
  data.setUrls(urls);
  QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(window, &enter);
  QVERIFY(enter.isAccepted());
  QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(window, &drop);
}

//------------------------------------------------------------------------------
void TestViewerOpening::empty()
{
  const Window window = this->NewWindow();
  QVERIFY(!window->Opened()->HasField());
  QVERIFY(!Find<QAction>(window.get(), "savePicture")->isEnabled());
  // All that there is without a field must do no harm.
  for (const char* action : { "addSunAction", "addLampAction", "switchLight", "nextLight",
         "removeLightAction", "presetSkyDome", "presetSun", "undo", "redo", "showLights", "fit" })
  {
    Trigger(window.get(), action);
  }
  QVERIFY(!window->Opened()->Steps()->isClean());
}

//------------------------------------------------------------------------------
void TestViewerOpening::heights()
{
  const Window window = this->NewWindow(this->Hills());
  const Field& field = window->Opened()->OpenedField();
  QCOMPARE(field.Samples[0], 64);
  QCOMPARE(field.Samples[1], 48);
  QVERIFY(
    field.Lowest >= 150.0 && field.Highest <= 460.0 && field.Mean > 280.0 && field.Mean < 330.0);
  QVERIFY(window->windowTitle().startsWith("hills.asc"));
  QImage picture;
  COMPLETE_PICTURE(picture, window);
  // The relief fills the view's height or width, and is no single colour.
  const QRgb middle = picture.pixel(picture.width() / 2, picture.height() / 2);
  int others = 0;
  for (int x = picture.width() / 4; x < picture.width() * 3 / 4; ++x)
  {
    others += picture.pixel(x, picture.height() / 2) != middle;
  }
  QVERIFY(others > picture.width() / 4);
  QVERIFY(Find<QAction>(window.get(), "savePicture")->isEnabled());
  QVERIFY(window->View()->LastFrame().Seconds > 0.0);
}

//------------------------------------------------------------------------------
void TestViewerOpening::georeference()
{
  const Window window = this->NewWindow(this->Hills());
  const Field& field = window->Opened()->OpenedField();
  QCOMPARE(field.Heights.Spacing[0], 30.0);
  QCOMPARE(field.Frame.CoordinateToMap(0, 0.0), 1015.0);
  QCOMPARE(field.Frame.CoordinateToMap(1, 30.0), 2045.0);
  QCOMPARE(field.Frame.CoordinateToHeights(0, 1045.0), 30.0);
}

//------------------------------------------------------------------------------
// Meshes are looked at from above, in their own unit.
void TestViewerOpening::meshes()
{
  this->Write("roof.obj",
    "v 0 0 0\nv 8 0 0\nv 8 4 0\nv 0 4 0\nv 4 2 3\n"
    "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  const Window window = this->NewWindow(this->Path("roof.obj"));
  const Field& field = window->Opened()->OpenedField();
  QCOMPARE(field.Samples[0], 1024);
  QVERIFY(std::abs(field.Highest - 3.0) < 0.02 && std::abs(field.Lowest) < 0.02);
  QCOMPARE(window->Opened()->Scene()->GetHeightScale(), 1.0);
  QImage picture;
  COMPLETE_PICTURE(picture, window);
}

//------------------------------------------------------------------------------
// Heights without a unit are scaled, unless somebody has chosen a scale.
void TestViewerOpening::heightsWithoutUnit()
{
  QByteArray text = "P2 40 30 255\n";
  for (int k = 0; k < 40 * 30; ++k)
  {
    text += QByteArray::number(k % 40 < 20 ? 12 * (k % 20) : 240 - 12 * (k % 20)) + "\n";
  }
  this->Write("roof.pgm", text);
  const Window window = this->NewWindow(this->Path("roof.pgm"));
  Document* opened = window->Opened();
  const auto scale = [opened] { return opened->Scene()->GetHeightScale(); };
  const double fitted = opened->OpenedField().FittingScale;
  QVERIFY(fitted > 0.0 && fitted < 0.1); // of slopes of 12
  QVERIFY(this->Said.takeFirst().contains(QString::number(fitted)));
  QCOMPARE(scale(), fitted);
  QVERIFY(!window->isWindowModified());
  QCOMPARE(opened->Steps()->count(), 0);

  // Another field has a scale of its own, for older steps too, and nothing is told of the last one.
  Type(Find(window.get(), "density"), "2");
  QVERIFY(!window->statusBar()->currentMessage().isEmpty());
  QVERIFY(window->Open(this->Hills()));
  QVERIFY(window->statusBar()->currentMessage().isEmpty());
  QCOMPARE(scale(), 1.0);
  Trigger(window.get(), "undo");
  QCOMPARE(scale(), 1.0);
  Trigger(window.get(), "redo");
  QCOMPARE(scale(), 1.0);
  QVERIFY(window->Open(this->Path("roof.pgm")));
  QCOMPARE(scale(), fitted);

  // What was chosen stays, by hand or by a scene's file; one that names none gives way.
  Type(Find(window.get(), "heightScale"), "3");
  QVERIFY(window->Open(this->Hills()));
  QCOMPARE(scale(), 3.0);
  opened->Steps()->setClean();
  this->Write("named.json", R"({"reliefScene": 1, "heightScale": 1})");
  this->Write("unnamed.json", R"({"reliefScene": 1})");
  QVERIFY(window->Open(this->Path("named.json")));
  QVERIFY(window->Open(this->Path("roof.pgm")));
  QCOMPARE(scale(), 1.0);
  QVERIFY(window->Open(this->Path("unnamed.json")));
  QCOMPARE(scale(), fitted);
  this->Said.clear(); // the scale once more
}

//------------------------------------------------------------------------------
// A raster that is turned by a quarter on its map looks as one whose samples are.
void TestViewerOpening::turnedRasters()
{
#ifndef RELIEFRASTER_USE_GDAL
  QSKIP("this was built without GDAL");
#endif
  this->Hills();
  this->Write("turned.vrt",
    "<VRTDataset rasterXSize='64' rasterYSize='48'>"
    "<GeoTransform>2440, 0, -30, 3920, -30, 0</GeoTransform>"
    "<VRTRasterBand dataType='Float32' band='1'><SimpleSource>"
    "<SourceFilename relativeToVRT='1'>hills.asc</SourceFilename>"
    "</SimpleSource></VRTRasterBand></VRTDataset>");
  const QList<QByteArray> lines = this->Read("hills.asc").split('\n');
  QByteArray samples = "ncols 48\nnrows 64\nxllcorner 1000\nyllcorner 2000\ncellsize 30\n";
  for (int row = 0; row < 64; ++row)
  {
    for (int column = 0; column < 48; ++column)
    {
      samples += lines[5 + 47 - column].split(' ')[row] + (column < 47 ? ' ' : '\n');
    }
  }
  this->Write("straight.asc", samples);

  const Window straight = this->NewWindow(this->Path("straight.asc"));
  QImage expected;
  COMPLETE_PICTURE(expected, straight);
  const Window turned = this->NewWindow(this->Path("turned.vrt"));
  QImage picture;
  COMPLETE_PICTURE(picture, turned);
  QCOMPARE(picture.size(), expected.size());
  int different = 0;
  for (int y = 0; y < picture.height(); ++y)
  {
    for (int x = 0; x < picture.width(); ++x)
    {
      different += std::abs(qGray(picture.pixel(x, y)) - qGray(expected.pixel(x, y))) > 3;
    }
  }
  // Where pixels lie on the edge of samples, either one may be shown.
  QVERIFY2(
    different * 50 < picture.width() * picture.height(), qPrintable(QString::number(different)));
  // The sample under the mouse, at the north-eastern end, is the first one of the file.
  QWidget* view = turned->View();
  const Field& field = turned->Opened()->OpenedField();
  Mouse(view, QEvent::MouseMove, turned->View()->ToWidget(field.At(0, 1.0), field.At(1, 1.0)));
  const QString text = Find<QLabel>(turned.get(), "sampleText")->text();
  QVERIFY2(text.contains("x 242") && text.contains("y 390"), qPrintable(text));
  const QString first = QString::number(lines[5].split(' ')[0].toDouble(), 'g', 7);
  QVERIFY2(text.contains("height " + first), qPrintable(text));
}

//------------------------------------------------------------------------------
void TestViewerOpening::doubtfulHeightsAreTold()
{
  this->Write("marked.asc",
    "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 30\n-9999 -9999 7\n8 9 10\n");
  const Window window = this->NewWindow(this->Path("marked.asc"));
  QVERIFY(window->Opened()->HasField());
  QVERIFY(!this->Said.isEmpty());
  QVERIFY(this->Said.takeFirst().contains("-9999 in 2 of 6 samples"));
}

//------------------------------------------------------------------------------
void TestViewerOpening::byDrop()
{
  const Window window = this->NewWindow();
  this->Write("low.json", R"({"reliefScene": 1, "heightScale": 3,
    "lights": [{"kind": "sun", "azimuth": 90, "altitude": 10}]})");
  Drop(window.get(), { this->Hills(), this->Path("low.json") });
  QVERIFY(window->Opened()->HasField());
  QCOMPARE(window->Opened()->Scene()->GetHeightScale(), 3.0);
  QCOMPARE(window->Opened()->SceneFile(), this->Path("low.json"));
  QVERIFY(!window->isWindowModified());
}

//------------------------------------------------------------------------------
void TestViewerOpening::byDialog()
{
  const Window window = this->NewWindow();
  const QString file = this->Hills();
  ChooseFile(file);
  Trigger(window.get(), "open");
  QCOMPARE(window->Opened()->FieldFile(), file);
}

//------------------------------------------------------------------------------
// The program itself. That it has opened a file is seen from its settings.
void TestViewerOpening::byArgument()
{
  const QString file = this->Hills("argument.asc");
  QProcess program;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("XDG_CONFIG_HOME", this->Folder.path());
  program.setProcessEnvironment(environment);
  program.start(QString::fromLocal8Bit(qgetenv("RELIEFVIEWER")), { file });
  QVERIFY(program.waitForStarted());
  QTRY_VERIFY_WITH_TIMEOUT(
    this->Read("ReliefShading/reliefviewer.conf").contains("argument.asc"), 30000);
  QCOMPARE(program.state(), QProcess::Running);
  program.kill();
  program.waitForFinished();

  program.start(QString::fromLocal8Bit(qgetenv("RELIEFVIEWER")), { "--help" });
  QVERIFY(program.waitForFinished());
  QCOMPARE(program.exitCode(), 0);
  QVERIFY(program.readAllStandardOutput().contains("height fields"));
}

//------------------------------------------------------------------------------
void TestViewerOpening::badFilesKeepWhatWasOpen()
{
  const Window window = this->NewWindow(this->Hills());
  Type(Find(window.get(), "heightScale"), "2");
  this->Write("garbage.tif", "no picture at all");
  this->Write("cut.asc", "ncols 8\nnrows 8\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n");
  QImage before;
  COMPLETE_PICTURE(before, window);
  for (const QString& name :
    { QString("garbage.tif"), QString("cut.asc"), QString("absent.png"), QString("") })
  {
    QString message;
    Answer(QMessageBox::Ok, &message);
    QVERIFY(!window->Open(this->Path(name)));
    QVERIFY2(message.contains(this->Path(name)), qPrintable(message));
    QVERIFY2(!message.contains("vtk") && !message.contains('\n'), qPrintable(message));
  }
  QCOMPARE(window->Opened()->FieldFile(), this->Path("hills.asc"));
  QCOMPARE(window->Opened()->Scene()->GetHeightScale(), 2.0);
  QImage after;
  COMPLETE_PICTURE(after, window);
  QCOMPARE(after, before);
  window->Opened()->Steps()->setClean();
}

//------------------------------------------------------------------------------
void TestViewerOpening::badScenesKeepWhatWasOpen()
{
  const Window window = this->NewWindow(this->Hills());
  const std::string text = window->Opened()->Text();
  this->Write("bad.json", "{\"reliefScene\": 1,\n\"tolerance\": -1}");
  this->Write(
    "sky.json", R"({"reliefScene": 1, "environment": {"image": "file", "file": "absent.hdr"}})");
  for (const QString& name : { QString("bad.json"), QString("sky.json"), QString("absent.json") })
  {
    QString message;
    Answer(QMessageBox::Ok, &message);
    QVERIFY(!window->Open(this->Path(name)));
    QVERIFY2(message.contains(this->Path(name)), qPrintable(message));
    QVERIFY(name != "bad.json" || message.contains("line 2, tolerance: -1"));
  }
  QVERIFY(window->Opened()->Text() == text);
  QVERIFY(window->Opened()->SceneFile().isEmpty());
}

//------------------------------------------------------------------------------
void TestViewerOpening::samplesWithoutDataAreSeenThrough()
{
  // A plane with a hole in the middle third.
  QByteArray text = "ncols 9\nnrows 9\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n";
  for (int j = 0; j < 9; ++j)
  {
    for (int i = 0; i < 9; ++i)
    {
      text += i / 3 == 1 && j / 3 == 1 ? "-9999 " : "5 ";
    }
    text += "\n";
  }
  this->Write("hole.asc", text);
  const Window window = this->NewWindow(this->Path("hole.asc"));
  QCOMPARE(window->Opened()->OpenedField().Lowest, 5.0);
  QCOMPARE(window->Opened()->OpenedField().Mean, 5.0);
  QImage picture;
  COMPLETE_PICTURE(picture, window);
  const QRgb background = picture.pixel(1, 1);
  QCOMPARE(picture.pixel(window->View()->ToWidget(4.0, 4.0)), background);
  QVERIFY(picture.pixel(window->View()->ToWidget(1.0, 1.0)) != background);
}

//------------------------------------------------------------------------------
void TestViewerOpening::lampsKeepTheirPlaceOnTheMap()
{
  this->Write("lamp.json", R"({"reliefScene": 1,
    "lights": [{"kind": "point", "position": [1345.5, 2222.25, 900]}]})");
  const Window window = this->NewWindow(this->Hills());
  QVERIFY(window->Open(this->Path("lamp.json")));
  const double* position = window->Opened()->SelectedLight()->GetPosition();
  QCOMPARE(position[0], 330.5);
  QCOMPARE(position[1], 207.25);
  QCOMPARE(position[2], 900.0);
  const std::string text = window->Opened()->Text();
  QVERIFY(QString::fromStdString(text).contains("1345.5,"));
  // A field elsewhere: the same place is elsewhere in it.
  QByteArray other = this->Read("hills.asc");
  other.replace("xllcorner 1000", "xllcorner 1300");
  this->Write("other.asc", other);
  QVERIFY(window->Open(this->Path("other.asc")));
  QCOMPARE(window->Opened()->SelectedLight()->GetPosition()[0], 30.5);
  QVERIFY(window->Opened()->Text() == text);
  QVERIFY(!window->isWindowModified());
}

//------------------------------------------------------------------------------
void TestViewerOpening::degreesAreAskedFor()
{
  this->Write(
    "degrees.asc", "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 46\ncellsize 0.001\n5 6 7\n8 9 10\n");
  const Window window = this->NewWindow();
  QString message;
  Answer(QMessageBox::Yes, &message);
  QVERIFY(window->Open(this->Path("degrees.asc")));
  QVERIFY2(message.contains("degrees"), qPrintable(message));
  const auto& spacing = window->Opened()->OpenedField().Heights.Spacing;
  QVERIFY(std::abs(spacing[0] - 77.5) < 0.5 && std::abs(spacing[1] - 111.1) < 0.5);
  Answer(QMessageBox::No);
  QVERIFY(window->Open(this->Path("degrees.asc")));
  QCOMPARE(spacing[0], 0.001);
}

//------------------------------------------------------------------------------
// A slip of the pen in a scene is named, and the rest is read.
void TestViewerOpening::unknownKeysAreNamed()
{
  this->Write("slip.json", R"({"reliefScene": 1, "hightScale": 3, "tolerance": 0.01})");
  const Window window = this->NewWindow(this->Hills());
  QVERIFY(window->Open(this->Path("slip.json")));
  QCOMPARE(window->Opened()->Scene()->GetTolerance(), 0.01);
  QVERIFY(this->Said.takeFirst().contains("hightScale"));
}

//------------------------------------------------------------------------------
void TestViewerOpening::helpListsTheKeys()
{
  const Window window = this->NewWindow();
  QString text;
  InDialog<QDialog>(
    [&text](QDialog* dialog)
    {
      text = dialog->findChild<QTextBrowser*>("shortcutsText")->toPlainText();
      dialog->reject();
    });
  Trigger(window.get(), "shortcuts");
  for (const char* part :
    { "Ctrl+O", "Ctrl+Z", "Ctrl+S", "Ctrl+E", "F11", "Fit heights", "Drag a dot" })
  {
    QVERIFY2(text.contains(part), part);
  }
  // No two actions share one.
  QStringList keys;
  for (const QAction* action : window->findChildren<QAction*>())
  {
    for (const QKeySequence& key : action->shortcuts())
    {
      keys += key.toString();
    }
  }
  QCOMPARE(keys.removeDuplicates(), 0);
}

//------------------------------------------------------------------------------
void TestViewerOpening::recentFiles()
{
  QSettings().clear();
  const Window window = this->NewWindow(this->Hills());
  QVERIFY(window->Open(this->Hills("second.asc")));
  QVERIFY(window->Open(this->Hills()));
  const QStringList expected{ this->Path("hills.asc"), this->Path("second.asc") };
  QCOMPARE(QSettings().value("recentFiles").toStringList(), expected);
}

//------------------------------------------------------------------------------
void TestViewerOpening::remembersItsWindow()
{
  QSettings().clear();
  {
    const Window window = this->NewWindow(this->Hills());
    window->resize(777, 555);
    Trigger(window.get(), "showPanel");
    QVERIFY(!Find(window.get(), "panel")->isVisible());
    QVERIFY(window->close());
  }
  MainWindow again;
  QCOMPARE(again.size(), QSize(777, 555));
  again.show();
  QVERIFY(!again.findChild<QWidget*>("panel")->isVisible());
  QSettings().clear();
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerOpening>(argc, argv);
}

#include "TestViewerOpening.moc"
