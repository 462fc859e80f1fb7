// SPDX-License-Identifier: BSD-3-Clause

// The menus of the window, and the list of their keys.

#include "Document.h"
#include "LightSection.h"
#include "MainWindow.h"
#include "Panel.h"
#include "ReliefView.h"
#include "SceneParameters.h"

#include "vtkLightCollection.h"
#include "vtkReliefScene.h"

#include <QApplication>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QSettings>
#include <QTextBrowser>
#include <QVBoxLayout>

namespace reliefviewer
{

namespace
{
constexpr int MostRecent = 8;
const char* const RecentKey = "recentFiles";
}

//------------------------------------------------------------------------------
QAction* MainWindow::AddAction(QMenu* menu, const QString& name, const QString& text,
  const QKeySequence& shortcut, const std::function<void()>& action)
{
  QAction* entry = menu->addAction(text);
  entry->setObjectName(name);
  entry->setShortcut(shortcut);
  if (action)
  {
    connect(entry, &QAction::triggered, this, action);
  }
  return entry;
}

//------------------------------------------------------------------------------
void MainWindow::AddFileMenu()
{
  QMenu* menu = this->menuBar()->addMenu(tr("&File"));
  this->AddAction(
    menu, "open", tr("&Open \u2026"), QKeySequence::Open, [this] { this->ChooseAndOpen(); });
  this->Recent = menu->addMenu(tr("Open &recent"));
  connect(this->Recent, &QMenu::aboutToShow, this, &MainWindow::FillRecentFiles);
  this->NeedBands = this->AddAction(
    menu, "chooseBand", tr("Choose &band \u2026"), QKeySequence(), [this] { this->ChooseBand(); });
  this->NeedField += this->AddAction(
    menu, "openMask", tr("Open &mask \u2026"), QKeySequence(), [this] { this->ChooseMask(); });
  this->NeedMask = this->AddAction(
    menu, "removeMask", tr("Remo&ve mask"), QKeySequence(), [this] { this->RemoveMask(); });
  menu->addSeparator();
  this->AddAction(menu, "newScene", tr("&New scene"), QKeySequence::New,
    [this]
    {
      if (this->LeaveScene())
      {
        this->Shown->NewScene();
      }
    });
  this->AddAction(
    menu, "saveScene", tr("&Save scene"), QKeySequence::Save, [this] { this->SaveSceneAgain(); });
  this->AddAction(menu, "saveSceneAs", tr("Save scene &as \u2026"),
    QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S),
    [this]
    {
      this->ChooseAndSave(tr("Save scene"), tr("Scenes (*.json)"), "-scene", "json",
        [this](const QString& file) { return this->SaveScene(file); });
    });
  menu->addSeparator();
  this->NeedField += this->AddAction(menu, "savePicture", tr("Save &picture \u2026"),
    QKeySequence(Qt::CTRL | Qt::Key_E),
    [this]
    {
      this->ChooseAndSave(tr("Save picture"),
        tr(
          "PNG (*.png);;TIFF (*.tif *.tiff);;OpenEXR, linear (*.exr);;JPEG (*.jpg);;All files (*)"),
        "-shaded", "png", [this](const QString& file) { return this->SavePicture(file); });
    });
  this->NeedField += this->AddAction(menu, "saveLayers", tr("Save &layers \u2026"),
    QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_E),
    [this]
    {
      this->ChooseAndSave(tr("Save layers"), tr("OpenEXR (*.exr)"), "-layers", "exr",
        [this](const QString& file) { return this->SaveLayers(file); });
    });
  menu->addSeparator();
  this->AddAction(
    menu, "quit", tr("&Quit"), QKeySequence(Qt::CTRL | Qt::Key_Q), [this] { this->close(); });
}

//------------------------------------------------------------------------------
void MainWindow::FillRecentFiles()
{
  this->Recent->clear();
  for (const QString& file : QSettings().value(RecentKey).toStringList())
  {
    QAction* entry = this->Recent->addAction(QFileInfo(file).fileName());
    entry->setToolTip(file);
    connect(entry, &QAction::triggered, this, [this, file] { this->Open(file); });
  }
  if (this->Recent->isEmpty())
  {
    this->Recent->addAction(tr("None yet"))->setEnabled(false);
  }
}

