// SPDX-License-Identifier: BSD-3-Clause
#ifndef MainWindow_h
#define MainWindow_h

#include "Field.h"
#include "Saving.h"

#include <QMainWindow>

#include <functional>
#include <string>
#include <vector>

class QDockWidget;
class QLabel;
class QMenu;
class QStackedWidget;

namespace reliefviewer
{

class Document;
class Panel;
class ReliefView;

/// The viewer's window: picture, panel, menus, status.
class MainWindow : public QMainWindow
{
  Q_OBJECT

public:
  MainWindow();
  ~MainWindow() override;

  /// Opens height fields and scenes alike. Returns false, and keeps what was there, after a message
  /// to the user.
  bool Open(const QString& file);
  /// Hides samples of the field that is open. Returns false, and keeps what was there, after a
  /// message, or if the user cancels.
  bool OpenMask(const QString& file);
  void RemoveMask();
  /// These return false after a message, or if the user cancels.
  bool SavePicture(const QString& file);
  bool SaveLayers(const QString& file);
  bool SaveScene(const QString& file);

  Document* Opened() const { return this->Shown; }
  ReliefView* View() const { return this->Picture; }
  Panel* SidePanel() const { return this->Side; }

protected:
  void closeEvent(QCloseEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  QAction* AddAction(QMenu* menu, const QString& name, const QString& text,
    const QKeySequence& shortcut, const std::function<void()>& action);
  void AddFileMenu();
  void AddEditMenu();
  void AddViewMenu();
  void AddLightMenu();
  void AddHelpMenu();
  void FillRecentFiles();
  void AddRecentFile(const QString& file);

  bool OpenHeights(const QString& file);
  bool ReadHeights(const QString& file, const Field& like);
  bool AskForBand(
    const QString& file, const std::vector<std::string>& bands, const QString& what, int& band);
  bool ReadBand(const QString& file, const QString& what, reliefshade::ReadOptions& options,
    const std::function<void()>& read);
  void ChooseBand();
  void ChooseMask();
  bool OpenScene(const QString& file);
  bool LeaveScene();
  bool Save(const QString& file, SaveField* save);
  bool Try(const std::function<bool()>& action);
  void ChooseAndOpen();
  /// Suggests the field's name with an ending and a suffix.
  void ChooseAndSave(const QString& what, const QString& filter, const QString& ending,
    const QString& suffix, const std::function<bool(const QString&)>& save);
  bool SaveSceneAgain();
  void ChooseEnvironment();
  void Report(const QString& message);
  void ReportWarnings();

  void ShowTitle();
  void ShowFrame();
  void ShowSample(bool inside, double x, double y);
  void ShowShortcuts();
  /// How large a window may be on the screen, without its frame.
  QSize Room() const;
  void KeepOnScreen();
  void ReadSettings();
  void WriteSettings();

  Document* Shown;
  ReliefView* Picture;
  Panel* Side;
  QDockWidget* Dock;
  QStackedWidget* Middle;
  QLabel* FrameText;
  QLabel* SampleText;
  QMenu* Recent = nullptr;
  QList<QAction*> NeedField;
  QAction* NeedBands = nullptr;
  QAction* NeedMask = nullptr;
  QString Folder;
};

}

#endif
