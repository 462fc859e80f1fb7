// SPDX-License-Identifier: BSD-3-Clause
#include "MainWindow.h"

#include "Document.h"
#include "EnvironmentSection.h"
#include "Failure.h"
#include "LightSection.h"
#include "MessageLog.h"
#include "Panel.h"
#include "ReliefView.h"
#include "Saving.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefEnvironmentImage.h"
#include "vtkReliefScene.h"

#include <QAction>
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMessageBox>
#include <QMimeData>
#include <QRegularExpression>
#include <QScreen>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QStyle>
#include <QTimer>

#include <algorithm>
#include <cmath>
#include <new>

namespace reliefviewer
{

namespace
{

/// What the user can do about a failure, to go on with behind its message.
QString remedyFor(reliefshade::Remedy remedy)
{
  switch (remedy)
  {
    case reliefshade::Remedy::Band:
    case reliefshade::Remedy::Channel:
    case reliefshade::Remedy::Colors:
    case reliefshade::Remedy::Indices:
      return MainWindow::tr(". Choose a band in the File menu");
    case reliefshade::Remedy::Degrees:
      return MainWindow::tr(". Do not take its coordinates for degrees");
    case reliefshade::Remedy::NumberType:
      return MainWindow::tr(". Choose a file of another format");
    default:
      return QString();
  }
}

}

//------------------------------------------------------------------------------
MainWindow::MainWindow()
  : Shown(new Document(this))
  , Picture(new ReliefView(this->Shown, this))
  , Side(new Panel(this->Shown, this))
  , Dock(new QDockWidget(tr("Scene"), this))
  , Middle(new QStackedWidget(this))
  , FrameText(new QLabel(this))
  , SampleText(new QLabel(this))
{
  auto* hint = new QLabel(tr("<p style='font-size:16pt'>Drop a height field here</p>"
                             "<p>or open one with Ctrl+O: GeoTIFF, PNG, TIFF, OpenEXR \u2026</p>"),
    this);
  hint->setAlignment(Qt::AlignCenter);
  hint->setWordWrap(true);
  this->Middle->addWidget(hint);
  this->Middle->addWidget(this->Picture);
  this->setCentralWidget(this->Middle);
  this->Dock->setObjectName(QStringLiteral("panel"));
  this->Dock->setWidget(this->Side);
  this->Dock->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetClosable);
  this->addDockWidget(Qt::RightDockWidgetArea, this->Dock);
  this->setAcceptDrops(true);
  this->FrameText->setObjectName(QStringLiteral("frameText"));
  this->SampleText->setObjectName(QStringLiteral("sampleText"));
  // What they say must not make the window wider than the screen.
  this->SampleText->setMinimumWidth(1);
  this->FrameText->setMinimumWidth(1);
  this->statusBar()->addPermanentWidget(this->SampleText);
  this->statusBar()->addPermanentWidget(this->FrameText);

  this->AddFileMenu();
  this->AddEditMenu();
  this->AddViewMenu();
  this->AddLightMenu();
  this->AddHelpMenu();

  connect(this->Shown, &Document::changed, this, &MainWindow::ShowTitle);
  connect(this->Shown->Steps(), &QUndoStack::cleanChanged, this, &MainWindow::ShowTitle);
  connect(this->Shown, &Document::refused, this, &MainWindow::Report);
  connect(this->Shown, &Document::told, this, &MainWindow::Report);
  connect(this->Picture, &ReliefView::frameShown, this, &MainWindow::ShowFrame);
  connect(this->Picture, &ReliefView::hovered, this, &MainWindow::ShowSample);
  connect(this->Picture, &ReliefView::environmentTurned, this,
    [this](double angle) { this->Report(tr("The environment is turned to %1\u00b0").arg(angle)); });
  connect(
    this->Side->Lights(), &LightSection::switchWanted, this->Picture, &ReliefView::SwitchLightType);
  connect(this->Side->Environment(), &EnvironmentSection::pictureWanted, this,
    &MainWindow::ChooseEnvironment);
  for (QAction* action : this->NeedField)
  {
    action->setEnabled(false);
  }
  this->ReadSettings();
  this->ShowTitle();
}

//------------------------------------------------------------------------------
// What goes after this must not call what is gone already.
MainWindow::~MainWindow()
{
  this->Shown->disconnect(this);
  this->Shown->Steps()->disconnect(this);
  this->Picture->disconnect(this);
}

//------------------------------------------------------------------------------
/// Does what may fail; tells the user why it did.
bool MainWindow::Try(const std::function<bool()>& action)
{
  QString message;
  try
  {
    return action();
  }
  catch (const std::bad_alloc&)
  {
    message = tr("There is not enough memory for that.");
  }
  catch (const reliefshade::Failure& failure)
  {
    message = QString::fromLocal8Bit(failure.what()) + remedyFor(failure.Mends);
  }
  catch (const std::exception& error)
  {
    message = QString::fromLocal8Bit(error.what());
  }
  reliefshade::takeError(); // what followed from it
  QMessageBox::critical(this, tr("reliefviewer"), message);
  return false;
}

