// SPDX-License-Identifier: BSD-3-Clause
#include "ViewerTest.h"

#include "MessageLog.h"
#include "Threads.h"

#include "vtkReliefLightRepresentation.h"

#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QFileDialog>
#include <QLineEdit>
#include <QMouseEvent>
#include <QProcess>
#include <QPushButton>
#include <QSettings>
#include <QSlider>
#include <QStatusBar>
#include <QWheelEvent>

#include <clocale>
#include <cmath>

using namespace reliefviewer;

//------------------------------------------------------------------------------
void ViewerTest::SetUp()
{
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0)
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling); // Qt 6 always does
#endif
  QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
}

//------------------------------------------------------------------------------
void ViewerTest::SetUpApplication()
{
  std::setlocale(LC_NUMERIC, "C");
  static QTemporaryDir settings;
  QSettings::setDefaultFormat(QSettings::IniFormat);
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  QApplication::setOrganizationName(QStringLiteral("ReliefShading"));
  QApplication::setApplicationName(QStringLiteral("reliefviewer-tests"));
  reliefshade::catchMessages();
  reliefshade::setThreads(0);
}

//------------------------------------------------------------------------------
ViewerTest::Window ViewerTest::NewWindow(const QString& file)
{
  auto window = std::make_unique<MainWindow>();
  connect(window->statusBar(), &QStatusBar::messageChanged, this,
    [this](const QString& message)
    {
      if (!message.isEmpty())
      {
        this->Said += message;
      }
    });
  window->resize(900, 640);
  window->show();
  if (!QTest::qWaitForWindowExposed(window.get()))
  {
    qFatal("The window does not appear");
  }
  if (!file.isEmpty() &&
    (!window->Open(file) ||
      !QTest::qWaitFor([&] { return window->View()->LastFrame().Converged; }, 30000)))
  {
    qFatal("%s is not shown", qPrintable(file));
  }
  return window;
}

//------------------------------------------------------------------------------
void ViewerTest::cleanup()
{
  const QString error = QString::fromStdString(reliefshade::takeError());
  QVERIFY2(error.isEmpty(), qPrintable(error));
  // What pictures are opened with, and no complaint.
  for (qsizetype at = this->Said.size() - 1; at >= 0; --at)
  {
    if (this->Said[at].startsWith(QStringLiteral("The heights have no unit")))
    {
      this->Said.removeAt(at);
    }
  }
  const QString said = this->Said.join(QStringLiteral("; "));
  this->Said.clear();
  QVERIFY2(said.isEmpty(), qPrintable(said));
}

//------------------------------------------------------------------------------
void ViewerTest::Write(const QString& name, const QByteArray& text) const
{
  QFile file(this->Path(name));
  if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size())
  {
    qFatal("%s cannot be written", qPrintable(name));
  }
}

//------------------------------------------------------------------------------
QByteArray ViewerTest::Read(const QString& name) const
{
  QFile file(this->Path(name));
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

//------------------------------------------------------------------------------
QString ViewerTest::Hills(const QString& name, int columns, int rows) const
{
  QByteArray text =
    QStringLiteral("ncols %1\nnrows %2\nxllcorner 1000\nyllcorner 2000\ncellsize 30\n")
      .arg(columns)
      .arg(rows)
      .toLatin1();
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      const double height =
        300.0 + 150.0 * std::sin(0.21 * i) * std::cos(0.17 * j) + (i * 7 + j * 5 + i * j) % 11;
      text += QByteArray::number(height, 'f', 2) + (i + 1 < columns ? ' ' : '\n');
    }
  }
  this->Write(name, text);
  return this->Path(name);
}

//------------------------------------------------------------------------------
void ViewerTest::Reliefshade(const QStringList& words) const
{
  QProcess program;
  program.setWorkingDirectory(this->Folder.path());
  program.start(QString::fromLocal8Bit(qgetenv("RELIEFSHADE")), words);
  if (!program.waitForFinished() || program.exitCode() != 0)
  {
    qFatal("reliefshade: %s", program.readAllStandardError().constData());
  }
}