//------------------------------------------------------------------------------
void MainWindow::AddRecentFile(const QString& file)
{
  QSettings settings;
  QStringList files = settings.value(RecentKey).toStringList();
  const QString path = QFileInfo(file).absoluteFilePath();
  files.removeAll(path);
  files.prepend(path);
  settings.setValue(RecentKey, QStringList(files.mid(0, MostRecent)));
}

//------------------------------------------------------------------------------
void MainWindow::AddEditMenu()
{
  QMenu* menu = this->menuBar()->addMenu(tr("&Edit"));
  QAction* undo = this->Shown->Steps()->createUndoAction(this, tr("&Undo"));
  undo->setShortcut(QKeySequence::Undo);
  undo->setObjectName(QStringLiteral("undo"));
  menu->addAction(undo);
  QAction* redo = this->Shown->Steps()->createRedoAction(this, tr("&Redo"));
  redo->setShortcuts(
    { QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Z), QKeySequence(Qt::CTRL | Qt::Key_Y) });
  redo->setObjectName(QStringLiteral("redo"));
  menu->addAction(redo);
  menu->addSeparator();
  this->NeedField += this->AddAction(menu, "fitHeights", tr("&Fit heights"),
    QKeySequence(Qt::Key_H), [this] { this->Shown->FitHeights(); });
}

//------------------------------------------------------------------------------
void MainWindow::AddViewMenu()
{
  QMenu* menu = this->menuBar()->addMenu(tr("&View"));
  this->NeedField += this->AddAction(
    menu, "fit", tr("&Whole relief"), QKeySequence(Qt::Key_F), [this] { this->Picture->Fit(); });
  this->NeedField += this->AddAction(menu, "samples", tr("One sample per &pixel"),
    QKeySequence(Qt::Key_1), [this] { this->Picture->ShowSamples(); });
  this->NeedField += this->AddAction(menu, "zoomIn", tr("Zoom &in"), QKeySequence(Qt::Key_Plus),
    [this] { this->Picture->Zoom(1.25); });
  this->NeedField += this->AddAction(menu, "zoomOut", tr("Zoom &out"), QKeySequence(Qt::Key_Minus),
    [this] { this->Picture->Zoom(0.8); });
  menu->addSeparator();
  QAction* dots =
    this->AddAction(menu, "showLights", tr("&Lights as dots"), QKeySequence(Qt::Key_D), {});
  dots->setCheckable(true);
  dots->setChecked(true);
  connect(dots, &QAction::toggled, this->Picture, &ReliefView::ShowDots);
  QAction* panel = this->Dock->toggleViewAction();
  panel->setText(tr("&Panel"));
  panel->setShortcut(Qt::Key_P);
  panel->setObjectName(QStringLiteral("showPanel"));
  menu->addAction(panel);
  QAction* full =
    this->AddAction(menu, "fullScreen", tr("&Full screen"), QKeySequence(Qt::Key_F11), {});
  full->setCheckable(true);
  connect(full, &QAction::toggled, this,
    [this](bool on)
    { this->setWindowState(this->windowState().setFlag(Qt::WindowFullScreen, on)); });
}

//------------------------------------------------------------------------------
void MainWindow::AddLightMenu()
{
  QMenu* menu = this->menuBar()->addMenu(tr("&Light"));
  vtkReliefScene* scene = this->Shown->Scene();
  const auto preset = [this, menu, scene](const QString& name, const QString& text,
                        const std::function<void()>& change)
  {
    this->AddAction(menu, name, text, QKeySequence(),
      [this, scene, change]
      {
        this->Shown->Edit(tr("Preset of lights"),
          [&]
          {
            scene->SetResponseToIllumination();
            change();
          });
      });
  };
  this->AddAction(menu, "addSunAction", tr("Add &sun"), QKeySequence(Qt::Key_S),
    [this] { this->Side->Lights()->AddSun(); });
  this->AddAction(menu, "addLampAction", tr("Add &lamp"), QKeySequence(Qt::Key_L),
    [this] { this->Side->Lights()->AddLamp(); });
  this->AddAction(menu, "switchLight", tr("Sun or lamp, the other &way"), QKeySequence(Qt::Key_W),
    [this] { this->Picture->SwitchLightType(); });
  const auto select = [this, scene](int step)
  {
    const int count = scene->GetLights()->GetNumberOfItems();
    if (count > 0)
    {
      this->Shown->SelectLight((this->Shown->SelectedLightIndex() + step + count) % count);
      this->Picture->TakeKeys();
    }
  };
  this->AddAction(
    menu, "nextLight", tr("Select &next"), QKeySequence(Qt::Key_N), [select] { select(1); });
  this->AddAction(menu, "previousLight", tr("Select &previous"),
    QKeySequence(Qt::SHIFT | Qt::Key_N), [select] { select(-1); });
  this->AddAction(menu, "removeLightAction", tr("&Remove"), QKeySequence(Qt::Key_Delete),
    [this] { this->Side->Lights()->Remove(); });
  menu->addSeparator();
  preset("presetSun", tr("&One sun"), [scene] { scene->SetLightsToDefault(); });
  preset(
    "presetSunAndSky", tr("Sun &and sky"), [scene] { scene->SetLightsToSunAndSky(315.0, 30.0); });
  preset("presetSkyDome", tr("Sky &dome"), [scene] { scene->SetLightsToSkyDome(); });
  preset("presetMultidirectional", tr("&Four suns (multidirectional)"),
    [scene] { scene->SetLightsToMultidirectional(); });
  preset("presetCombined", tr("&Combined with slope"),
    [scene] { scene->SetLightsToCombined(315.0, 45.0); });
  preset("presetIgor", tr("S&lope and aspect (Igor)"), [scene] { scene->SetLightsToIgor(315.0); });
}

