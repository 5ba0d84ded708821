// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/file_actions.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <QClipboard>
#include <QDateTime>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLocale>
#include <QPrintDialog>
#include <QPrinter>

#include "core/scene/reasons.h"
#include "core/task/error.h"
#include "ui/beside/study_pair.h"
#include "ui/dialogs/export_dialog.h"
#include "ui/dialogs/header_dialog.h"
#include "ui/dialogs/import_dialog.h"
#include "ui/dialogs/subtraction_dialog.h"
#include "ui/document/commands.h"
#include "ui/export/print_picture.h"
#include "ui/export/scene_files.h"
#include "ui/export/segment_writer.h"
#include "ui/opening/reasons.h"
#include "ui/settings/file_dialogs.h"
#include "ui/views/projection_view.h"
#include "ui/widgets/dialog_place.h"
#include "ui/window/workbench.h"

namespace pellucid::ui {

namespace {

Panes panesOf(const Viewer &viewer) {
    return {viewer.planes, viewer.projection};
}

} // namespace

FileActions::FileActions(QWidget &window, Workbench &bench, StudyPair &pair)
    : QObject(&window), m_window(window), m_bench(bench), m_pair(pair) {}

void FileActions::chooseFiles() {
    m_bench.study.opener.openPaths(askForFiles(&m_window, tr("Open files")));
}

void FileActions::chooseSegmentations() {
    m_bench.study.segments.open(askForFiles(&m_window, tr("Open segmentation")));
}

void FileActions::chooseSubtrahend() {
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
                    m_pair.openBeside(minuend);
                else if (beside == BesideDifference::alignedSubtrahend)
                    m_pair.openBeside(alignedSource(minuend, subtrahend, alignment));
            });
    dialog->open();
}

void FileActions::chooseFolder() {
    const QString folder = askForFolder(&m_window, tr("Open folder"));
    if (!folder.isEmpty())
        m_bench.study.opener.openPaths({folder});
}

void FileActions::importPaths(const QStringList &paths) {
    auto *dialog = new ImportDialog(paths, &m_window);
    connect(dialog, &ImportDialog::chosen, this,
            [this](const Import &import) { m_bench.library.import(import); });
    dialog->open();
}

void FileActions::reportSaved(const QString &path) {
    m_bench.notices.say(tr("Saved: %1").arg(QFileInfo(path).fileName()));
}

void FileActions::savePicture() {
    m_bench.notices.attempt([&] {
        const QImage picture = projection().picture();
        if (picture.isNull()) {
            m_bench.notices.say(tr("There is no projection to save yet"));
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

void FileActions::exportPicture() {
    // Not modal: the user may still adjust the view for the export.
    showOnly<ExportDialog>(m_window, [this] {
        auto *dialog = new ExportDialog(m_bench.study.document, panesOf(m_pair.open()),
                                        m_bench.exports, m_bench.servers, &m_window);
        connect(dialog, &ExportDialog::written, this, &FileActions::reportSaved);
        connect(dialog, &ExportDialog::sent, this, [this](const QString &server) {
            m_bench.notices.say(tr("Sent to %1").arg(server));
        });
        connect(dialog, &ExportDialog::captured, this,
                [this](const std::shared_ptr<const dicom::Catalogue> &capture) {
                    m_bench.study.document.addSources(sourcesFrom(capture));
                });
        return dialog;
    });
}

ProjectionView &FileActions::projection() const {
    return *m_pair.open().projection;
}

void FileActions::copyPicture() {
    withPicture(1, tr("Copying the picture"), [this](const QImage &picture) {
        QGuiApplication::clipboard()->setImage(picture);
        m_bench.notices.say(tr("Copied the picture"));
    });
}

void FileActions::printPicture() {
    const Document &document = m_pair.focused().document;
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
                    m_bench.notices.say(print(page, *printer) ? tr("Sent to the printer")
                                                              : tr("The printer is not available"));
                });
        // The dialog refers to the printer as long as it exists.
        connect(dialog, &QObject::destroyed, this, [printer] {});
        dialog->open();
    });
}

