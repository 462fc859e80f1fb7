// SPDX-License-Identifier: BSD-3-Clause

// A small screen of high resolution: 1024 x 700 pixels, two of them for each unit of the window.
// The window fits, and is where and how it was left.

#include "ViewerTest.h"

#include "Panel.h"

#include <QAction>
#include <QDockWidget>
#include <QLabel>
#include <QProcess>
#include <QScreen>
#include <QScrollBar>
#include <QSettings>
#include <QTextBrowser>

using namespace reliefviewer;

class TestViewerScreen : public ViewerTest
{
  Q_OBJECT

private slots:
  void init();
  void fits();
  void fitsWithAFieldOpen();
  void panelScrolls();
  void dialogsFit();
  void remembersSizePlaceAndPanel();
  void comesBackFromALargerScreen();
  void helpNeedsNoDisplay();

private:
  using Quiet = std::unique_ptr<MainWindow>;
  /// A window as the program makes it: of no size that a test has chosen.
  static Quiet Shown();
  static QRect Screen() { return QGuiApplication::primaryScreen()->availableGeometry(); }
};

//------------------------------------------------------------------------------
void TestViewerScreen::init()
{
  // The user's settings are none of a test's business.
  QVERIFY(QSettings().fileName().startsWith(QDir::tempPath()));
  QSettings().clear();
  if (Screen().size() != QSize(512, 350))
  {
    QSKIP("The screen is another one");
  }
}

//------------------------------------------------------------------------------
TestViewerScreen::Quiet TestViewerScreen::Shown()
{
  auto window = std::make_unique<MainWindow>();
  window->show();
  if (!QTest::qWaitForWindowExposed(window.get()))
  {
    qFatal("The window does not appear");
  }
  QTest::qWait(50);
  return window;
}

//------------------------------------------------------------------------------
void TestViewerScreen::fits()
{
  const Quiet window = Shown();
  QVERIFY2(Screen().contains(window->frameGeometry()),
    qPrintable(QString("%1 x %2").arg(window->width()).arg(window->height())));
}

//------------------------------------------------------------------------------
void TestViewerScreen::fitsWithAFieldOpen()
{
  const Quiet window = Shown();
  QVERIFY(window->Open(this->Hills()));
  QTRY_VERIFY(window->View()->LastFrame().Converged);
  // The status bar has much to say.
  const QPoint middle(window->View()->width() / 2, window->View()->height() / 2);
  Mouse(window->View(), QEvent::MouseMove, middle);
  QVERIFY(!Find<QLabel>(window.get(), "sampleText")->text().isEmpty());
  Find<QLabel>(window.get(), "frameText")->setText(QString("what is told ").repeated(20));
  QTest::qWait(50);
  QVERIFY(Screen().contains(window->frameGeometry()));
  QVERIFY(window->minimumSizeHint().width() <= Screen().width());
  // Picture and panel are both there.
  QVERIFY(window->View()->width() >= 120 && window->SidePanel()->width() >= 200);
  QVERIFY(window->View()->height() >= 120 && window->SidePanel()->height() >= 120);
}

//------------------------------------------------------------------------------
void TestViewerScreen::panelScrolls()
{
  const Quiet window = Shown();
  QVERIFY(window->Open(this->Hills()));
  QTest::qWait(50);
  // The panel reaches its last row, and no row is cut off at its side.
  QScrollBar* bar = window->SidePanel()->verticalScrollBar();
  QVERIFY(bar->maximum() > 0);
  bar->setValue(bar->maximum());
  QWidget* last = Find(window.get(), "accuracySection");
  const QRect seen(QPoint(0, 0), window->SidePanel()->viewport()->size());
  const QRect row(last->mapTo(window->SidePanel()->viewport(), QPoint(0, 0)), last->size());
  QVERIFY(seen.contains(row));
}

//------------------------------------------------------------------------------
void TestViewerScreen::dialogsFit()
{
  const Quiet window = Shown();
  QRect place;
  int longer = 0;
  InDialog<QDialog>(
    [&](QDialog* dialog)
    {
      QTest::qWait(50);
      place = dialog->frameGeometry();
      longer = dialog->findChild<QTextBrowser*>("shortcutsText")->verticalScrollBar()->maximum();
      dialog->reject();
    });
  Trigger(window.get(), "shortcuts");
  QVERIFY(Screen().contains(place));
  QVERIFY(longer > 0);
}

//------------------------------------------------------------------------------
void TestViewerScreen::remembersSizePlaceAndPanel()
{
  QRect place;
  int panel = 0;
  {
    const Quiet window = Shown();
    window->setGeometry(20, 30, 460, 300);
    QTest::qWait(50);
    auto* dock = Find<QDockWidget>(window.get(), "panel");
    window->resizeDocks({ dock }, { dock->width() + 20 }, Qt::Horizontal);
    window->SidePanel()->SetOpenSections({ "accuracySection" });
    QTest::qWait(50);
    place = window->geometry();
    panel = dock->width();
    QVERIFY(window->close());
  }
  {
    const Quiet window = Shown();
    QCOMPARE(window->geometry(), place);
    QCOMPARE(Find(window.get(), "panel")->width(), panel);
    QCOMPARE(window->SidePanel()->OpenSections(), QStringList("accuracySection"));
    Trigger(window.get(), "showPanel");
    QVERIFY(window->close());
  }
  const Quiet window = Shown();
  QVERIFY(!Find(window.get(), "panel")->isVisible());
}

//------------------------------------------------------------------------------
void TestViewerScreen::comesBackFromALargerScreen()
{
  {
    const Quiet window = Shown();
    window->setGeometry(900, 700, 1400, 1000);
    QTest::qWait(50);
    QVERIFY(window->close());
  }
  const Quiet window = Shown();
  QVERIFY2(Screen().contains(window->frameGeometry()),
    qPrintable(QString("%1 x %2").arg(window->width()).arg(window->height())));
}

//------------------------------------------------------------------------------
void TestViewerScreen::helpNeedsNoDisplay()
{
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  for (const char* name : { "DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM" })
  {
    environment.remove(name);
  }
  for (const char* option : { "--help", "-h", "--version", "-v" })
  {
    QProcess program;
    program.setProcessEnvironment(environment);
    program.start(QString::fromLocal8Bit(qgetenv("RELIEFVIEWER")), { option });
    QVERIFY(program.waitForFinished());
    QCOMPARE(program.exitStatus(), QProcess::NormalExit);
    QCOMPARE(program.exitCode(), 0);
    QVERIFY(program.readAllStandardOutput().contains("reliefviewer"));
    QCOMPARE(program.readAllStandardError(), QByteArray());
  }
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerScreen>(argc, argv);
}

#include "TestViewerScreen.moc"