//------------------------------------------------------------------------------
void MainWindow::AddHelpMenu()
{
  QMenu* menu = this->menuBar()->addMenu(tr("&Help"));
  this->AddAction(menu, "shortcuts", tr("&Keys and mouse"), QKeySequence::HelpContents,
    [this] { this->ShowShortcuts(); });
  this->AddAction(menu, "about", tr("&About"), QKeySequence(),
    [this]
    {
      QMessageBox::about(this, tr("About reliefviewer"),
        tr("<b>reliefviewer %1</b><p>Light for height fields: soft shadows, translucency and "
           "highlights, while you move the light.</p>")
          .arg(QApplication::applicationVersion()));
    });
}

//------------------------------------------------------------------------------
void MainWindow::ShowShortcuts()
{
  QString rows;
  const auto row = [&rows](const QString& keys, const QString& what)
  {
    rows += QStringLiteral("<tr><td style='padding-right:18px'><b>%1</b></td><td>%2</td></tr>")
              .arg(keys.toHtmlEscaped(), what.toHtmlEscaped());
  };
  for (const QAction* action : this->findChildren<QAction*>())
  {
    if (!action->shortcut().isEmpty() && !action->objectName().isEmpty())
    {
      // A name without the mnemonic's sign, and without what stands behind for a dialog.
      const QString name = action->text().remove('&').remove(QStringLiteral(" \u2026"));
      row(action->shortcut().toString(QKeySequence::NativeText), name);
    }
  }
  const QString keys = rows;
  rows.clear();
  row(tr("Drag a dot"), tr("Moves the light"));
  row(tr("Shift-drag or wheel on a dot"), tr("Raises and lowers it"));
  row(tr("Double-click a dot"), tr("Makes a lamp of a sun, or a sun of a lamp"));
  row(tr("Escape while dragging"), tr("Puts it back"));
  row(tr("Tab in the picture"), tr("Goes to the next light, with shift to the one before"));
  row(tr("Arrows"), tr("Move the light by a pixel, with shift by ten"));
  row(tr("Page up and page down"), tr("Raise and lower it by a step, with shift by ten"));
  row(tr("Drag beside the dots"), tr("Moves the picture"));
  row(tr("Right-drag or Ctrl-drag"), tr("Turns the environment about the middle"));
  row(tr("Wheel beside the dots"), tr("Zooms"));
  // All of it is longer than a small screen.
  QDialog box(this);
  box.setWindowTitle(tr("Keys and mouse"));
  auto* text = new QTextBrowser(&box);
  text->setObjectName(QStringLiteral("shortcutsText"));
  text->setHtml(QStringLiteral("<table>%1</table><hr><table>%2</table>").arg(rows, keys));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok, &box);
  connect(buttons, &QDialogButtonBox::accepted, &box, &QDialog::accept);
  auto* layout = new QVBoxLayout(&box);
  layout->addWidget(text);
  layout->addWidget(buttons);
  box.resize(QSize(560, 620).boundedTo(this->Room()));
  box.exec();
}

}
