// SPDX-License-Identifier: BSD-3-Clause

// Files of several bands, masks, and what the viewer says of files that it cannot take as they are.

#include "ViewerTest.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkReliefScene.h"

#include <QAction>
#include <QInputDialog>

using namespace reliefviewer;

class TestViewerMasks : public ViewerTest
{
  Q_OBJECT

private slots:
  void colorsAskForABand();
  void bandsHaveNames();
  void maskHidesAndIsTakenAway();
  void maskOfAlpha();
  void maskAddsToTheFilesOwn();
  void masksThatDoNotFit();
  void messagesSpeakOfTheWindow();

private:
  /// A picture whose red, green and blue rise along x, along y, and not at all; transparent in its
  /// left half if it has alpha.
  QString Colors(const QString& name, bool alpha, int columns = 64, int rows = 48) const;
  /// Grey: black in its left half.
  QString Gray(const QString& name, int columns = 64, int rows = 48) const;
  /// Chooses in the dialog for bands that comes next; its text and choices go to these.
  static void ChooseBand(int band, QString* text = nullptr, QStringList* choices = nullptr);
  static double Height(const Window& window, int x, int y);
  static int Shown(const Window& window);
};

//------------------------------------------------------------------------------
QString TestViewerMasks::Colors(const QString& name, bool alpha, int columns, int rows) const
{
  QImage image(columns, rows, alpha ? QImage::Format_ARGB32 : QImage::Format_RGB888);
  for (int y = 0; y < rows; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      image.setPixelColor(x, y, QColor(x, y, 7, alpha && x < columns / 2 ? 0 : 255));
    }
  }
  return image.save(this->Path(name)) ? this->Path(name) : QString();
}

//------------------------------------------------------------------------------
QString TestViewerMasks::Gray(const QString& name, int columns, int rows) const
{
  QImage image(columns, rows, QImage::Format_Grayscale8);
  for (int y = 0; y < rows; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      image.setPixelColor(x, y, x < columns / 2 ? Qt::black : Qt::white);
    }
  }
  return image.save(this->Path(name)) ? this->Path(name) : QString();
}

//------------------------------------------------------------------------------
void TestViewerMasks::ChooseBand(int band, QString* text, QStringList* choices)
{
  InDialog<QInputDialog>(
    [=](QInputDialog* dialog)
    {
      if (text)
      {
        *text = dialog->labelText();
      }
      if (choices)
      {
        *choices = dialog->comboBoxItems();
      }
      if (band == 0)
      {
        dialog->reject();
        return;
      }
      dialog->setTextValue(dialog->comboBoxItems().value(band - 1));
      dialog->accept();
    });
}

//------------------------------------------------------------------------------
double TestViewerMasks::Height(const Window& window, int x, int y)
{
  return window->Opened()->OpenedField().Heights.Heights->GetScalarComponentAsDouble(x, y, 0, 0);
}

//------------------------------------------------------------------------------
/// How many samples have data.
int TestViewerMasks::Shown(const Window& window)
{
  const Field& field = window->Opened()->OpenedField();
  int shown = 0;
  for (int i = 0; i < field.Samples[0] * field.Samples[1]; ++i)
  {
    shown += field.HasData(i) ? 1 : 0;
  }
  return shown;
}

//------------------------------------------------------------------------------
void TestViewerMasks::colorsAskForABand()
{
  const Window window = this->NewWindow();
  for (const QString& file : { this->Colors("colors.png", false), this->Colors("alpha.png", true) })
  {
    QVERIFY(!file.isEmpty());
    QString text;
    QStringList choices;
    ChooseBand(2, &text, &choices);
    QVERIFY(window->Open(file));
    QVERIFY2(text.contains(QFileInfo(file).fileName()), qPrintable(text));
    QCOMPARE(choices, QStringList({ "Band 1: red", "Band 2: green", "Band 3: blue" }));
    QCOMPARE(Height(window, 5, 0), 47.0); // the lowest row
    QCOMPARE(Height(window, 5, 40), 7.0);
    QVERIFY(window->windowTitle().contains("band 2"));
    QCOMPARE(Shown(window), file.contains("alpha") ? 32 * 48 : 64 * 48);
  }
  // Another one, from the menu; no choice keeps what there is.
  ChooseBand(1);
  Trigger(window.get(), "chooseBand");
  QCOMPARE(Height(window, 5, 0), 5.0);
  ChooseBand(0);
  Trigger(window.get(), "chooseBand");
  QCOMPARE(Height(window, 5, 0), 5.0);
  ChooseBand(0);
  QVERIFY(!window->Open(this->Path("colors.png")));
  QCOMPARE(window->Opened()->FieldFile(), this->Path("alpha.png"));
  // One band is no choice.
  QVERIFY(window->Open(this->Hills()));
  QVERIFY(!Find<QAction>(window.get(), "chooseBand")->isEnabled());
}