void FileActions::withPicture(int scale, const QString &title,
                              const std::function<void(const QImage &)> &use) {
    PictureExport what;
    const Panes panes = panesOf(m_pair.focused());
    what.pane = panes.current();
    what.scale = scale;
    if (m_bench.exports.isRunning()) { // another job would cancel it
        m_bench.notices.say(
            tr("An export is running: wait until it ends before you copy or print"));
        return;
    }
    m_bench.notices.attempt([&] {
        m_bench.exports.start(
            title,
            [make = pictureMaker(what, panes, m_pair.focused().document), use](const Job &job) {
                const QImage picture = make(job.progress());
                job.deliver([picture, use] { use(picture); });
            },
            [this](const Outcome &outcome) {
                if (outcome.kind == Outcome::Kind::failed)
                    m_bench.notices.report(*outcome.reason, outcome.path);
            });
    });
}

// In the order of the slices, if every file is a slice.
QStringList FileActions::headerFiles() const {
    const Document &document = m_pair.focused().document;
    const int open = document.currentSource();
    if (open < 0 || !document.volume())
        return {};
    const StudySource &source = document.sources()[std::size_t(open)];
    if (!source.phantom.isEmpty() || !source.volume.file.isEmpty() || source.difference)
        return {};
    return int(source.slices.size()) == document.volume()->lattice().size().k ? source.slices
                                                                              : source.files;
}

void FileActions::showHeader() {
    const QStringList files = headerFiles();
    if (files.isEmpty())
        return;
    const Document &document = m_pair.focused().document;
    const QStringList &slices = document.sources()[std::size_t(document.currentSource())].slices;
    const double slice = document.volume()->lattice().voxel(document.crosshair()).v.z;
    const auto file = files.indexOf(slices.value(int(std::lround(slice))));
    auto *dialog = new HeaderDialog(files, int(std::max<qsizetype>(0, file)), &m_window);
    dialog->show();
}

void FileActions::exportMeasurements() {
    if (m_bench.study.document.measured().empty()) {
        m_bench.notices.say(tr("There are no measurements to export yet"));
        return;
    }
    const QString path = askForSavePath(&m_window, tr("Export measurements"), "measurements.csv",
                                        tr("Table (*.csv)"));
    if (path.isEmpty())
        return;
    m_bench.notices.attempt([&] {
        m_bench.study.document.requireOther({path.toStdString()});
        m_bench.measurements.exportTable(path);
        reportSaved(path);
    });
}

void FileActions::saveScene() {
    if (!projection().showsWhatIsAskedFor()) {
        m_bench.notices.say(tr("There is no projection of this scene yet"));
        return;
    }
    const QString path =
        askForSavePath(&m_window, tr("Save scene"), "scene.json", tr("Scene (*.json)"));
    if (path.isEmpty())
        return;
    m_bench.notices.attempt([&] {
        m_bench.study.document.requireOther({path.toStdString()});
        writeSceneFile(path, projection().sceneOfPicture());
        reportSaved(path);
    });
}

void FileActions::saveSegments() {
    const Document &document = m_bench.study.document;
    if (!document.volume() || document.isPreview() ||
        classify::visibleClasses(document.scene().look).empty()) {
        m_bench.notices.say(tr("There are no classes to save yet"));
        return;
    }
    const QString path =
        askForSavePath(&m_window, tr("Save classes as segmentation"), "segmentation.dcm",
                       tr("DICOM segmentation (*.dcm);;Labels (*.nrrd)"));
    if (path.isEmpty())
        return;
    m_bench.notices.attempt([&] {
        m_bench.exports.start(
            tr("Writing %1").arg(QFileInfo(path).fileName()),
            [this, path, write = segmentWriter(document, path)](const Job &job) {
                const QStringList empty = write(job.progress());
                job.deliver([this, path, empty] {
                    reportSaved(path);
                    if (!empty.isEmpty())
                        m_bench.notices.say(tr("Saved: %1; these classes are empty: %2")
                                                .arg(QFileInfo(path).fileName(), empty.join(", ")));
                });
            },
            [this, path](const Outcome &outcome) {
                if (outcome.kind == Outcome::Kind::failed)
                    m_bench.notices.report(*outcome.reason, outcome.path);
            },
            path);
    });
}

void FileActions::openScene() {
    const QString path = askForFile(&m_window, tr("Open scene"), tr("Scene (*.json)"));
    if (path.isEmpty())
        return;
    m_bench.notices.attempt([&] {
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
        projection().adoptCamera(scene.camera);
    });
}

} // namespace pellucid::ui