//------------------------------------------------------------------------------
void MainWindow::Report(const QString& message)
{
  this->statusBar()->showMessage(message, 10000);
}

//------------------------------------------------------------------------------
void MainWindow::ReportWarnings()
{
  for (const std::string& warning : reliefshade::takeWarnings())
  {
    this->Report(QString::fromStdString(warning));
  }
}

//------------------------------------------------------------------------------
bool MainWindow::SavePicture(const QString& file)
{
  return this->Save(file, &savePicture);
}

//------------------------------------------------------------------------------
bool MainWindow::SaveLayers(const QString& file)
{
  return this->Save(file, &saveLayers);
}

//------------------------------------------------------------------------------
bool MainWindow::Save(const QString& file, SaveField* save)
{
  return this->Try(
    [&]
    {
      this->Shown->CheckTarget(file, false);
      vtkNew<vtkReliefScene> scene; // as reliefshade gets it
      this->Shown->CopyTo(scene);
      return runLongTask(this, tr("Shading %1").arg(QFileInfo(file).fileName()),
        [&](const Progress& progress) {
          save(QFile::encodeName(file).toStdString(), this->Shown->OpenedField(), scene, progress);
        });
    });
}

//------------------------------------------------------------------------------
bool MainWindow::SaveScene(const QString& file)
{
  return this->Try(
    [&]
    {
      this->Shown->WriteScene(file);
      this->AddRecentFile(file);
      return true;
    });
}

//------------------------------------------------------------------------------
bool MainWindow::SaveSceneAgain()
{
  if (!this->Shown->SceneFile().isEmpty())
  {
    return this->SaveScene(this->Shown->SceneFile());
  }
  bool saved = false;
  this->ChooseAndSave(tr("Save scene"), tr("Scenes (*.json)"), QStringLiteral("-scene"), "json",
    [this, &saved](const QString& file) { return saved = this->SaveScene(file); });
  return saved;
}

