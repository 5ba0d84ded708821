// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <QMainWindow>

#include "core/task/reason.h"
#include "ui/settings/preferences.h"
#include "ui/window/workbench.h"

class QStackedWidget;
class QToolBar;

namespace pellucid::ui {

class ActionTable;
class FileActions;
class LookDocks;
class MprView;
class PaneArea;
class PlainLabel;
class PreferencesDialog;
class ProjectionView;
class Reopening;
class ServerCommands;
class StartPage;
class StudyDocks;
class StudyPair;

/// The workstation's window: creates panes, docks and actions, and connects them.
class MainWindow : public QMainWindow {
    Q_OBJECT
public:
    MainWindow(Workbench &bench, const Preferences &preferences = {}, QWidget *parent = nullptr);
    ~MainWindow() override;

    void openPaths(const QStringList &paths);
    /// Opens what a link of another program names, see OpenRequest.
    void openLink(const QString &link);
    void openPhantom(const QString &kind);
    void setPreferences(const Preferences &preferences);
    PreferencesDialog &openPreferences();
    void showAngles();
    void showClassVolumes();
    void compareLooks(bool isComparing);
    /// Shows panes and docks where they were at first.
    void resetLayout();
    /// Saves the sizes and places of window, docks and panes in the settings.
    void keepLayout();

    Document &document() { return m_bench.study.document; }
    JobRunner &jobs() { return m_bench.study.jobs; }
    StudyLibrary &library() { return m_bench.library; }
    GraphicsCard &graphicsCard() { return m_bench.card; }
    FileActions &files() { return *m_files; }
    ActionTable &actions() { return *m_actions; }
    Reopening &reopening() { return *m_reopening; }

signals:
    void preferencesChanged(const pellucid::ui::Preferences &preferences);

protected:
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dropEvent(QDropEvent *event) override;
    void closeEvent(QCloseEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    void createPanes();
    void createActions();
    void connectStudyDocks();
    void connectLookDocks();
    void connectBench();
    void createStatusBar();
    void showVolumeState();
    void showPictures();
    void showTitle();

    Workbench &m_bench;
    Preferences m_preferences;
    const QString m_spoken; ///< the preferred language when the program started
    ActionTable *m_actions = nullptr;
    FileActions *m_files = nullptr;
    ServerCommands *m_servers = nullptr;
    std::array<MprView *, 3> m_mpr{};
    ProjectionView *m_projection = nullptr;
    LookDocks *m_look = nullptr;
    PaneArea *m_panes = nullptr;
    StudyPair *m_pair = nullptr;
    StartPage *m_start = nullptr;
    Reopening *m_reopening = nullptr;
    QStackedWidget *m_stack = nullptr;
    StudyDocks *m_docks = nullptr;
    QToolBar *m_toolBar = nullptr;
    PlainLabel *m_readout = nullptr, *m_engine = nullptr;
};

} // namespace pellucid::ui
