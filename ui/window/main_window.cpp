// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/main_window.h"

#include <algorithm>
#include <cmath>

#include <QAction>
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QFileInfo>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QScreen>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QVBoxLayout>

#include <glm/geometric.hpp>

#include "core/confined/reasons.h"
#include "core/system/log.h"
#include "ui/beside/study_pair.h"
#include "ui/beside/study_projection.h"
#include "ui/dialogs/angle_dialog.h"
#include "ui/dialogs/class_volumes_dialog.h"
#include "ui/dialogs/huge_question.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/jobs/job_strip.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/panels/classes_panel.h"
#include "ui/panels/measurements_panel.h"
#include "ui/panels/phase_bar.h"
#include "ui/panels/presets_panel.h"
#include "ui/panels/region_bar.h"
#include "ui/panels/start_page.h"
#include "ui/panels/study_panel.h"
#include "ui/settings/file_dialogs.h"
#include "ui/views/cine.h"
#include "ui/views/mpr_view.h"
#include "ui/views/pane_area.h"
#include "ui/views/projection_view.h"
#include "ui/widgets/dialog_place.h"
#include "ui/widgets/plain_label.h"
#include "ui/widgets/wheel_guard.h"
#include "ui/window/actions/commands.h"
#include "ui/window/application.h"
#include "ui/window/file_actions.h"
#include "ui/window/look_docks.h"
#include "ui/window/pane_menus.h"
#include "ui/window/projection_keys.h"
#include "ui/window/reopening.h"
#include "ui/window/server_commands.h"
#include "ui/window/study_docks.h"
#include "ui/window/tool_bar.h"
#include "ui/window/window_chooser.h"

