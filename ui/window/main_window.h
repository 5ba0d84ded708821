// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>

#include <QMainWindow>

#include "core/task/reason.h"
#include "ui/settings/preferences.h"
#include "ui/theme/theme.h"
#include "ui/window/workbench.h"

class QLabel;
class QStackedWidget;

namespace pellucid::ui {

class FileMenu;
class LookDocks;
class MeasurementsPanel;
class MprView;
class PaneArea;
class PreferencesDialog;
class ProjectionView;
class Reopening;
class StartPage;
class StudyPair;
class StudyPanel;
class ToolsMenu;
class ViewMenu;

/// The workstation's window: creates the panes and docks, names the menus, connects intents. It
/// shows what is on the bench, also what was open before it was made.
class MainWindow : public QMainWindow {
    Q_OBJECT
public:
    MainWindow(Workbench &bench, const Theme &theme, const Preferences &preferences = {},
               QWidget *parent = nullptr);
    ~MainWindow() override;

    void openPaths(const QStringList &paths);
    void openPhantom(const QString &kind);
    /// Those that need no new window.
    void setPreferences(const Preferences &preferences);
    PreferencesDialog &openPreferences();
    /// Sizes and places of window and docks.
    void keepLayout();

    Document &document() { return m_bench.document; }
    JobRunner &jobs() { return m_bench.jobs; }
    StudyLibrary &library() { return m_bench.library; }
    GraphicsCard &graphicsCard() { return m_bench.card; }
    FileMenu &fileMenu() { return *m_file; }
    Reopening &reopening() { return *m_reopening; }

signals:
    void preferencesChanged(const pellucid::ui::Preferences &preferences);

protected:
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dropEvent(QDropEvent *event) override;
    void closeEvent(QCloseEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    void createPanes();
    void createStudyDock();
    void createMeasurementsDock();
    void createHistoryDock();
    void createSpectrumDock();
    void createFileMenu();
    void createEditMenu();
    void createViewMenu();
    void createHelpMenu();
    void createToolBar();
    void createStatusBar();
    void showVolumeState();
    void compareLooks(bool isComparing);
    void showTitle();
    void report(const task::Reason &what, const QString &path);
    /// Of what should have been shown.
    void reportLoad(const task::Reason &what, const QString &path);
    QAction *command(QMenu &menu, const QString &text, const char *name, const QKeySequence &key,
                     const std::function<void()> &run);

    Workbench &m_bench;
    Theme m_theme;
    Preferences m_preferences;
    FileMenu *m_file = nullptr;
    std::array<MprView *, 3> m_mpr{};
    ProjectionView *m_projection = nullptr;
    LookDocks *m_look = nullptr;
    PaneArea *m_panes = nullptr;
    StudyPair *m_pair = nullptr;
    StartPage *m_start = nullptr;
    Reopening *m_reopening = nullptr;
    QStackedWidget *m_stack = nullptr;
    StudyPanel *m_studies = nullptr;
    MeasurementsPanel *m_measurements = nullptr;
    ToolsMenu *m_tools = nullptr;
    ViewMenu *m_view = nullptr;
    QMenu *m_windowMenu = nullptr;
    QLabel *m_readout = nullptr, *m_engine = nullptr;
};

} // namespace pellucid::ui
