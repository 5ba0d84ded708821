// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>

#include <QMainWindow>

#include "ui/card_copier.h"
#include "ui/document.h"
#include "ui/graphics_card.h"
#include "ui/job_runner.h"
#include "ui/library/study_library.h"
#include "ui/look_preparer.h"
#include "ui/measurement_store.h"
#include "ui/phases.h"
#include "ui/study_opener.h"
#include "ui/theme.h"

class QActionGroup;
class QLabel;
class QSplitter;
class QStackedWidget;

namespace pellucid::ui {

class LookDocks;
class MeasurementsPanel;
class MprView;
class PaneArea;
class ProjectionView;
class StartPage;
class StudyBeside;
class StudyPanel;
class ToolsMenu;

/// The workstation's window: creates the panes and docks, names the menus, connects intents.
class MainWindow : public QMainWindow {
    Q_OBJECT
public:
    /// `engine`: of this run alone; else what was chosen before.
    explicit MainWindow(const Theme &theme, std::optional<EngineChoice> engine = std::nullopt,
                        QWidget *parent = nullptr);
    ~MainWindow() override;

    void openPaths(const QStringList &paths);
    void openPhantom(const QString &kind);
    /// Asks how, and for what is to be imported if there are no paths.
    void importPaths(const QStringList &paths);

    Document &document() { return m_document; }
    JobRunner &jobs() { return m_jobs; }
    StudyLibrary &library() { return m_library; }
    GraphicsCard &graphicsCard() { return m_card; }

protected:
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dropEvent(QDropEvent *event) override;
    void closeEvent(QCloseEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void keyReleaseEvent(QKeyEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    void createPanes();
    void createStudyDock();
    void createMeasurementsDock();
    void createFileMenu();
    void createEditMenu();
    void createViewMenu();
    void createHelpMenu();
    void createToolBar();
    void createStatusBar();
    void showVolumeState();
    void compareLooks(bool isComparing);
    void openBeside(const StudySource &source);
    void closeBeside();
    void showHeading();
    void chooseFiles();
    void chooseFolder();
    void savePicture();
    void exportPicture();
    void exportMeasurements();
    void saveScene();
    void openScene();
    void showManual();
    void showAbout();
    void remember(const QStringList &paths);
    void report(const QString &what, const QString &path);
    /// Runs it and reports what it throws.
    void attempt(const std::function<void()> &what);
    QAction *command(QMenu &menu, const QString &text, const char *name, const QKeySequence &key,
                     const std::function<void()> &run);

    Theme m_theme;
    Document m_document;
    JobRunner m_jobs, m_exports;
    StudyLibrary m_library;
    LookPreparer m_preparer;
    GraphicsCard m_card;
    CardCopier m_copier;
    StudyOpener m_opener;
    Phases m_phases;
    MeasurementStore m_store;
    std::array<MprView *, 3> m_mpr{};
    ProjectionView *m_projection = nullptr;
    LookDocks *m_look = nullptr;
    PaneArea *m_panes = nullptr;
    /// The two studies, while there is a second one.
    QSplitter *m_viewers = nullptr;
    StudyBeside *m_beside = nullptr;
    QLabel *m_heading = nullptr;
    QAction *m_linkAction = nullptr, *m_closeBesideAction = nullptr;
    StartPage *m_start = nullptr;
    QStackedWidget *m_stack = nullptr;
    StudyPanel *m_studies = nullptr;
    MeasurementsPanel *m_measurements = nullptr;
    ToolsMenu *m_tools = nullptr;
    QActionGroup *m_layouts = nullptr;
    QMenu *m_windowMenu = nullptr;
    QLabel *m_readout = nullptr, *m_engine = nullptr;
};

} // namespace pellucid::ui