//------------------------------------------------------------------------------
void TestViewerMasks::bandsHaveNames()
{
#ifdef RELIEFRASTER_USE_GDAL
  this->Hills("one.asc", 8, 6);
  this->Write("two.asc",
    "ncols 8\nnrows 6\nxllcorner 1000\nyllcorner 2000\ncellsize 30\n" +
      QByteArray("9 ").repeated(8 * 6));
  QByteArray text = "<VRTDataset rasterXSize=\"8\" rasterYSize=\"6\">\n"
                    "<GeoTransform>1000, 30, 0, 2180, 0, -30</GeoTransform>\n";
  for (const char* name : { "one", "two" })
  {
    text += QByteArray("<VRTRasterBand dataType=\"Float32\"><Description>the ") + name +
      "</Description><SimpleSource><SourceFilename relativeToVRT=\"1\">" + name +
      ".asc</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>\n";
  }
  this->Write("stack.vrt", text + "</VRTDataset>\n");
  // The first band is heights by itself: nobody is asked, and the menu has the others.
  const Window window = this->NewWindow(this->Path("stack.vrt"));
  QVERIFY(Height(window, 0, 0) != 9.0);
  QStringList choices;
  ChooseBand(2, nullptr, &choices);
  Trigger(window.get(), "chooseBand");
  QCOMPARE(choices, QStringList({ "Band 1: the one", "Band 2: the two" }));
  QCOMPARE(Height(window, 0, 0), 9.0);
  QCOMPARE(window->Opened()->OpenedField().Heights.Spacing[0], 30.0);
#else
  QSKIP("Without GDAL no format has names");
#endif
}

//------------------------------------------------------------------------------
void TestViewerMasks::maskHidesAndIsTakenAway()
{
  const Window window = this->NewWindow(this->Hills());
  Type(Find(window.get(), "heightScale"), "2");
  const std::string scene = window->Opened()->Text();
  const int steps = window->Opened()->Steps()->count();
  window->View()->Zoom(2.0);
  QImage before;
  COMPLETE_PICTURE(before, window);
  QVERIFY(!Find<QAction>(window.get(), "removeMask")->isEnabled());
  ChooseFile(this->Gray("mask.png"));
  Trigger(window.get(), "openMask");
  QCOMPARE(Shown(window), 32 * 48);
  QVERIFY(window->windowTitle().contains("masked"));
  QImage masked;
  COMPLETE_PICTURE(masked, window);
  QVERIFY(masked != before);
  // Scene, steps and place are what they were.
  QVERIFY(window->Opened()->Text() == scene);
  QCOMPARE(window->Opened()->Steps()->count(), steps);
  Trigger(window.get(), "undo");
  QCOMPARE(Shown(window), 32 * 48);
  Trigger(window.get(), "redo");
  // What is saved has it, as reliefshade has.
  QVERIFY(window->SavePicture(this->Path("masked.png")));
  const QImage saved(this->Path("masked.png"));
  QCOMPARE(qAlpha(saved.pixel(3, 20)), 0);
  QCOMPARE(qAlpha(saved.pixel(60, 20)), 255);
  QVERIFY(window->SaveScene(this->Path("masked.json")));
  this->Reliefshade(
    { "hills.asc", "expected.png", "--mask", "mask.png", "--scene", "masked.json" });
  QCOMPARE(saved, QImage(this->Path("expected.png")));
  // And without it all is as before, at the same place.
  Trigger(window.get(), "removeMask");
  QCOMPARE(Shown(window), 64 * 48);
  QImage after;
  COMPLETE_PICTURE(after, window);
  QCOMPARE(after, before);
  // Another field has none.
  QVERIFY(window->OpenMask(this->Path("mask.png")));
  QVERIFY(window->Open(this->Hills("other.asc")));
  QCOMPARE(Shown(window), 64 * 48);
}