//------------------------------------------------------------------------------
void ViewerTest::Mouse(
  QWidget* widget, QEvent::Type type, const QPoint& at, Qt::KeyboardModifiers modifiers)
{
  const bool held = type == QEvent::MouseButtonPress || type == QEvent::MouseButtonDblClick;
  static bool down = false;
  down = held || (down && type == QEvent::MouseMove);
  QMouseEvent event(type, at, widget->mapToGlobal(at),
    type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton, down ? Qt::LeftButton : Qt::NoButton,
    modifiers);
  QApplication::sendEvent(widget, &event);
  QApplication::processEvents();
}

//------------------------------------------------------------------------------
void ViewerTest::Drag(
  QWidget* widget, const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers)
{
  constexpr int steps = 5;
  Mouse(widget, QEvent::MouseMove, from, modifiers);
  Mouse(widget, QEvent::MouseButtonPress, from, modifiers);
  for (int i = 1; i <= steps; ++i)
  {
    Mouse(widget, QEvent::MouseMove, from + (to - from) * i / steps, modifiers);
  }
  Mouse(widget, QEvent::MouseButtonRelease, to, modifiers);
}

//------------------------------------------------------------------------------
void ViewerTest::Wheel(QWidget* widget, const QPoint& at, int steps)
{
  Mouse(widget, QEvent::MouseMove, at);
  QWheelEvent event(at, widget->mapToGlobal(at), QPoint(), QPoint(0, 120 * steps), Qt::NoButton,
    Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(widget, &event);
  QApplication::processEvents();
}

//------------------------------------------------------------------------------
void ViewerTest::DragSlider(QWidget* row, double share)
{
  auto* slider = row->findChild<QSlider*>(QStringLiteral("slider"));
  const int y = slider->height() / 2;
  const int now = static_cast<int>(slider->width() * (slider->value() / 1000.0));
  Drag(slider, QPoint(now, y), QPoint(static_cast<int>(slider->width() * share), y));
}

//------------------------------------------------------------------------------
void ViewerTest::Type(QWidget* row, const QString& text)
{
  auto* box = row->findChild<QAbstractSpinBox*>(QStringLiteral("box"));
  box->setFocus();
  box->selectAll();
  QTest::keyClicks(box, text);
  QTest::keyClick(box, Qt::Key_Return);
}

//------------------------------------------------------------------------------
void ViewerTest::ChooseFile(const QString& file)
{
  InDialog<QFileDialog>(
    [file](QFileDialog* dialog)
    {
      auto* name = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
      name->setCompleter(nullptr);           // its list would take the key that ends the dialog
      QApplication::setActiveWindow(dialog); // there may be no window manager to do it
      name->setFocus();
      name->selectAll();
      QTest::keyClicks(name, file);
      QTest::keyClick(name, Qt::Key_Return);
    });
}

//------------------------------------------------------------------------------
void ViewerTest::Answer(QMessageBox::StandardButton button, QString* message)
{
  InDialog<QMessageBox>(
    [button, message](QMessageBox* box)
    {
      if (message)
      {
        *message = box->text();
      }
      QTest::mouseClick(box->button(button), Qt::LeftButton);
    });
}

//------------------------------------------------------------------------------
QImage ViewerTest::Picture(MainWindow* window)
{
  // What is to be rendered is, before the picture is asked for.
  QApplication::processEvents();
  ReliefView* view = window->View();
  return view->LastFrame().Converged && !view->RefreshPending() ? view->grabFramebuffer()
                                                                : QImage();
}

//------------------------------------------------------------------------------
void ViewerTest::Trigger(MainWindow* window, const char* action)
{
  Find<QAction>(window, action)->trigger();
}

//------------------------------------------------------------------------------
QPoint ViewerTest::DotAt(MainWindow* window, int light)
{
  double at[3];
  if (!window->View()->Dot(light) || !window->View()->Dot(light)->GetDotPosition(at))
  {
    qFatal("Light %d has no dot", light);
  }
  return window->View()->ToWidget(at[0], at[1]);
}