//------------------------------------------------------------------------------
/// Before the scene is replaced. Returns whether to go on.
bool MainWindow::LeaveScene()
{
  if (this->Shown->Steps()->isClean())
  {
    return true;
  }
  const auto answer = QMessageBox::question(this, tr("reliefviewer"),
    tr("The scene has changes that are not saved. Save them?"),
    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  return answer == QMessageBox::Discard || (answer == QMessageBox::Save && this->SaveSceneAgain());
}

//------------------------------------------------------------------------------
void MainWindow::ChooseAndSave(const QString& what, const QString& filter, const QString& ending,
  const QString& suffix, const std::function<bool(const QString&)>& save)
{
  QFileDialog dialog(this, what, this->Folder, filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(suffix);
  // Never the name of the heights themselves: the suffix may become theirs.
  // A dot would be taken for the beginning of a suffix.
  dialog.selectFile(
    QFileInfo(this->Shown->FieldFile()).completeBaseName().replace('.', '_') + ending);
  // The suffix of the format that is chosen.
  connect(&dialog, &QFileDialog::filterSelected, &dialog,
    [&dialog, suffix](const QString& chosen)
    {
      const QString first = chosen.section(QStringLiteral("*."), 1, 1)
                              .section(QRegularExpression(QStringLiteral("[ )]")), 0, 0);
      dialog.setDefaultSuffix(first.isEmpty() ? suffix : first);
    });
  if (dialog.exec() == QDialog::Accepted && !dialog.selectedFiles().isEmpty())
  {
    QString file = dialog.selectedFiles().first();
    if (suffix == QStringLiteral("json") &&
      !file.endsWith(QStringLiteral(".json"), Qt::CaseInsensitive))
    {
      // Under another name it would be opened as a height field.
      file += QStringLiteral(".json");
      if (QFileInfo::exists(file) &&
        QMessageBox::question(this, what, tr("%1 exists. Replace it?").arg(file)) !=
          QMessageBox::Yes)
      {
        return;
      }
    }
    this->Folder = QFileInfo(file).absolutePath();
    if (save(file))
    {
      this->Report(tr("%1 is saved").arg(QFileInfo(file).fileName()));
    }
  }
}

//------------------------------------------------------------------------------
void MainWindow::ShowTitle()
{
  const Field& field = this->Shown->OpenedField();
  QString heights = QFileInfo(this->Shown->FieldFile()).fileName();
  if (field.Heights.Bands.size() > 1)
  {
    heights += tr(", band %1").arg(std::max(field.Reading.Band, 1));
  }
  if (!field.MaskFile.empty())
  {
    heights += tr(", masked");
  }
  this->NeedBands->setEnabled(field.Heights.Bands.size() > 1);
  this->NeedMask->setEnabled(!field.MaskFile.empty());
  const QString scene = QFileInfo(this->Shown->SceneFile()).fileName();
  QStringList parts;
  for (const QString& part : { heights, scene })
  {
    if (!part.isEmpty())
    {
      parts += part;
    }
  }
  this->setWindowTitle(
    (parts.isEmpty() ? QString()
                     : parts.join(QStringLiteral(" \u00b7 ")) + QStringLiteral("[*] \u2013 ")) +
    (parts.isEmpty() ? tr("reliefviewer[*]") : tr("reliefviewer")));
  this->setWindowModified(!this->Shown->Steps()->isClean());
}

//------------------------------------------------------------------------------
void MainWindow::ShowFrame()
{
  const FrameReport& frame = this->Picture->LastFrame();
  const QString state =
    frame.Converged ? tr("complete") : tr("%1 %").arg(static_cast<int>(100.0 * frame.Refinement));
  this->FrameText->setText(tr("%1 ms \u00b7 lights traced: %2 \u00b7 %3")
                             .arg(1000.0 * frame.Seconds, 0, 'f', frame.Seconds < 0.01 ? 1 : 0)
                             .arg(frame.LightsTraced)
                             .arg(state));
  if (reliefshade::hasError())
  {
    this->Report(QString::fromStdString(reliefshade::takeError()));
  }
  this->ReportWarnings();
}

//------------------------------------------------------------------------------
void MainWindow::ShowSample(bool inside, double x, double y)
{
  const Field& field = this->Shown->OpenedField();
  const vtkIdType at = inside && this->Shown->HasField() ? field.SampleAt(x, y) : -1;
  if (at < 0)
  {
    this->SampleText->clear();
    return;
  }
  const double height = field.Heights.Heights->GetPointData()->GetScalars()->GetComponent(at, 0);
  const bool none = !field.HasData(at);
  this->SampleText->setText(tr("x %1   y %2   height %3   ")
                              .arg(field.Frame.CoordinateToMap(0, x), 0, 'g', 9)
                              .arg(field.Frame.CoordinateToMap(1, y), 0, 'g', 9)
                              .arg(none ? tr("none") : QString::number(height, 'g', 7)));
}

//------------------------------------------------------------------------------
QSize MainWindow::Room() const
{
  // Before it is shown nobody knows its frame; most have a title.
  const QSize frame = this->frameGeometry().size() - this->size();
  const int title = frame.height() > 0 ? 0 : this->style()->pixelMetric(QStyle::PM_TitleBarHeight);
  return this->screen()->availableGeometry().size() - frame - QSize(0, title);
}

//------------------------------------------------------------------------------
/// A place that was remembered may be that of a larger screen.
void MainWindow::KeepOnScreen()
{
  if (this->isMaximized() || this->isFullScreen())
  {
    return;
  }
  const QRect room = this->screen()->availableGeometry();
  const QSize size = this->size().boundedTo(this->Room());
  QRect whole(this->frameGeometry().topLeft(), size + this->frameGeometry().size() - this->size());
  whole.moveRight(std::min(whole.right(), room.right()));
  whole.moveBottom(std::min(whole.bottom(), room.bottom()));
  whole.moveLeft(std::max(whole.left(), room.left()));
  whole.moveTop(std::max(whole.top(), room.top()));
  // Where it is there already, the window manager has the choice.
  if (size != this->size())
  {
    this->resize(size);
  }
  if (whole.topLeft() != this->pos())
  {
    this->move(whole.topLeft());
  }
}

//------------------------------------------------------------------------------
// Now its frame is known.
void MainWindow::showEvent(QShowEvent* event)
{
  QMainWindow::showEvent(event);
  QTimer::singleShot(0, this, &MainWindow::KeepOnScreen);
}

//------------------------------------------------------------------------------
void MainWindow::ReadSettings()
{
  const QSettings settings;
  this->resize(QSize(1240, 820).boundedTo(this->Room()));
  this->resizeDocks({ this->Dock }, { std::min(370, this->width() / 2) }, Qt::Horizontal);
  this->restoreGeometry(settings.value("geometry").toByteArray());
  this->restoreState(settings.value("windowState").toByteArray());
  if (settings.contains("geometry"))
  {
    this->KeepOnScreen();
  }
  this->findChild<QAction*>("fullScreen")->setChecked(this->isFullScreen());
  this->Folder = settings.value("folder").toString();
  if (settings.contains("openSections"))
  {
    this->Side->SetOpenSections(settings.value("openSections").toStringList());
  }
}

//------------------------------------------------------------------------------
void MainWindow::WriteSettings()
{
  QSettings settings;
  settings.setValue("geometry", this->saveGeometry());
  settings.setValue("windowState", this->saveState());
  settings.setValue("folder", this->Folder);
  settings.setValue("openSections", this->Side->OpenSections());
}

//------------------------------------------------------------------------------
void MainWindow::closeEvent(QCloseEvent* event)
{
  if (longTaskRuns() || !this->LeaveScene())
  {
    event->ignore();
    return;
  }
  this->WriteSettings();
  event->accept();
}

}