namespace pellucid::ui {

MainWindow::MainWindow(Workbench &bench, const Preferences &preferences, QWidget *parent)
    : QMainWindow(parent), m_bench(bench), m_preferences(preferences),
      m_spoken(preferences.language) {
    setObjectName("mainWindow");
    setAcceptDrops(true);
    // With the frame that the desktop adds.
    constexpr QSize preferred(1600, 1000), frame(16, 44);
    resize(preferred.boundedTo(screen()->availableGeometry().size() - frame));
    qApp->installEventFilter(new WheelGuard(this));
    createPanes();
    m_docks = new StudyDocks(*this, m_bench);
    m_look = new LookDocks(*this, m_bench.study.document, m_bench.study.preparer,
                           m_bench.study.copier, *m_projection);
    m_files = new FileActions(*this, m_bench, *m_pair);
    m_servers = new ServerCommands(*this, m_bench, *m_docks, *m_pair);
    createActions();
    connectStudyDocks();
    connectLookDocks();
    connect(m_start, &StartPage::openFilesRequested, m_files, &FileActions::chooseFiles);
    connect(m_start, &StartPage::openFolderRequested, m_files, &FileActions::chooseFolder);
    createStatusBar();
    connectBench();
    const QSettings settings;
    restoreGeometry(settings.value("geometry").toByteArray());
    restoreState(settings.value("windowState").toByteArray());
    m_look->setMoved(settings.value("docksMoved").toBool());
    m_look->fit(height());
    m_panes->restoreSizes(settings);
    connect(new ProjectionKeys(*this, *m_projection), &ProjectionKeys::comparisonRequested, this,
            &MainWindow::compareLooks);
    showVolumeState();
    m_actions->refresh();
}

MainWindow::~MainWindow() {
    m_bench.exports.join();              // they refer to the panes
    m_pair->closeBeside();               // it refers to the open study
    m_bench.measurements.writePending(); // while a failure can still be reported
}

void MainWindow::createPanes() {
    std::array<QWidget *, 4> panes{};
    std::size_t n = 0;
    for (const auto orientation :
         {mpr::Orientation::axial, mpr::Orientation::coronal, mpr::Orientation::sagittal}) {
        m_mpr[n] = new MprView(m_bench.study.document, orientation);
        panes[n] = m_mpr[n];
        ++n;
    }
    m_projection = new ProjectionView(m_bench.study.document);
    panes[3] = m_projection;
    m_panes = new PaneArea(panes);
    for (MprView *view : m_mpr)
        connect(view, &MprView::maximizeRequested, m_panes, &PaneArea::toggleMaximized);
    connect(m_projection, &ProjectionView::maximizeRequested, m_panes, &PaneArea::toggleMaximized);

    m_start = new StartPage;
    connect(m_start, &StartPage::phantomRequested, this, &MainWindow::openPhantom);
    m_reopening = new Reopening(m_bench, *m_start, m_preferences, this);
    m_stack = new QStackedWidget;
    m_stack->addWidget(m_start);
    auto *viewing = new QWidget;
    auto *column = new QVBoxLayout(viewing);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    m_pair = new StudyPair({m_bench.study.document, m_mpr, m_projection, m_panes}, m_bench.card);
    restoreView(*m_projection, *m_pair);
    connect(m_pair, &StudyPair::failed, &m_bench.notices, &Notices::report);
    column->addWidget(new RegionBar(m_bench.study.document));
    column->addWidget(m_pair, 1);
    column->addWidget(new PhaseBar(m_bench.study.phases));
    m_stack->addWidget(viewing);
    setCentralWidget(m_stack);
}

void MainWindow::connectBench() {
    m_bench.study.document.whenever(Change::volume | Change::currentSource, this,
                                    &MainWindow::showVolumeState);
    connectProjection(m_bench.study, *m_projection, m_bench.card);
    connect(m_projection, &ProjectionView::anglesRequested, this, &MainWindow::showAngles);
    connect(&m_bench.card, &GraphicsCard::changed, this, [this] {
        if (!m_bench.study.document.volume())
            m_engine->setText(m_bench.card.description());
    });
    connect(&m_bench.study.opener, &StudyOpener::hugeFound, this,
            [this](const QStringList &paths, const std::vector<dicom::Skipped> &huge) {
                askForHuge(this, huge, [this, paths] {
                    m_bench.study.opener.openPaths(paths, {}, {.includesHuge = true});
                });
            });
}

void MainWindow::createActions() {
    Document &document = m_bench.study.document;
    const auto focused = [this]() -> Document & { return m_pair->focused().document; };
    auto *windows = new WindowChooser(document, focused, this);
    auto *cine = new Cine(m_mpr, *m_projection, this);
    m_actions = new ActionTable(this);
    const Scope scope{*this,   m_bench,  m_pair->open(), *m_pair,  *m_docks,
                      *m_look, *m_files, *m_servers,     *windows, *cine};
    for (const auto rows : {fileCommands, viewCommands, lookCommands, toolCommands})
        m_actions->add(rows(scope));
    for (const MenuEntry &menu : menus().bar)
        m_actions->fill(*menuBar(), menu);
    QMenu &list = *m_actions->menu("dockMenu");
    QAction *const reset = list.actions().front();
    std::vector<QDockWidget *> docks = m_docks->listed();
    const std::vector<QDockWidget *> ofLook = m_look->docks();
    docks.insert(docks.end(), ofLook.begin(), ofLook.end());
    for (QDockWidget *dock : docks)
        list.insertAction(reset, dock->toggleViewAction());
    list.insertSeparator(reset);
    // Elsewhere, Space activates the focused control.
    QAction *const play = (*m_actions)["playAction"];
    play->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    m_projection->addAction(play);
    for (MprView *plane : m_mpr)
        plane->addAction(play);
    const ToolBar bar = makeToolBar(*this, *m_actions);
    m_toolBar = bar.bar;
    setToolBarStyle(*m_toolBar, m_preferences.toolBar);
    windows->show(*m_actions->menu("windowMenu"), *bar.windows, *m_actions);
    auto *menus = new PaneMenus(m_pair->open(), *m_actions, this);
    connect(m_pair, &StudyPair::besideOpened, menus,
            [this, menus] { menus->addBeside(*m_pair->beside()); });

    // While a view moves, no action changes.
    constexpr Changes moves =
        Change::pose | Change::moving | Change::paneSize | Change::crosshair | Change::exposure;
    document.whenever(~moves, m_actions, [this, cine](Changes changes) {
        if (changes & Change::volume)
            cine->stop();
        m_actions->refresh();
    });
    connect(cine, &Cine::playingChanged, m_actions, &ActionTable::refresh);
    connect(&m_bench.study.phases, &Phases::changed, m_actions, &ActionTable::refresh);
    connect(&m_bench.card, &GraphicsCard::changed, m_actions, &ActionTable::refresh);
    connect(m_pair, &StudyPair::changed, m_actions, &ActionTable::refresh);
}

void MainWindow::connectStudyDocks() {
    StudyPanel *studies = &m_docks->studies();
    connect(studies, &StudyPanel::sourceActivated, &m_bench.study.opener,
            [this](int source) { m_bench.study.opener.openSource(source); });
    connect(studies, &StudyPanel::closeRequested, &m_bench.study.opener, &StudyOpener::closeSource);
    connect(studies, &StudyPanel::besideRequested, m_pair, &StudyPair::openBeside);
    connect(studies, &StudyPanel::libraryVolumeActivated, m_reopening, &Reopening::openFromLibrary);
    connect(studies, &StudyPanel::importRequested, m_files, &FileActions::importPaths);
    connect(&m_bench.library, &StudyLibrary::imported, this, [this](const ImportResult &result) {
        m_bench.study.document.addProblems(result.skipped);
        m_bench.notices.say(tr("Imported %1 series, %2 files; not used: %3")
                                .arg(QString::number(result.series), QString::number(result.files),
                                     QString::number(result.skipped.size())));
    });
    connect(&m_docks->measurements(), &MeasurementsPanel::viewRequested, m_projection,
            &ProjectionView::lookAlong);
    connect(&m_docks->measurements(), &MeasurementsPanel::exportRequested, m_files,
            &FileActions::exportMeasurements);
}

void MainWindow::connectLookDocks() {
    connect(&m_look->presets(), &PresetsPanel::failed, &m_bench.notices, &Notices::report);
    connect(&m_look->classes(), &ClassesPanel::volumesRequested, this,
            &MainWindow::showClassVolumes);
    connect(&m_look->classes(), &ClassesPanel::segmentationRequested, this,
            [this](const QStringList &paths) {
                if (paths.isEmpty())
                    m_files->chooseSegmentations();
                else
                    m_bench.study.segments.open(paths);
            });
}

PreferencesDialog &MainWindow::openPreferences() {
    return showOnly<PreferencesDialog>(*this, [this] {
        auto *dialog = new PreferencesDialog(*m_actions, m_spoken, this);
        connect(dialog, &PreferencesDialog::changed, this, &MainWindow::preferencesChanged);
        return dialog;
    });
}

void MainWindow::createStatusBar() {
    m_readout = new PlainLabel;
    m_readout->setObjectName("cursorReadout");
    m_readout->setMinimumWidth(280);
    m_engine = new PlainLabel;
    m_engine->setObjectName("engineLabel");
    statusBar()->setSizeGripEnabled(false);
    statusBar()->addWidget(m_readout);
    statusBar()->addWidget(
        new JobStrip(m_bench.study.jobs, "job", [this] { m_bench.study.preparer.cancel(); }));
    statusBar()->addWidget(new JobStrip(m_bench.exports, "export"));
    statusBar()->addPermanentWidget(m_engine);
    if (const auto *const application = qobject_cast<Application *>(qApp)) {
        auto *const unprotected = new PlainLabel(tr("Not protected"));
        unprotected->setObjectName("unprotectedLabel");
        unprotected->setProperty("role", "warning");
        unprotected->setToolTip(plainToolTip(translated(task::because::systemDoesNotProtect)));
        statusBar()->addPermanentWidget(unprotected);
        unprotected->setVisible(application->isUnprotected());
        connect(application, &Application::unprotected, unprotected, &QWidget::show);
        connect(application, &Application::unprotected, this,
                [this] { m_bench.notices.report(task::because::systemDoesNotProtect, {}); });
        connect(application, &Application::failed, &m_bench.notices, &Notices::report);
    }
    connect(&m_bench.notices, &Notices::shown, statusBar(), &QStatusBar::showMessage);
    connect(&m_bench.study.jobs, &JobRunner::failed, &m_bench.notices, &Notices::report);
    connect(m_projection, &ProjectionView::engineDescribed, this, [this](const QString &text) {
        if (text != m_engine->text())
            system::log(text.toStdString());
        m_engine->setText(text);
    });
    for (MprView *view : m_mpr)
        connect(view, &MprView::readoutChanged, m_readout, &PlainLabel::setText);
    connect(m_pair, &StudyPair::readoutChanged, m_readout, &PlainLabel::setText);
    m_engine->setText(m_bench.card.description());
}

void MainWindow::showVolumeState() {
    showTitle();
    showPictures();
    m_stack->setCurrentWidget(m_bench.study.document.volume() ||
                                      m_bench.study.document.currentSource() >= 0
                                  ? m_pair->parentWidget()
                                  : m_start);
}

// Scouts, single slices and images without positions are pictures: a projection would see them edge
// on.
void MainWindow::showPictures() {
    const auto &volume = m_bench.study.document.volume();
    const bool arePictures = volume && (volume->notes().isLocalizer || !volume->notes().placed ||
                                        volume->lattice().size().k == 1);
    if (!arePictures) {
        m_panes->showAlone(nullptr);
        return;
    }
    const volume::Lattice &lattice = volume->lattice();
    const glm::dvec3 normal = glm::normalize(glm::cross(lattice.step(0), lattice.step(1)));
    const auto facing = [&](const MprView *view) {
        return std::abs(
            glm::dot(m_bench.study.document.cut().axes.scrollAxis(view->orientation()), normal));
    };
    // Without positions, only the axial pane has pictures.
    m_panes->showAlone(volume->notes().placed
                           ? *std::max_element(m_mpr.begin(), m_mpr.end(),
                                               [&](const MprView *a, const MprView *b) {
                                                   return facing(a) < facing(b);
                                               })
                           : m_mpr.front());
}

void MainWindow::openPaths(const QStringList &paths) {
    // Paths are remembered, and may be opened again from another working folder.
    QStringList absolute;
    for (const QString &path : paths)
        absolute << QFileInfo(path).absoluteFilePath();
    m_bench.study.opener.openPaths(absolute);
}

void MainWindow::openLink(const QString &link) {
    try {
        m_servers->open(openRequestOf(link));
    } catch (const task::Error &error) {
        m_bench.notices.report(error.reason(), link.left(80));
    }
}

void MainWindow::setPreferences(const Preferences &preferences) {
    m_preferences = preferences;
    setToolBarStyle(*m_toolBar, preferences.toolBar);
    m_reopening->setPreferences(preferences);
    showTitle();
}

// The patient's name appears only if the user asked for it.
void MainWindow::showTitle() {
    const int open = m_bench.study.document.currentSource();
    setWindowTitle(
        m_preferences.showsPatient && open >= 0
            ? titleText(patientText(m_bench.study.document.sources()[std::size_t(open)].study)) +
                  " - Pellucid"
            : QString("Pellucid"));
}

void MainWindow::openPhantom(const QString &kind) {
    m_bench.study.opener.openPhantom(kind);
}

void MainWindow::dragEnterEvent(QDragEnterEvent *event) {
    // A study of the list is not opened by a slip of the hand.
    if (event->source() == nullptr && event->mimeData()->hasUrls())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent *event) {
    const QStringList paths = localPaths(*event->mimeData());
    event->acceptProposedAction();
    if (!paths.isEmpty())
        openPaths(paths);
}

void MainWindow::showAngles() {
    placeBeside(showOnly<AngleDialog>(
        *this, [this] { return new AngleDialog(m_bench.study.document, *m_projection, this); }));
}

void MainWindow::showClassVolumes() {
    Document &document = m_bench.study.document;
    if (!document.volume() || document.isPreview())
        return;
    showOnly<ClassVolumesDialog>(*this, [&] {
        auto *dialog = new ClassVolumesDialog(document, this);
        connect(dialog, &ClassVolumesDialog::failed, &m_bench.notices, &Notices::report);
        connect(dialog, &ClassVolumesDialog::saved, this, [this](const QString &path) {
            m_bench.notices.say(tr("Saved: %1").arg(QFileInfo(path).fileName()));
        });
        return dialog;
    });
}

void MainWindow::compareLooks(bool isComparing) {
    m_projection->setComparing(isComparing);
    if (isComparing && !m_projection->isComparing())
        m_bench.notices.say(tr("There is no earlier look to compare with"));
}

void MainWindow::keyPressEvent(QKeyEvent *event) {
    if (event->key() == Qt::Key_Escape && m_bench.study.jobs.isRunning())
        m_bench.study.preparer.cancel();
    else
        QMainWindow::keyPressEvent(event);
}

void MainWindow::changeEvent(QEvent *event) {
    // The key that compares looks may be released in another window.
    if (event->type() == QEvent::ActivationChange && !isActiveWindow() && m_projection != nullptr)
        m_projection->setComparing(false);
    QMainWindow::changeEvent(event);
}

void MainWindow::keepLayout() {
    QSettings settings;
    settings.setValue("geometry", saveGeometry());
    settings.setValue("windowState", saveState());
    settings.setValue("docksMoved", m_look->areMoved());
    m_panes->saveSizes(settings);
}

void MainWindow::resizeEvent(QResizeEvent *event) {
    QMainWindow::resizeEvent(event);
    if (m_look != nullptr)
        m_look->fit(height());
}

void MainWindow::resetLayout() {
    m_docks->reset();
    m_look->reset(height());
    m_panes->setPaneLayout(PaneLayout::onePlusThree);
    m_panes->restoreDefaultSizes();
}

void MainWindow::closeEvent(QCloseEvent *event) {
    keepLayout();
    m_bench.study.jobs.cancel();
    QMainWindow::closeEvent(event);
}

} // namespace pellucid::ui