//------------------------------------------------------------------------------
void TestViewerMasks::maskOfAlpha()
{
  const Window window = this->NewWindow(this->Hills());
  QVERIFY(window->OpenMask(this->Colors("alpha.png", true)));
  QCOMPARE(Shown(window), 32 * 48);
  // Colours without alpha: the user says which of them it is. Red is 0 in the first column alone.
  QString text;
  ChooseBand(1, &text);
  QVERIFY(window->OpenMask(this->Colors("colors.png", false)));
  QVERIFY2(text.contains("the mask"), qPrintable(text));
  QCOMPARE(Shown(window), 63 * 48);
  // The command line takes the same.
  this->Reliefshade({ "hills.asc", "expected.png", "--mask", "alpha.png" });
  QCOMPARE(qAlpha(QImage(this->Path("expected.png")).pixel(3, 20)), 0);
}

//------------------------------------------------------------------------------
void TestViewerMasks::maskAddsToTheFilesOwn()
{
  const Window window = this->NewWindow();
  ChooseBand(1);
  QVERIFY(window->Open(this->Colors("alpha.png", true)));
  QImage top(64, 48, QImage::Format_Grayscale8);
  top.fill(Qt::white);
  for (int x = 0; x < 64; ++x)
  {
    top.setPixelColor(x, 0, Qt::black);
  }
  QVERIFY(top.save(this->Path("top.png")));
  QVERIFY(window->OpenMask(this->Path("top.png")));
  QCOMPARE(Shown(window), 32 * 47);
  // Another band of the file keeps it.
  ChooseBand(2);
  Trigger(window.get(), "chooseBand");
  QCOMPARE(Shown(window), 32 * 47);
  Trigger(window.get(), "removeMask");
  QCOMPARE(Shown(window), 32 * 48);
}

//------------------------------------------------------------------------------
void TestViewerMasks::masksThatDoNotFit()
{
  const Window window = this->NewWindow(this->Hills());
  this->Write("garbage.png", "no picture");
  for (const QString& file :
    { this->Gray("small.png", 10, 20), this->Path("garbage.png"), this->Path("absent.png") })
  {
    QString message;
    Answer(QMessageBox::Ok, &message);
    QVERIFY(!window->OpenMask(file));
    QVERIFY2(message.contains(file) && message.size() < 300, qPrintable(message));
    QVERIFY2(!file.contains("small") ||
        (message.contains("10 x 20") && message.contains("64 x 48") &&
          message.contains("hills.asc")),
      qPrintable(message));
    QCOMPARE(Shown(window), 64 * 48);
  }
}

//------------------------------------------------------------------------------
// The options of the command line are none of the viewer's.
void TestViewerMasks::messagesSpeakOfTheWindow()
{
  const Window window = this->NewWindow();
  // Of so many samples that no machine has room for them.
  this->Hills("one.asc", 8, 6);
  this->Write("huge.vrt",
    "<VRTDataset rasterXSize=\"2000000\" rasterYSize=\"2000000\">"
    "<VRTRasterBand dataType=\"Float32\"><SimpleSource><SourceFilename relativeToVRT=\"1\">one.asc"
    "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  this->Write("garbage.tif", "no picture");
  QStringList messages;
  const auto refused = [&](const std::function<bool()>& action)
  {
    QString message;
    Answer(QMessageBox::Ok, &message);
    QVERIFY(!action());
    messages += message;
  };
  for (const char* name : { "huge.vrt", "garbage.tif", "absent.tif" })
  {
    refused([&] { return window->Open(this->Path(name)); });
  }
#ifdef RELIEFRASTER_USE_GDAL
  QVERIFY2(messages.first().contains("this machine"), qPrintable(messages.first()));
#endif
  QVERIFY(window->Open(this->Hills()));
  refused([&] { return window->SavePicture(this->Path("none.xyz")); });
  refused([&] { return window->SaveLayers(this->Path("no/such/folder.exr")); });
  for (const QString& message : messages)
  {
    QVERIFY2(!message.contains("--"), qPrintable(message));
  }
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerMasks>(argc, argv);
}

#include "TestViewerMasks.moc"
