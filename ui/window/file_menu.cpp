// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/file_menu.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <QAction>
#include <QClipboard>
#include <QDateTime>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLocale>
#include <QMenu>
#include <QPrintDialog>
#include <QPrinter>

#include "core/scene/reasons.h"
#include "core/task/error.h"
#include "ui/document/add_command.h"
#include "ui/document/commands.h"
#include "ui/export/export_dialog.h"
#include "ui/export/print_picture.h"
#include "ui/export/scene_files.h"
#include "ui/export/segment_writer.h"
#include "ui/language/reasons.h"
#include "ui/opening/reasons.h"
#include "ui/panels/header_dialog.h"
#include "ui/settings/file_dialogs.h"
#include "ui/views/projection_view.h"
#include "ui/window/import_dialog.h"
#include "ui/window/subtraction_dialog.h"
#include "ui/window/workbench.h"

namespace pellucid::ui {

FileMenu::FileMenu(QMenu &menu, QWidget &window, Workbench &bench, const Panes &panes)
    : QObject(&menu), m_window(window), m_bench(bench), m_panes(panes) {
    const auto add = [&](QMenu &to, const QString &text, const char *name, const QKeySequence &key,
                         const std::function<void()> &run) {
        return addCommand(to, text, name, key, this, run);
    };
    add(menu, tr("&Open files..."), "openFilesAction", QKeySequence::Open, [this] {
        chooseFiles();
    })->setIconText(tr("Open"));
    add(menu, tr("Open &folder..."), "openFolderAction", QKeySequence("Ctrl+Shift+O"),
        [this] { chooseFolder(); });
    add(menu, tr("&Import into the library..."), "importAction", QKeySequence("Ctrl+I"), [this] {
        importPaths({});
    })->setIconText(tr("Import"));
    add(menu, tr("Ser&vers..."), "serversAction", {}, [this] { emit serversRequested(); });
    QAction *const segmentation = add(menu, tr("Open se&gmentation..."), "openSegmentationAction",
                                      {}, [this] { chooseSegmentations(); });
    QAction *const subtraction = add(menu, tr("Su&btract a volume..."), "subtractAction", {},
                                     [this] { chooseSubtrahend(); });
    const auto enable = [this, segmentation, subtraction] {
        const Document &document = m_bench.study.document;
        const bool isOpen = document.volume() && !document.isPreview();
        segmentation->setEnabled(isOpen);
        subtraction->setEnabled(isOpen && !document.volume()->notes().isDifference &&
                                document.volume()->notes().placed);
    };
    bench.study.document.whenever(Change::volume, this, enable);
    enable();
    QMenu *phantoms = menu.addMenu(tr("Open &phantom"));
    add(*phantoms, tr("&Head"), "headPhantomAction", {}, [this] { emit phantomChosen("head"); });
    add(*phantoms, tr("&Chest"), "chestPhantomAction", {}, [this] { emit phantomChosen("chest"); });
    menu.addSeparator();
    add(menu, tr("Open &scene..."), "openSceneAction", {}, [this] { openScene(); });
    add(menu, tr("Save s&cene as..."), "saveSceneAction", {}, [this] { saveScene(); });
    add(menu, tr("Save classes as segmenta&tion..."), "saveSegmentsAction", {},
        [this] { saveSegments(); });
    add(menu, tr("Save p&icture as..."), "savePictureAction", QKeySequence("F12"), [this] {
        savePicture();
    })->setIconText(tr("Picture"));
    add(menu, tr("&Export picture..."), "exportPictureAction", QKeySequence("Ctrl+E"), [this] {
        exportPicture();
    })->setIconText(tr("Export"));
    add(menu, tr("Cop&y picture"), "copyPictureAction", QKeySequence::Copy,
        [this] { copyPicture(); });
    add(menu, tr("Pri&nt..."), "printAction", QKeySequence::Print, [this] { printPicture(); });
    add(menu, tr("Export &measurements..."), "exportMeasurementsAction", {},
        [this] { exportMeasurements(); });
    // Nothing is made of a part of a study.
    bench.study.document.whenever(Change::volume, this, [this] {
        for (const char *const name : {"saveSceneAction", "saveSegmentsAction", "savePictureAction",
                                       "exportPictureAction", "copyPictureAction", "printAction"})
            m_window.findChild<QAction *>(name)->setEnabled(!m_bench.study.document.isPreview());
    });
    QAction *const header = add(menu, tr("&DICOM header..."), "headerAction",
                                QKeySequence("Ctrl+D"), [this] { showHeader(); });
    bench.study.document.whenever(Change::volume, this,
                                  [this, header] { header->setEnabled(!headerFiles().isEmpty()); });
    header->setEnabled(!headerFiles().isEmpty());
    menu.addSeparator();
    add(menu, tr("P&references..."), "preferencesAction", QKeySequence("Ctrl+,"),
        [this] { emit preferencesRequested(); });
    add(menu, tr("Clear recent st&udies"), "forgetRecentAction", {},
        [this] { emit recentForgotten(); });
    add(menu, tr("&Quit"), "quitAction", QKeySequence::Quit, [this] { emit quitRequested(); });
}

void FileMenu::attempt(const std::function<void()> &what) {
    try {
        what();
    } catch (const task::Error &error) {
        // An action that is not possible now is not a problem of the study.
        if (error.code() == task::ErrorCode::usage && error.path().empty())
            emit messageShown(translated(error.reason()));
        else
            emit failed(error.reason(), QString::fromStdString(error.path().string()));
    }
}

void FileMenu::chooseFiles() {
    emit pathsChosen(askForFiles(&m_window, tr("Open files")));
}

void FileMenu::chooseSegmentations() {
    m_bench.study.segments.open(askForFiles(&m_window, tr("Open segmentation")));
}

void FileMenu::chooseSubtrahend() {
    const Document &document = m_bench.study.document;
    const int open = document.currentSource();
    if (open < 0)
        return;
    const StudySource minuend = document.sources()[std::size_t(open)];
    auto *dialog =
        new SubtractionDialog(minuend, subtrahends(document, m_bench.library), &m_window);
    connect(dialog, &SubtractionDialog::chosen, this,
            [this, minuend](const StudySource &subtrahend,
                            const std::shared_ptr<Alignment> &alignment, BesideDifference beside) {
                m_bench.study.opener.openDifference(subtrahend, alignment);
                if (beside == BesideDifference::minuend)
                    emit besideRequested(minuend);
                else if (beside == BesideDifference::alignedSubtrahend)
                    emit besideRequested(alignedSource(minuend, subtrahend, alignment));
            });
    dialog->open();
}

void FileMenu::chooseFolder() {
    const QString folder = askForFolder(&m_window, tr("Open folder"));
    if (!folder.isEmpty())
        emit pathsChosen({folder});
}

void FileMenu::importPaths(const QStringList &paths) {
    auto *dialog = new ImportDialog(paths, &m_window);
    connect(dialog, &ImportDialog::chosen, this,
            [this](const Import &import) { m_bench.library.import(import); });
    dialog->open();
}

void FileMenu::reportSaved(const QString &path) {
    emit messageShown(tr("Saved: %1").arg(QFileInfo(path).fileName()));
}

void FileMenu::savePicture() {
    attempt([&] {
        const QImage picture = m_panes.projection->picture();
        if (picture.isNull()) {
            emit messageShown(tr("There is no projection to save yet"));
            return;
        }
        const QString path = askForSavePath(&m_window, tr("Save picture"), "projection.png",
                                            tr("PNG image (*.png)"));
        if (path.isEmpty())
            return;
        m_bench.study.document.requireOther({path.toStdString()});
        writePictureFile(path, picture);
        reportSaved(path);
    });
}

void FileMenu::exportPicture() {
    if (auto *shown = m_window.findChild<ExportDialog *>()) {
        shown->raise();
        shown->activateWindow();
        return;
    }
    // Not modal: the user may still adjust the view for the export.
    auto *dialog = new ExportDialog(m_bench.study.document, m_panes, m_bench.exports,
                                    m_bench.servers, &m_window);
    connect(dialog, &ExportDialog::written, this, &FileMenu::reportSaved);
    connect(dialog, &ExportDialog::sent, this,
            [this](const QString &server) { emit messageShown(tr("Sent to %1").arg(server)); });
    connect(dialog, &ExportDialog::captured, this,
            [this](const std::shared_ptr<const dicom::Catalogue> &capture) {
                m_bench.study.document.addSources(sourcesFrom(capture));
            });
    dialog->show();
}

const Document &FileMenu::focusedDocument() const {
    return m_focused ? m_focused().document : m_bench.study.document;
}

Panes FileMenu::focusedPanes() const {
    if (!m_focused)
        return m_panes;
    const Viewer viewer = m_focused();
    return {viewer.planes, viewer.projection};
}

void FileMenu::copyPicture() {
    withPicture(1, tr("Copying the picture"), [this](const QImage &picture) {
        QGuiApplication::clipboard()->setImage(picture);
        emit messageShown(tr("Copied the picture"));
    });
}

void FileMenu::printPicture() {
    const Document &document = focusedDocument();
    const int open = document.currentSource();
    if (open < 0)
        return;
    // Take the heading now: a different study may be open when the picture is ready.
    const StudySource &source = document.sources()[std::size_t(open)];
    const QString heading = patientText(source.study) + ", " + studyText(source.study) + ", " +
                            seriesText(source.volume);
    // Enough pixels for a page of paper.
    withPicture(2, tr("Making the picture"), [this, heading](const QImage &picture) {
        const PrintedPage page{
            picture, heading,
            tr("Pellucid, printed %1. Not for diagnostic use.")
                .arg(QLocale().toString(QDateTime::currentDateTime(), QLocale::ShortFormat))};
        auto printer = std::make_shared<QPrinter>(QPrinter::HighResolution);
        printer->setPageOrientation(picture.width() > picture.height() ? QPageLayout::Landscape
                                                                       : QPageLayout::Portrait);
        auto *dialog = new QPrintDialog(printer.get(), &m_window);
        dialog->setObjectName("printDialog");
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->setWindowTitle(tr("Print the picture"));
        connect(dialog, qOverload<QPrinter *>(&QPrintDialog::accepted), this,
                [this, page, printer](QPrinter *) {
                    emit messageShown(print(page, *printer) ? tr("Sent to the printer")
                                                            : tr("The printer is not available"));
                });
        // The dialog refers to the printer as long as it exists.
        connect(dialog, &QObject::destroyed, this, [printer] {});
        dialog->open();
    });
}

void FileMenu::withPicture(int scale, const QString &title,
                           const std::function<void(const QImage &)> &use) {
    PictureExport what;
    const Panes panes = focusedPanes();
    what.pane = panes.current();
    what.scale = scale;
    if (m_bench.exports.isRunning()) { // another job would cancel it
        emit messageShown(tr("An export is running: copy and print when it has ended"));
        return;
    }
    attempt([&] {
        m_bench.exports.start(
            title,
            [make = pictureMaker(what, panes, focusedDocument()), use](const Job &job) {
                const QImage picture = make(job.progress());
                job.deliver([picture, use] { use(picture); });
            },
            [this](const Outcome &outcome) {
                if (outcome.kind == Outcome::Kind::failed)
                    emit failed(*outcome.reason, outcome.path);
            });
    });
}

// In the order of the slices, if every file is a slice.
QStringList FileMenu::headerFiles() const {
    const Document &document = focusedDocument();
    const int open = document.currentSource();
    if (open < 0 || !document.volume())
        return {};
    const StudySource &source = document.sources()[std::size_t(open)];
    if (!source.phantom.isEmpty() || !source.volume.file.isEmpty() || source.difference)
        return {};
    return int(source.slices.size()) == document.volume()->lattice().size().k ? source.slices
                                                                              : source.files;
}

void FileMenu::showHeader() {
    const QStringList files = headerFiles();
    if (files.isEmpty())
        return;
    const Document &document = focusedDocument();
    const QStringList &slices = document.sources()[std::size_t(document.currentSource())].slices;
    const double slice = document.volume()->lattice().voxel(document.crosshair()).v.z;
    const auto file = files.indexOf(slices.value(int(std::lround(slice))));
    auto *dialog = new HeaderDialog(files, int(std::max<qsizetype>(0, file)), &m_window);
    dialog->show();
}

void FileMenu::exportMeasurements() {
    if (m_bench.study.document.measured().empty()) {
        emit messageShown(tr("There are no measurements to export yet"));
        return;
    }
    const QString path = askForSavePath(&m_window, tr("Export measurements"), "measurements.csv",
                                        tr("Table (*.csv)"));
    if (path.isEmpty())
        return;
    attempt([&] {
        m_bench.study.document.requireOther({path.toStdString()});
        m_bench.measurements.exportTable(path);
        reportSaved(path);
    });
}

void FileMenu::saveScene() {
    if (!m_panes.projection->showsWhatIsAskedFor()) {
        emit messageShown(tr("There is no projection of this scene yet"));
        return;
    }
    const QString path =
        askForSavePath(&m_window, tr("Save scene"), "scene.json", tr("Scene (*.json)"));
    if (path.isEmpty())
        return;
    attempt([&] {
        m_bench.study.document.requireOther({path.toStdString()});
        writeSceneFile(path, m_panes.projection->sceneOfPicture());
        reportSaved(path);
    });
}

void FileMenu::saveSegments() {
    const Document &document = m_bench.study.document;
    if (!document.volume() || document.isPreview() ||
        classify::visibleClasses(document.scene().look).empty()) {
        emit messageShown(tr("There are no classes to save yet"));
        return;
    }
    const QString path =
        askForSavePath(&m_window, tr("Save classes as segmentation"), "segmentation.dcm",
                       tr("DICOM segmentation (*.dcm);;Labels (*.nrrd)"));
    if (path.isEmpty())
        return;
    attempt([&] {
        m_bench.exports.start(
            tr("Writing %1").arg(QFileInfo(path).fileName()),
            [this, path, write = segmentWriter(document, path)](const Job &job) {
                const QStringList empty = write(job.progress());
                job.deliver([this, path, empty] {
                    reportSaved(path);
                    if (!empty.isEmpty())
                        emit messageShown(tr("Saved: %1; no sample belongs to %2")
                                              .arg(QFileInfo(path).fileName(), empty.join(", ")));
                });
            },
            [this, path](const Outcome &outcome) {
                if (outcome.kind == Outcome::Kind::failed)
                    emit failed(*outcome.reason, outcome.path);
            },
            path);
    });
}

void FileMenu::openScene() {
    const QString path = askForFile(&m_window, tr("Open scene"), tr("Scene (*.json)"));
    if (path.isEmpty())
        return;
    attempt([&] {
        scene::Scene scene = readSceneFile(path);
        if (const QStringList missing =
                missingSegments(scene.look, m_bench.study.document.segments().get());
            !missing.isEmpty())
            throw task::Error(task::ErrorCode::usage,
                              task::because::sceneNeedsSegments(missing.join(", ").toStdString()),
                              path.toStdString());
        const auto &volume = m_bench.study.document.volume();
        if (scene.isOfDifference && volume && !volume->notes().isDifference)
            throw task::Error(task::ErrorCode::usage, task::because::sceneShowsADifference,
                              path.toStdString());
        scene.isOfDifference = false;
        scene.plannedFor = {};       // the window always plans for the whole volume
        scene.tone.exposure.reset(); // the open study may be another one: it has its own
        editScene(m_bench.study.document, tr("Open scene"), noDrag,
                  [&](scene::Scene &shown) { shown = scene; });
        m_panes.projection->adoptCamera(scene.camera);
    });
}

} // namespace pellucid::ui
