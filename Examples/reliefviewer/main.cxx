// SPDX-License-Identifier: BSD-3-Clause

// reliefviewer: shows height fields, shaded while you move the light. MainWindow.h is the window,
// Document.h what is open in it, ReliefView.h the picture and Panel.h what is beside it.

#include "MainWindow.h"
#include "MessageLog.h"
#include "Threads.h"

#include <QApplication>
#include <QCommandLineParser>
#include <QVTKOpenGLNativeWidget.h>

#include <clocale>

int main(int argc, char* argv[])
{
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication application(argc, argv);
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
  parser.process(application);

  reliefshade::catchMessages();
  reliefshade::setThreads(0);
  reliefviewer::MainWindow window;
  window.show();
  for (const QString& file : parser.positionalArguments())
  {
    window.Open(file);
  }
  return QApplication::exec();
}
