// SPDX-License-Identifier: BSD-3-Clause
#include "MainWindow.h"

#include "Document.h"
#include "EnvironmentSection.h"
#include "Failure.h"
#include "LightSection.h"
#include "MessageLog.h"
#include "Panel.h"
#include "RasterReader.h"
#include "ReliefView.h"
#include "Saving.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkReliefEnvironment.h"
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
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>

#include <cmath>
#include <new>

namespace reliefviewer
{

namespace
{

std::string encoded(const QString& file)
{
  return QFile::encodeName(file).toStdString();
}

bool isScene(const QString& file)
{
  return file.endsWith(QStringLiteral(".json"), Qt::CaseInsensitive);
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
  connect(this->Picture, &ReliefView::frameShown, this, &MainWindow::ShowFrame);
  connect(this->Picture, &ReliefView::hovered, this, &MainWindow::ShowSample);
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
bool MainWindow::Open(const QString& file)
{
  return isScene(file) ? this->OpenScene(file) : this->OpenHeights(file);
}

//------------------------------------------------------------------------------
bool MainWindow::OpenHeights(const QString& file)
{
  return this->Try(
    [&]
    {
      Field field;
      reliefshade::ReadOptions options;
      const auto read = [&]
      {
        return runLongTask(this, tr("Reading %1").arg(QFileInfo(file).fileName()),
          [&](const Progress&) { field = readField(encoded(file), options); });
      };
      if (!read())
      {
        return false;
      }
      if (reliefshade::looksLikeDegrees(field.Heights))
      {
        options.Degrees = QMessageBox::question(this, tr("reliefviewer"),
                            tr("%1 names no coordinate reference system, but its coordinates look "
                               "like degrees. Are they longitude and latitude?")
                              .arg(QFileInfo(file).fileName())) == QMessageBox::Yes;
        if (options.Degrees && !read())
        {
          return false;
        }
      }
      this->Shown->SetField(file, std::move(field));
      this->Middle->setCurrentWidget(this->Picture);
      for (QAction* action : this->NeedField)
      {
        action->setEnabled(true);
      }
      this->Folder = QFileInfo(file).absolutePath();
      this->AddRecentFile(file);
      return true;
    });
}

//------------------------------------------------------------------------------
bool MainWindow::OpenScene(const QString& file)
{
  if (!this->LeaveScene())
  {
    return false;
  }
  return this->Try(
    [&]
    {
      this->Shown->ReadScene(file);
      this->ReportWarnings();
      this->Folder = QFileInfo(file).absolutePath();
      this->AddRecentFile(file);
      return true;
    });
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
      vtkNew<vtkReliefScene> scene; // as reliefshade gets it
      this->Shown->FromText(this->Shown->Text(), scene);
      return runLongTask(this, tr("Shading %1").arg(QFileInfo(file).fileName()),
        [&](const Progress& progress)
        { save(encoded(file), this->Shown->OpenedField(), scene, progress); });
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
void MainWindow::ChooseAndOpen()
{
  const QString file =
    QFileDialog::getOpenFileName(this, tr("Open a height field or a scene"), this->Folder,
      tr("Height fields and scenes (*.tif *.tiff *.asc *.png *.exr *.hdr *.pfm *.img *.dem *.hgt "
         "*.bil "
         "*.vrt *.nc *.jp2 *.json);;Scenes (*.json);;All files (*)"));
  if (!file.isEmpty())
  {
    this->Open(file);
  }
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
      const QString first =
        chosen.section(QStringLiteral("*."), 1, 1).section(QRegExp("[ )]"), 0, 0);
      dialog.setDefaultSuffix(first.isEmpty() ? suffix : first);
    });
  if (dialog.exec() == QDialog::Accepted && !dialog.selectedFiles().isEmpty())
  {
    QString file = dialog.selectedFiles().first();
    if (suffix == QStringLiteral("json") && !isScene(file))
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
void MainWindow::ChooseEnvironment()
{
  vtkReliefEnvironment* environment = this->Shown->Scene()->GetEnvironment();
  const QString file = QFileDialog::getOpenFileName(this,
    tr("Open a picture of the environment (latitude and longitude)"), this->Folder,
    tr("Pictures (*.hdr *.exr *.pfm *.png *.jpg *.jpeg *.tif *.tiff);;All files (*)"));
  if (file.isEmpty() || !environment)
  {
    return;
  }
  this->Try(
    [&]
    {
      const std::string name = encoded(file);
      bool read = false;
      this->Shown->Edit(tr("Change environment"),
        [&]
        {
          read = environment->SetImageToFile(name.c_str());
          if (!read)
          {
            throw reliefshade::Failure(
              name, reliefshade::withoutName(reliefshade::takeError(), name));
          }
        });
      return read;
    });
}

//------------------------------------------------------------------------------
void MainWindow::ShowTitle()
{
  const QString heights = QFileInfo(this->Shown->FieldFile()).fileName();
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
  const int i = static_cast<int>(std::lround(x / field.Heights.Spacing[0]));
  const int j = static_cast<int>(std::lround(y / field.Heights.Spacing[1]));
  if (!inside || !this->Shown->HasField() || i < 0 || j < 0 || i >= field.Samples[0] ||
    j >= field.Samples[1])
  {
    this->SampleText->clear();
    return;
  }
  const vtkIdType at = static_cast<vtkIdType>(j) * field.Samples[0] + i;
  const double height = field.Heights.Heights->GetPointData()->GetScalars()->GetComponent(at, 0);
  const bool none = !field.HasData(at);
  this->SampleText->setText(tr("x %1   y %2   height %3   ")
                              .arg(field.Frame.CoordinateToMap(0, x), 0, 'g', 9)
                              .arg(field.Frame.CoordinateToMap(1, y), 0, 'g', 9)
                              .arg(none ? tr("none") : QString::number(height, 'g', 7)));
}

//------------------------------------------------------------------------------
void MainWindow::ReadSettings()
{
  const QSettings settings;
  this->resize(1240, 820);
  this->resizeDocks({ this->Dock }, { 370 }, Qt::Horizontal);
  this->restoreGeometry(settings.value("geometry").toByteArray());
  this->restoreState(settings.value("windowState").toByteArray());
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
  if (!this->LeaveScene())
  {
    event->ignore();
    return;
  }
  this->WriteSettings();
  event->accept();
}

//------------------------------------------------------------------------------
void MainWindow::dragEnterEvent(QDragEnterEvent* event)
{
  if (event->mimeData()->hasUrls() && !QApplication::activeModalWidget())
  {
    event->acceptProposedAction();
  }
}

//------------------------------------------------------------------------------
void MainWindow::dropEvent(QDropEvent* event)
{
  event->acceptProposedAction();
  for (const QUrl& url : event->mimeData()->urls())
  {
    this->Open(url.isLocalFile() ? url.toLocalFile() : url.toString());
  }
}

}
