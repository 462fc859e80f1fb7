// SPDX-License-Identifier: BSD-3-Clause

// What comes into the window: height fields, their masks, scenes, pictures of environments.

#include "Document.h"
#include "Failure.h"
#include "MainWindow.h"
#include "ReliefView.h"

#include "vtkReliefEnvironment.h"
#include "vtkReliefEnvironmentImage.h"

#include <QAction>
#include <QApplication>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QMessageBox>
#include <QMimeData>
#include <QStackedWidget>
#include <QStatusBar>

#include <algorithm>

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
bool MainWindow::Open(const QString& file)
{
  return isScene(file) ? this->OpenScene(file) : this->OpenHeights(file);
}

//------------------------------------------------------------------------------
/// Asks for one of a file's bands; the one there is is offered first. Returns false if the user
/// cancels.
bool MainWindow::AskForBand(
  const QString& file, const std::vector<std::string>& bands, const QString& what, int& band)
{
  QStringList choices;
  for (std::size_t i = 0; i < bands.size(); ++i)
  {
    const QString name = QString::fromStdString(bands[i]);
    choices += name.isEmpty() ? tr("Band %1").arg(i + 1) : tr("Band %1: %2").arg(i + 1).arg(name);
  }
  bool chosen = false;
  const QString choice = QInputDialog::getItem(this, tr("Choose band"),
    tr("Which band of %1 is %2?").arg(QFileInfo(file).fileName(), what), choices,
    std::max(band, 1) - 1, false, &chosen);
  band = chosen ? static_cast<int>(choices.indexOf(choice)) + 1 : band;
  return chosen;
}

//------------------------------------------------------------------------------
/// Reads a file in the background. Where that has several bands and nobody has said which, the user
/// is asked. Returns false if the user cancels.
bool MainWindow::ReadBand(const QString& file, const QString& what,
  reliefshade::ReadOptions& options, const std::function<void()>& read)
{
  const auto run = [&]
  {
    return runLongTask(
      this, tr("Reading %1").arg(QFileInfo(file).fileName()), [&read](const Progress&) { read(); });
  };
  try
  {
    return run();
  }
  catch (const reliefshade::Failure& failure)
  {
    if (failure.Bands.empty())
    {
      throw;
    }
    return this->AskForBand(file, failure.Bands, what, options.Band) && run();
  }
}

//------------------------------------------------------------------------------
bool MainWindow::OpenHeights(const QString& file)
{
  return this->Try([&] { return this->ReadHeights(file, Field()); });
}

//------------------------------------------------------------------------------
/// Reads heights as those of a field were read, with its mask; an empty one leaves it to the file.
bool MainWindow::ReadHeights(const QString& file, const Field& like)
{
  Field field;
  reliefshade::ReadOptions options = like.Reading;
  const auto read = [&]
  {
    return this->ReadBand(file, tr("the height"), options,
      [&]
      {
        field = readField(encoded(file), options);
        if (!like.MaskFile.empty())
        {
          field = withMask(field, encoded(file), like.MaskFile, like.MaskReading);
        }
      });
  };
  if (!read())
  {
    return false;
  }
  if (!like.Heights.Heights && relief::raster::LooksLikeDegrees(field.Heights))
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
  QStringList warnings;
  for (const relief::raster::Warning& warning : field.Heights.Warnings)
  {
    warnings += QString::fromStdString(warning.Text);
  }
  this->statusBar()->clearMessage(); // it was of another field
  this->Shown->SetField(file, std::move(field));
  this->Middle->setCurrentWidget(this->Picture);
  for (QAction* action : this->NeedField)
  {
    action->setEnabled(true);
  }
  this->Folder = QFileInfo(file).absolutePath();
  this->AddRecentFile(file);
  this->ReportWarnings();
  if (!warnings.isEmpty())
  {
    this->Report(tr("Warning: %1").arg(warnings.join("; ")));
  }
  return true;
}

//------------------------------------------------------------------------------
/// Another band of the file that is open.
void MainWindow::ChooseBand()
{
  const QString file = this->Shown->FieldFile();
  Field like = this->Shown->OpenedField();
  if (this->AskForBand(file, like.Heights.Bands, tr("the height"), like.Reading.Band))
  {
    this->Try([&] { return this->ReadHeights(file, like); });
  }
}

//------------------------------------------------------------------------------
bool MainWindow::OpenMask(const QString& file)
{
  return this->Try(
    [&]
    {
      Field masked;
      reliefshade::ReadOptions options;
      const bool read = this->ReadBand(file, tr("the mask"), options,
        [&]
        {
          masked = withMask(
            this->Shown->OpenedField(), encoded(this->Shown->FieldFile()), encoded(file), options);
        });
      if (read)
      {
        this->Shown->SetMasked(std::move(masked));
        this->Folder = QFileInfo(file).absolutePath();
        this->ReportWarnings();
      }
      return read;
    });
}

//------------------------------------------------------------------------------
void MainWindow::ChooseMask()
{
  const QString file =
    QFileDialog::getOpenFileName(this, tr("Open a mask: no data where it is black or transparent"),
      this->Folder, tr("Masks (*.png *.tif *.tiff *.exr *.asc *.vrt);;All files (*)"));
  if (!file.isEmpty())
  {
    this->OpenMask(file);
  }
}

//------------------------------------------------------------------------------
void MainWindow::RemoveMask()
{
  this->Shown->SetMasked(withoutMask(this->Shown->OpenedField()));
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
void MainWindow::ChooseAndOpen()
{
  const QString file = QFileDialog::getOpenFileName(this, tr("Open a height field or a scene"),
    this->Folder,
    tr("Height fields and scenes (*.tif *.tiff *.asc *.png *.exr *.hdr *.pfm *.img *.dem *.hgt "
       "*.bil "
       "*.vrt *.nc *.jp2 *.obj *.vtk *.ply *.stl *.vtp *.gltf *.glb *.json);;Scenes (*.json);;All "
       "files (*)"));
  if (!file.isEmpty())
  {
    this->Open(file);
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
          const std::string reason =
            vtkReliefEnvironmentImage::TryToRead(environment, name.c_str());
          read = reason.empty();
          if (!read)
          {
            throw reliefshade::Failure(name, reason);
          }
        });
      return read;
    });
}

//------------------------------------------------------------------------------
void MainWindow::dragEnterEvent(QDragEnterEvent* event)
{
  if (event->mimeData()->hasUrls() && !QApplication::activeModalWidget() && !longTaskRuns())
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
