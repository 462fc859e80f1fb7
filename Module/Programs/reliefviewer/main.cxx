// SPDX-License-Identifier: BSD-3-Clause

// reliefviewer: shows height fields, shaded while you move the light. MainWindow.h is the window,
// Document.h what is open in it, ReliefView.h the picture and Panel.h what is beside it.

#include "MainWindow.h"
#include "MessageLog.h"
#include "ReferencedPicture.h"
#include "Threads.h"

#include <QApplication>
#include <QCommandLineParser>
#include <QVTKOpenGLNativeWidget.h>

#include <algorithm>
#include <clocale>
#include <iterator>
#include <memory>
#include <string>

namespace
{

/// Whether all that is wanted is a text: that takes no display.
bool asksForText(int argc, char* argv[])
{
  const std::string texts[] = { "-h", "--help", "--help-all", "-v", "--version" };
  return std::any_of(argv + 1, std::find(argv + 1, argv + argc, std::string("--")),
    [&texts](const char* word)
    { return std::find(std::begin(texts), std::end(texts), word) != std::end(texts); });
}

}

int main(int argc, char* argv[])
{
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0)
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling); // Qt 6 always does
#endif
  const std::unique_ptr<QCoreApplication> application = asksForText(argc, argv)
    ? std::make_unique<QCoreApplication>(argc, argv)
    : std::make_unique<QApplication>(argc, argv);
  std::setlocale(LC_NUMERIC, "C"); // numbers in files have points, whatever the language
  QApplication::setOrganizationName(QStringLiteral("ReliefShading"));
  QApplication::setApplicationName(QStringLiteral("reliefviewer"));
  QApplication::setApplicationVersion(QStringLiteral(RELIEFVIEWER_VERSION));

  QCommandLineParser parser;
  parser.setApplicationDescription(QObject::tr(
    "Shows height fields, shaded while you move the light. Files are height fields, as reliefshade "
    "takes them, and scenes (.json)."));
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument(
    QStringLiteral("FILE"), QObject::tr("What to open"), QStringLiteral("[FILE...]"));
  parser.process(*application);

  reliefshade::catchMessages();
  relief::raster::KeepGdalQuiet();
  reliefshade::setThreads(0);
  reliefviewer::MainWindow window;
  window.show();
  for (const QString& file : parser.positionalArguments())
  {
    window.Open(file);
  }
  return QApplication::exec();
}
