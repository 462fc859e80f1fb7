// SPDX-License-Identifier: BSD-3-Clause
#ifndef ViewerTest_h
#define ViewerTest_h

#include "Document.h"
#include "MainWindow.h"
#include "NumberRow.h"
#include "ReliefView.h"

#include <QImage>
#include <QMessageBox>
#include <QTemporaryDir>
#include <QtTest>

#include <functional>
#include <memory>

/// What the tests of the viewer share: a window, small height fields, and the mouse. Settings are
/// kept in a folder of their own.
class ViewerTest : public QObject
{
  Q_OBJECT

public:
  /// Runs a test's functions in an application that is set up as reliefviewer is.
  template <class Test>
  static int Run(int argc, char* argv[])
  {
    SetUp();
    QApplication application(argc, argv);
    SetUpApplication();
    Test test;
    return QTest::qExec(&test, argc, argv);
  }

  using Window = std::unique_ptr<reliefviewer::MainWindow>;

  /// A shown window, empty or with a file open and its picture complete.
  Window NewWindow(const QString& file = QString());

  QString Path(const QString& name) const { return this->Folder.filePath(name); }
  void Write(const QString& name, const QByteArray& text) const;
  QByteArray Read(const QString& name) const;
  /// An ESRI grid of hills, 64 x 48 samples of 30, on the map from 1000, 2000.
  QString Hills(
    const QString& name = QStringLiteral("hills.asc"), int columns = 64, int rows = 48) const;

  /// Runs reliefshade; fails if it complains.
  void Reliefshade(const QStringList& words) const;

  static void Mouse(QWidget* widget, QEvent::Type type, const QPoint& at,
    Qt::KeyboardModifiers modifiers = Qt::NoModifier);
  /// Press, moves in steps, release.
  static void Drag(QWidget* widget, const QPoint& from, const QPoint& to,
    Qt::KeyboardModifiers modifiers = Qt::NoModifier);
  static void Wheel(QWidget* widget, const QPoint& at, int steps);
  static void DragSlider(QWidget* row, double share);
  static void Type(QWidget* row, const QString& text);

  /// What the user does in the modal dialog that comes next.
  template <class Dialog>
  static void InDialog(const std::function<void(Dialog*)>& action)
  {
    auto* timer = new QTimer(qApp);
    QObject::connect(timer, &QTimer::timeout,
      [timer, action]
      {
        if (auto* dialog = qobject_cast<Dialog*>(QApplication::activeModalWidget()))
        {
          timer->stop();
          timer->deleteLater();
          action(dialog);
        }
      });
    timer->start(10);
  }

  /// In the file dialog that comes next.
  static void ChooseFile(const QString& file);
  /// Answers the message box that comes next, whose text goes to `message`.
  static void Answer(QMessageBox::StandardButton button, QString* message = nullptr);

  /// The picture when it is complete.
  static QImage Picture(reliefviewer::MainWindow* window);
  static void Trigger(reliefviewer::MainWindow* window, const char* action);
  /// Where a light's dot is in the view.
  static QPoint DotAt(reliefviewer::MainWindow* window, int light);

  template <class Widget = QWidget>
  static Widget* Find(reliefviewer::MainWindow* window, const char* name)
  {
    auto* widget = window->findChild<Widget*>(QLatin1String(name));
    if (!widget)
    {
      qFatal("There is no widget %s", name);
    }
    return widget;
  }

protected slots:
  /// What the status bar has said, errors of OpenGL among it, must have been expected.
  void cleanup();

protected:
  QTemporaryDir Folder;
  /// What the status bar has said. A test that expects something takes it out.
  QStringList Said;

private:
  static void SetUp();
  static void SetUpApplication();
};

/// Waits until the picture is complete and takes it.
#define COMPLETE_PICTURE(picture, window)                                                          \
  QTRY_VERIFY_WITH_TIMEOUT(!(picture = Picture((window).get())).isNull(), 30000)

#endif
