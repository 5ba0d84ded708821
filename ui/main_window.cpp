// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/main_window.h"

#include <QAction>
#include <QActionGroup>
#include <QCloseEvent>
#include <QComboBox>
#include <QCoreApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QScreen>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTextBrowser>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include "core/task/error.h"
#include "core/task/log.h"
#include "ui/add_command.h"
#include "ui/commands.h"
#include "ui/dock.h"
#include "ui/engine_menu.h"
#include "ui/export_dialog.h"
#include "ui/import_dialog.h"
#include "ui/look_docks.h"
#include "ui/look_menu.h"
#include "ui/panels/job_strip.h"
#include "ui/panels/measurements_panel.h"
#include "ui/panels/phase_bar.h"
#include "ui/panels/presets_panel.h"
#include "ui/panels/start_page.h"
#include "ui/panels/study_panel.h"
#include "ui/recent_paths.h"
#include "ui/scene_files.h"
#include "ui/study_beside.h"
#include "ui/tools_menu.h"
#include "ui/views/mpr_view.h"
#include "ui/views/pane_area.h"
#include "ui/views/projection_view.h"
#include "ui/window_chooser.h"

namespace pellucid::ui {

MainWindow::MainWindow(const Theme &theme, std::optional<EngineChoice> engine, QWidget *parent)
    : QMainWindow(parent), m_theme(theme), m_preparer(m_document, m_jobs), m_card(engine),
      m_copier(m_document, m_jobs, m_card), m_opener(m_document, m_jobs, m_preparer),
      m_phases(m_document, m_opener, m_jobs), m_store(m_document) {
    setObjectName("mainWindow");
    setWindowTitle("Pellucid");
    setAcceptDrops(true);
    resize(QSize(1600, 1000).boundedTo(screen()->availableGeometry().size()));
    createPanes();
    createStudyDock();
    createMeasurementsDock();
    m_look = new LookDocks(*this, m_document, m_preparer, m_copier, *m_projection, m_theme);
    connect(&m_look->presets(), &PresetsPanel::failed, this, &MainWindow::report);
    createFileMenu();
    createEditMenu();
    createViewMenu();
    auto *lookMenu =
        new LookMenu(*menuBar()->addMenu(tr("&Look")), m_document, *m_look, *m_projection);
    m_windowMenu = &lookMenu->windowMenu();
    m_tools = new ToolsMenu(*menuBar()->addMenu(tr("&Tools")), m_document, m_mpr, *m_projection,
                            m_phases);
    createHelpMenu();
    createToolBar();
    createStatusBar();
    connect(&m_document, &Document::volumeChanged, this, &MainWindow::showVolumeState);
    connect(&m_preparer, &LookPreparer::engineReady, &m_copier, &CardCopier::show);
    connect(&m_copier, &CardCopier::engineReady, m_projection, &ProjectionView::setEngine);
    connect(m_projection, &ProjectionView::cardFailed, &m_card, &GraphicsCard::giveUp);
    connect(&m_card, &GraphicsCard::changed, this, [this] {
        if (!m_document.volume())
            m_engine->setText(m_card.description());
    });
    connect(&m_preparer, &LookPreparer::planChanged, m_projection, &ProjectionView::setPlanState);
    connect(&m_opener, &StudyOpener::cameraKept, m_projection, &ProjectionView::adoptCamera);
    connect(&m_opener, &StudyOpener::phaseLeft, m_projection, &ProjectionView::holdTone);
    connect(&m_opener, &StudyOpener::notProjectable, m_projection, &ProjectionView::setMessage);
    connect(&m_opener, &StudyOpener::pathsOpened, this, &MainWindow::remember);
    connect(&m_document, &Document::currentSourceChanged, this, &MainWindow::showVolumeState);
    const QSettings settings;
    restoreGeometry(settings.value("geometry").toByteArray());
    restoreState(settings.value("windowState").toByteArray());
    showVolumeState();
}

MainWindow::~MainWindow() {
    // Work that still runs looks at the members.
    m_jobs.join();
    m_exports.join();
    m_library.jobs().join();
    delete m_beside;        // it looks at the open study
    m_store.writePending(); // while somebody can say that it failed
}

void MainWindow::createPanes() {
    std::array<QWidget *, 4> panes{};
    std::size_t n = 0;
    for (const auto orientation :
         {mpr::Orientation::axial, mpr::Orientation::coronal, mpr::Orientation::sagittal}) {
        m_mpr[n] = new MprView(m_document, orientation);
        panes[n] = m_mpr[n];
        ++n;
    }
    m_projection = new ProjectionView(m_document);
    panes[3] = m_projection;
    m_panes = new PaneArea(panes);
    for (MprView *view : m_mpr)
        connect(view, &MprView::maximizeRequested, m_panes, &PaneArea::toggleMaximized);
    connect(m_projection, &ProjectionView::maximizeRequested, m_panes, &PaneArea::toggleMaximized);

    m_start = new StartPage;
    connect(m_start, &StartPage::openFilesRequested, this, &MainWindow::chooseFiles);
    connect(m_start, &StartPage::openFolderRequested, this, &MainWindow::chooseFolder);
    connect(m_start, &StartPage::phantomRequested, this, &MainWindow::openPhantom);
    connect(m_start, &StartPage::pathRequested, this,
            [this](const QString &path) { openPaths({path}); });
    m_start->setRecentPaths(recentPaths());
    m_stack = new QStackedWidget;
    m_stack->addWidget(m_start);
    auto *viewing = new QWidget;
    auto *column = new QVBoxLayout(viewing);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    m_heading = new QLabel;
    m_heading->setObjectName("studyHeading");
    m_heading->setProperty("role", "studyHeading");
    m_heading->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    m_heading->setFixedHeight(headingHeight);
    m_heading->hide();
    auto *open = new QWidget;
    auto *openColumn = new QVBoxLayout(open);
    openColumn->setContentsMargins(0, 0, 0, 0);
    openColumn->setSpacing(0);
    openColumn->addWidget(m_heading);
    openColumn->addWidget(m_panes, 1);
    m_viewers = new QSplitter;
    m_viewers->setObjectName("viewers");
    m_viewers->setChildrenCollapsible(false);
    m_viewers->addWidget(open);
    column->addWidget(m_viewers, 1);
    column->addWidget(new PhaseBar(m_phases));
    m_stack->addWidget(viewing);
    setCentralWidget(m_stack);
}

void MainWindow::createStudyDock() {
    m_studies = new StudyPanel(m_document, m_library, m_theme);
    connect(m_studies, &StudyPanel::sourceActivated, &m_opener, &StudyOpener::openSource);
    connect(m_studies, &StudyPanel::closeRequested, &m_opener, &StudyOpener::closeSource);
    connect(m_studies, &StudyPanel::importRequested, this, &MainWindow::importPaths);
    connect(m_studies, &StudyPanel::besideRequested, this, &MainWindow::openBeside);
    connect(m_studies, &StudyPanel::libraryVolumeActivated, this,
            [this](const StudyFacts &study, const VolumeFacts &volume) {
                std::vector<VolumeFacts> series = m_library.volumes(study);
                std::erase_if(series, [&](const VolumeFacts &v) {
                    return v.seriesUid != volume.seriesUid || v.file != volume.file;
                });
                m_opener.openFromLibrary(study, series, volume.key(), m_library.files(volume));
            });
    connect(&m_library, &StudyLibrary::failed, this, &MainWindow::report);
    connect(&m_library, &StudyLibrary::imported, this, [this](const ImportResult &result) {
        m_document.clearProblems();
        m_document.addProblems(result.skipped);
        statusBar()->showMessage(tr("Imported: %1 series, %2 files; %3 not used")
                                     .arg(result.series)
                                     .arg(result.files)
                                     .arg(result.skipped.size()),
                                 8000);
    });
    m_document.addProblems(m_library.notices());
    QDockWidget *dock = makeDock(tr("STUDIES"), "studyDock", m_studies, m_studies->corner());
    m_studies->setMinimumWidth(250);
    addDockWidget(Qt::LeftDockWidgetArea, dock);
}

void MainWindow::createMeasurementsDock() {
    m_measurements = new MeasurementsPanel(m_document);
    connect(m_measurements, &MeasurementsPanel::exportRequested, this,
            &MainWindow::exportMeasurements);
    connect(m_measurements, &MeasurementsPanel::viewRequested, m_projection,
            &ProjectionView::lookAlong);
    connect(&m_store, &MeasurementStore::failed, this, &MainWindow::report);
    auto *dock =
        makeDock(tr("MEASUREMENTS"), "measurementsDock", m_measurements, m_measurements->corner());
    addDockWidget(Qt::LeftDockWidgetArea, dock);
    resizeDocks({findChild<QDockWidget *>("studyDock"), dock}, {700, 180}, Qt::Vertical);
}

QAction *MainWindow::command(QMenu &menu, const QString &text, const char *name,
                             const QKeySequence &key, const std::function<void()> &run) {
    return addCommand(menu, text, name, key, this, run);
}

void MainWindow::createFileMenu() {
    QMenu *menu = menuBar()->addMenu(tr("&File"));
    command(*menu, tr("&Open files..."), "openFilesAction", QKeySequence::Open, [this] {
        chooseFiles();
    })->setIconText(tr("Open"));
    command(*menu, tr("Open &folder..."), "openFolderAction", QKeySequence("Ctrl+Shift+O"),
            [this] { chooseFolder(); });
    command(*menu, tr("&Import into the library..."), "importAction", QKeySequence("Ctrl+I"),
            [this] { importPaths({}); })
        ->setIconText(tr("Import"));
    QMenu *phantoms = menu->addMenu(tr("Open &phantom"));
    command(*phantoms, tr("&Head"), "headPhantomAction", {}, [this] { openPhantom("head"); });
    command(*phantoms, tr("&Chest"), "chestPhantomAction", {}, [this] { openPhantom("chest"); });
    menu->addSeparator();
    command(*menu, tr("Open &scene..."), "openSceneAction", {}, [this] { openScene(); });
    command(*menu, tr("Save s&cene as..."), "saveSceneAction", {}, [this] { saveScene(); });
    command(*menu, tr("Save p&icture as..."), "savePictureAction", QKeySequence("F12"), [this] {
        savePicture();
    })->setIconText(tr("Picture"));
    command(*menu, tr("&Export picture..."), "exportPictureAction", QKeySequence("Ctrl+E"),
            [this] { exportPicture(); });
    command(*menu, tr("Export &measurements..."), "exportMeasurementsAction", {},
            [this] { exportMeasurements(); });
    menu->addSeparator();
    command(*menu, tr("&Forget recent studies"), "forgetRecentAction", {}, [this] {
        forgetRecentPaths();
        m_start->setRecentPaths({});
    });
    command(*menu, tr("&Quit"), "quitAction", QKeySequence::Quit, [this] { close(); });
}

void MainWindow::createEditMenu() {
    QMenu *menu = menuBar()->addMenu(tr("&Edit"));
    QAction *undo = m_document.undoStack()->createUndoAction(this, tr("Undo"));
    undo->setObjectName("undoAction");
    undo->setShortcut(QKeySequence::Undo);
    QAction *redo = m_document.undoStack()->createRedoAction(this, tr("Redo"));
    redo->setObjectName("redoAction");
    redo->setShortcut(QKeySequence("Ctrl+Shift+Z"));
    menu->addActions({undo, redo});
    menu->addSeparator();
    command(*menu, tr("&Find a study"), "findStudyAction", QKeySequence::Find, [this] {
        findChild<QDockWidget *>("studyDock")->show();
        m_studies->focusSearch();
    });
    menu->addSeparator();
    command(*menu, tr("&Delete measurement"), "deleteMeasurementAction", QKeySequence::Delete,
            [this] { m_measurements->removeSelected(); });
}

void MainWindow::createViewMenu() {
    QMenu *menu = menuBar()->addMenu(tr("&View"));
    using render::StandardView;
    const struct {
        QString text;
        const char *name;
        StandardView view;
        const char *hint;
    } views[] = {
        {tr("&Anterior"), "frontViewAction", StandardView::front, QT_TR_NOOP("Keypad 1")},
        {tr("&Posterior"), "backViewAction", StandardView::back, QT_TR_NOOP("Shift+Keypad 1")},
        {tr("&Left"), "leftViewAction", StandardView::left, QT_TR_NOOP("Keypad 3")},
        {tr("&Right"), "rightViewAction", StandardView::right, QT_TR_NOOP("Shift+Keypad 3")},
        {tr("&Superior"), "topViewAction", StandardView::top, QT_TR_NOOP("Keypad 7")},
        {tr("&Inferior"), "bottomViewAction", StandardView::bottom, QT_TR_NOOP("Shift+Keypad 7")}};
    for (const auto &v : views)
        command(*menu, v.text + "\t" + tr(v.hint), v.name, {},
                [this, view = v.view] { m_projection->showStandardView(view); });
    command(*menu, tr("R&eset views") + "\t" + tr("Keypad 0"), "resetViewsAction", {}, [this] {
        m_projection->resetView();
        for (MprView *view : m_mpr)
            view->resetView();
        Cut cut = m_document.cut();
        cut.axes = {};
        m_document.setCut(cut);
        m_document.centerCrosshair();
    });
    QAction *about =
        command(*menu, tr("&Orbit about the crosshair"), "orbitCrosshairAction", QKeySequence("O"),
                [this] { m_projection->setOrbitsCrosshair(!m_projection->orbitsCrosshair()); });
    about->setCheckable(true);
    QAction *compare =
        command(*menu, tr("&Compare with the look before") + "\t" + tr("hold Q"), "compareAction",
                {}, [this] { compareLooks(!m_projection->isComparing()); });
    compare->setCheckable(true);
    connect(menu, &QMenu::aboutToShow, this,
            [this, compare] { compare->setChecked(m_projection->isComparing()); });
    m_linkAction =
        command(*menu, tr("Lin&k the studies"), "linkStudiesAction", QKeySequence("Shift+Y"),
                [this] { m_beside->findChild<QToolButton *>("linkButton")->toggle(); });
    m_linkAction->setCheckable(true);
    m_closeBesideAction = command(*menu, tr("Close the study besi&de"), "closeBesideAction",
                                  QKeySequence("Ctrl+Shift+W"), [this] { closeBeside(); });
    closeBeside();
    command(*menu, tr("Prepare the projection a&gain"), "prepareAgainAction", QKeySequence("F5"),
            [this] { m_preparer.prepareAgain(); });
    menu->addSeparator();
    m_layouts = new QActionGroup(this);
    const auto layout = [&](const QString &text, const char *name, PaneLayout which) {
        QAction *action =
            command(*menu, text, name, {}, [this, which] { m_panes->setPaneLayout(which); });
        action->setCheckable(true);
        action->setActionGroup(m_layouts);
        return action;
    };
    layout(tr("1 + 3"), "onePlusThreeAction", PaneLayout::onePlusThree)->setChecked(true);
    layout(tr("2 x 2"), "twoByTwoAction", PaneLayout::twoByTwo);
    menu->addSeparator();
    addEngineMenu(*menu->addMenu(tr("Projection &engine")), m_card);
    menu->addSeparator();
    QAction *full = command(*menu, tr("&Full screen"), "fullScreenAction", QKeySequence("F11"),
                            [this] { setWindowState(windowState() ^ Qt::WindowFullScreen); });
    full->setCheckable(true);
}

void MainWindow::createHelpMenu() {
    QMenu *window = menuBar()->addMenu(tr("W&indow"));
    for (const char *dock : {"studyDock", "measurementsDock"})
        window->addAction(findChild<QDockWidget *>(dock)->toggleViewAction());
    for (QDockWidget *dock : m_look->docks())
        window->addAction(dock->toggleViewAction());
    QMenu *menu = menuBar()->addMenu(tr("&Help"));
    command(*menu, tr("&Manual"), "manualAction", QKeySequence("F1"), [this] { showManual(); });
    command(*menu, tr("&About Pellucid"), "aboutAction", {}, [this] { showAbout(); });
}

void MainWindow::createToolBar() {
    QToolBar *bar = addToolBar(tr("Tools"));
    bar->setObjectName("toolBar");
    bar->setMovable(false);
    bar->setToolButtonStyle(Qt::ToolButtonTextOnly);
    bar->addAction(findChild<QAction *>("openFilesAction"));
    bar->addAction(findChild<QAction *>("importAction"));
    bar->addSeparator();
    m_tools->addTo(*bar);
    bar->addSeparator();
    bar->addActions(m_layouts->actions());
    bar->addSeparator();
    bar->addAction(findChild<QAction *>("savePictureAction"));
    auto *space = new QWidget;
    space->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    bar->addWidget(space);
    auto *windowBox = new QComboBox;
    windowBox->setObjectName("windowBox");
    windowBox->setAccessibleName(tr("Window of the planes"));
    windowBox->setToolTip(tr("Window of the planes: width / center (keys 0 to 5)"));
    windowBox->setMinimumWidth(230);
    bar->addWidget(windowBox);
    new WindowChooser(m_document, *m_windowMenu, *windowBox);
}

void MainWindow::createStatusBar() {
    m_readout = new QLabel;
    m_readout->setObjectName("cursorReadout");
    m_readout->setMinimumWidth(280);
    m_engine = new QLabel;
    m_engine->setObjectName("engineLabel");
    statusBar()->setSizeGripEnabled(false);
    statusBar()->addWidget(m_readout);
    statusBar()->addWidget(new JobStrip(m_jobs, "job"));
    statusBar()->addPermanentWidget(m_engine);
    connect(&m_jobs, &JobRunner::started, m_projection, &ProjectionView::jobStarted);
    connect(&m_jobs, &JobRunner::finished, this, [this] {
        m_projection->jobEnded();
        // A load that was cancelled leaves nothing selected.
        if (!m_document.volume())
            m_document.setCurrentSource(-1);
    });
    connect(&m_jobs, &JobRunner::failed, this, &MainWindow::report);
    connect(m_projection, &ProjectionView::engineDescribed, this, [this](const QString &text) {
        if (text != m_engine->text())
            task::log(text.toStdString());
        m_engine->setText(text);
    });
    for (MprView *view : m_mpr)
        connect(view, &MprView::readoutChanged, m_readout, &QLabel::setText);
    m_engine->setText(m_card.description());
}

void MainWindow::showVolumeState() {
    showHeading();
    m_stack->setCurrentWidget(m_document.volume() || m_document.currentSource() >= 0
                                  ? m_viewers->parentWidget()
                                  : m_start);
}

void MainWindow::openPaths(const QStringList &paths) {
    // They are remembered, and opened again from another folder.
    QStringList absolute;
    for (const QString &path : paths)
        absolute << QFileInfo(path).absoluteFilePath();
    m_opener.openPaths(absolute);
}

void MainWindow::openPhantom(const QString &kind) {
    m_opener.openPhantom(kind);
}

void MainWindow::importPaths(const QStringList &paths) {
    auto *dialog = new ImportDialog(paths, this);
    connect(dialog, &ImportDialog::chosen, &m_library, &StudyLibrary::import);
    dialog->open();
}

void MainWindow::remember(const QStringList &paths) {
    addRecentPaths(paths);
    m_start->setRecentPaths(recentPaths());
}

void MainWindow::report(const QString &what, const QString &path) {
    m_document.addProblems({{path.toStdString(), what.toStdString()}});
    // The window stays usable: what was open stays, or the start page is there again.
    if (!m_document.volume())
        m_document.setCurrentSource(-1);
    else
        m_projection->setMessage(what);
    statusBar()->showMessage(what, 8000);
}

void MainWindow::attempt(const std::function<void()> &what) {
    try {
        what();
    } catch (const task::Error &error) {
        report(QString::fromStdString(error.reason()),
               QString::fromStdString(error.path().string()));
    }
}

void MainWindow::chooseFiles() {
    openPaths(QFileDialog::getOpenFileNames(this, tr("Open files")));
}

void MainWindow::chooseFolder() {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Open folder"));
    if (!folder.isEmpty())
        openPaths({folder});
}

void MainWindow::savePicture() {
    attempt([&] {
        const QImage picture = m_projection->picture();
        if (picture.isNull()) {
            statusBar()->showMessage(tr("There is no projection to save yet"), 4000);
            return;
        }
        const QString path = QFileDialog::getSaveFileName(
            this, tr("Save picture"), "projection.png", tr("PNG image (*.png)"));
        if (!path.isEmpty())
            writePictureFile(path, picture);
    });
}

void MainWindow::exportPicture() {
    // Beside the window, which goes on: it may be turned to what is to be written.
    (new ExportDialog(m_document, {m_mpr, m_projection}, m_exports, this))->show();
}

void MainWindow::exportMeasurements() {
    if (m_document.measured().empty()) {
        statusBar()->showMessage(tr("There are no measurements to export yet"), 4000);
        return;
    }
    const QString path = QFileDialog::getSaveFileName(this, tr("Export measurements"),
                                                      "measurements.csv", tr("Table (*.csv)"));
    if (!path.isEmpty())
        attempt([&] { m_store.exportTable(path); });
}

void MainWindow::saveScene() {
    if (!m_projection->showsWhatIsAskedFor()) {
        statusBar()->showMessage(tr("There is no projection of this scene yet"), 4000);
        return;
    }
    const QString path =
        QFileDialog::getSaveFileName(this, tr("Save scene"), "scene.json", tr("Scene (*.json)"));
    if (path.isEmpty())
        return;
    attempt([&] { writeSceneFile(path, m_projection->sceneOfPicture()); });
}

void MainWindow::openScene() {
    const QString path =
        QFileDialog::getOpenFileName(this, tr("Open scene"), {}, tr("Scene (*.json)"));
    if (path.isEmpty())
        return;
    attempt([&] {
        render::Scene scene = readSceneFile(path);
        scene.plannedFor = {}; // the window plans for the volume, whatever a file says
        m_document.undoStack()->push(new EditScene(m_document, scene, tr("Open scene")));
        m_projection->adoptCamera(scene.camera);
    });
}

void MainWindow::showManual() {
    // Beside the window, not over it: people read and try.
    auto *manual = new QTextBrowser;
    manual->setObjectName("manual");
    manual->setAttribute(Qt::WA_DeleteOnClose);
    manual->setWindowTitle(tr("Pellucid manual"));
    manual->setSource(QUrl("qrc:/pellucid/manual/manual.html"));
    manual->resize(640, 760);
    manual->show();
}

void MainWindow::showAbout() {
    QMessageBox::about(
        this, tr("About Pellucid"),
        tr("<b>Pellucid %1</b><br>Projections of DICOM studies in the frequency domain.<br><br>"
           "<b>Not for diagnostic use.</b><br><br>GPL-3.0-or-later. Built on Qt %2, DCMTK, "
           "OpenJPEG, FFTW, GLM, oneTBB, libepoxy.")
            .arg(QCoreApplication::applicationVersion(), qVersion()));
}

void MainWindow::dragEnterEvent(QDragEnterEvent *event) {
    if (event->mimeData()->hasUrls())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent *event) {
    QStringList paths;
    for (const QUrl &url : event->mimeData()->urls())
        if (url.isLocalFile())
            paths << url.toLocalFile();
    event->acceptProposedAction();
    if (!paths.isEmpty())
        openPaths(paths);
}

void MainWindow::compareLooks(bool isComparing) {
    m_projection->setComparing(isComparing);
    if (isComparing && !m_projection->isComparing())
        statusBar()->showMessage(tr("There is no look before this one"), 4000);
}

void MainWindow::openBeside(const StudySource &source) {
    if (m_beside == nullptr) {
        m_beside = new StudyBeside({m_document, m_mpr, m_projection, m_panes}, m_card);
        m_viewers->addWidget(m_beside);
        m_viewers->setSizes({1, 1});
        m_beside->setTool(m_tools->tool());
        connect(m_tools, &ToolsMenu::toolChosen, m_beside, &StudyBeside::setTool);
        connect(m_beside, &StudyBeside::closeRequested, this, &MainWindow::closeBeside,
                Qt::QueuedConnection); // a button of what is deleted then
        connect(m_beside, &StudyBeside::linkChanged, m_linkAction, &QAction::setChecked);
        connect(m_beside, &StudyBeside::readoutChanged, m_readout, &QLabel::setText);
        connect(m_beside, &StudyBeside::failed, this, &MainWindow::report);
        m_linkAction->setChecked(true);
    }
    m_linkAction->setEnabled(true);
    m_closeBesideAction->setEnabled(true);
    showHeading();
    m_beside->open(source);
}

void MainWindow::closeBeside() {
    delete m_beside;
    m_beside = nullptr;
    m_linkAction->setEnabled(false);
    m_linkAction->setChecked(false);
    m_closeBesideAction->setEnabled(false);
    showHeading();
}

// Which is which is asked only where there are two.
void MainWindow::showHeading() {
    const int open = m_document.currentSource();
    m_heading->setVisible(m_beside != nullptr && open >= 0);
    if (open >= 0)
        m_heading->setText(headingText(m_document.sources()[std::size_t(open)]));
}

void MainWindow::keyPressEvent(QKeyEvent *event) {
    if (event->key() == Qt::Key_Escape && m_jobs.isRunning())
        m_jobs.cancel();
    else if (event->key() == Qt::Key_Q && event->modifiers() == Qt::NoModifier) {
        if (!event->isAutoRepeat()) // held: side by side till it is let go
            compareLooks(true);
    } else
        QMainWindow::keyPressEvent(event);
}

void MainWindow::keyReleaseEvent(QKeyEvent *event) {
    if (event->key() == Qt::Key_Q && !event->isAutoRepeat())
        compareLooks(false);
    else
        QMainWindow::keyReleaseEvent(event);
}

void MainWindow::changeEvent(QEvent *event) {
    // Who goes to another window lets go there.
    if (event->type() == QEvent::ActivationChange && !isActiveWindow() && m_projection != nullptr)
        m_projection->setComparing(false);
    QMainWindow::changeEvent(event);
}

void MainWindow::closeEvent(QCloseEvent *event) {
    QSettings settings;
    settings.setValue("geometry", saveGeometry());
    settings.setValue("windowState", saveState());
    m_jobs.cancel();
    QMainWindow::closeEvent(event);
}

} // namespace pellucid::ui
