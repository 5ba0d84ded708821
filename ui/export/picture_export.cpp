// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/export/picture_export.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <QDate>
#include <QImage>
#include <QPainter>
#include <QPicture>

#include "core/batch/reasons.h"
#include "core/dicom/write_capture.h"
#include "core/files/atomic_file.h"
#include "core/files/file_set.h"
#include "core/files/image_files.h"
#include "core/files/reasons.h"
#include "core/files/video_file.h"
#include "core/picture/compose.h"
#include "core/picture/projection_volume.h"
#include "core/scene/positioner_angles.h"
#include "core/task/error.h"
#include "core/volume/nrrd.h"
#include "ui/document/document.h"
#include "ui/document/reasons.h"
#include "ui/export/capture_labels.h"
#include "ui/export/reasons.h"
#include "ui/export/scene_files.h"
#include "ui/views/mpr_view.h"
#include "ui/views/projection_view.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;

constexpr int framesPerSecond = 25;

QImage onScreen(const picture::ProjectionImage &image, const picture::Display &display) {
    const auto rgba = picture::compose(image, display);
    return QImage(rgba.data(), image.width, image.height, QImage::Format_RGBA8888)
        .convertToFormat(QImage::Format_RGB32);
}

// Annotations are recorded on the thread of the panes and painted over the picture on another.
// *Units*: logical pixels.
using Annotations = std::shared_ptr<const QPicture>;

template <class Paint> Annotations recorded(bool isWanted, const Paint &paint) {
    auto picture = std::make_shared<QPicture>();
    if (isWanted) {
        QPainter painter(picture.get());
        paint(painter);
    }
    return picture;
}

void putOver(QImage &picture, const Annotations &annotations, double pixelRatio) {
    if (annotations->isNull())
        return;
    picture.setDevicePixelRatio(pixelRatio);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.drawPicture(0, 0, *annotations);
    painter.end();
    picture.setDevicePixelRatio(1.0);
}

// Patient and date of the study; empty if the picture must not name them.
QString patientLine(const PictureExport &what, const dicom::CaptureLabels &labels) {
    if (what.isDeidentified)
        return {};
    const QDate date = QDate::fromString(QString::fromStdString(labels.studyDate), "yyyyMMdd");
    QStringList parts;
    if (!what.patient.isEmpty())
        parts << what.patient;
    if (date.isValid())
        parts << date.toString(Qt::ISODate);
    return parts.join("  ");
}

// `isGrey`: the picture is grey; its annotations then lose their color, as fewer programs read
// captures in color.
QImage captured(const QImage &picture, bool isGrey) {
    return (isGrey ? picture.convertToFormat(QImage::Format_Grayscale8) : picture)
        .convertToFormat(QImage::Format_RGBA8888);
}

// *Requires*: rows of four bytes a pixel, which need no padding.
std::span<const std::uint8_t> bytesOf(const QImage &rgba) {
    return {rgba.constBits(), std::size_t(rgba.sizeInBytes())};
}

void write(const QImage &picture, PictureFormat format, const QString &path,
           const dicom::CaptureLabels &labels, bool isGrey = false) {
    if (format != PictureFormat::capture) {
        QImage commented = picture;
        commented.setText("Comment", "Not for diagnostic use");
        writePictureFile(path, commented);
        return;
    }
    const QImage rgba = captured(picture, isGrey);
    dicom::writeCapture(path.toStdString(), bytesOf(rgba), rgba.height(), rgba.width(), labels);
}

// `seen`: the axes of the picture; `pixelMm`: the size of its pixels.
dicom::CaptureLabels labelsOf(const Document &document, const mpr::Axes &seen, double pixelMm) {
    dicom::CaptureLabels labels = studyLabels(document);
    labels.pixelMm = document.volume()->notes().hasSpacing ? pixelMm : 0.0;
    if (document.volume()->notes().placed)
        labels.patientOrientation = scene::dicomOrientation(seen.right, seen.up);
    return labels;
}

PictureMaker planeMaker(const PictureExport &what, const Panes &panes, const Document &document) {
    const MprView &view = *panes.planes[std::size_t(what.pane)];
    const Names names = what.isDeidentified ? Names::hidden : Names::shown;
    return [make = view.pictureMaker(what.scale), ratio = view.devicePixelRatioF() * what.scale,
            over = recorded(what.isAnnotated, [&](QPainter &painter) {
                view.paintOver(painter, names, patientLine(what, studyLabels(document)));
            })](const task::Progress &progress) {
        QImage picture = make();
        progress.report(0.3);
        putOver(picture, over, ratio);
        return picture;
    };
}

PictureWriter planeWriter(const PictureExport &what, const Panes &panes, const Document &document,
                          const QString &path) {
    const MprView &view = *panes.planes[std::size_t(what.pane)];
    const mpr::Plane plane = view.plane();
    dicom::CaptureLabels labels = labelsOf(document, plane.axes, plane.pixelMm / what.scale);
    labels.seriesDescription = "Plane";
    labels.derivation = "Reformatted plane";
    if (what.isDeidentified)
        labels = dicom::deidentified(labels);
    labels.isNamedInPicture = what.namesPatient();
    return [make = planeMaker(what, panes, document), what, path, labels,
            isGrey = !document.tint()](const task::Progress &progress) {
        write(make(progress), what.format, path, labels, isGrey);
    };
}

// One turn. Each frame has letters and a cube of its own.
struct Turn {
    std::vector<scene::Camera> cameras;
    std::vector<Annotations> over;
};

// DESTINATION_0007.png of DESTINATION.png, as the command line names them.
QString framePath(const QString &path, int frame) {
    const QString stem = path.endsWith(".png", Qt::CaseInsensitive) ? path.chopped(4) : path;
    return stem + "_" + QString::number(frame).rightJustified(4, '0') + ".png";
}

// A picture of the projection, or a turn of it, that any thread can write.
struct ProjectionJob {
    PictureExport what;
    QString path;
    scene::Scene scene;
    std::function<picture::ProjectionImage(const scene::Camera &)> render;
    double ratio; ///< pixels for one logical pixel of the pane
    Turn turn;
    dicom::CaptureLabels labels;
    volume::Lattice lattice;
    bool isGrey;

    QImage picture(std::size_t n) const;
    template <class F> void everyFrame(const task::Progress &progress, const F &add) const;
    void run(const task::Progress &progress) const;
};

QImage ProjectionJob::picture(std::size_t n) const {
    QImage made = onScreen(render(turn.cameras[n]),
                           picture::displayOf(scene.tone, turn.cameras[n].orientation));
    putOver(made, turn.over[n], ratio);
    return made;
}

template <class F>
void ProjectionJob::everyFrame(const task::Progress &progress, const F &add) const {
    for (std::size_t n = 0; n < turn.cameras.size(); ++n) {
        progress.report(double(n) / double(turn.cameras.size()));
        add(picture(n), int(n));
    }
}

void ProjectionJob::run(const task::Progress &progress) const {
    const std::string file = path.toStdString();
    switch (what.format) {
    case PictureFormat::png:
    case PictureFormat::capture:
        write(picture(0), what.format, path, labels, isGrey);
        break;
    case PictureFormat::png16:
        files::writePng16(
            file,
            picture::greyOf(render(scene.camera),
                            picture::plainDisplayOf(scene.tone, scene.camera.orientation),
                            !scene.tone.high),
            scene.camera.height, scene.camera.width);
        break;
    case PictureFormat::npy: {
        const picture::ProjectionImage image = render(scene.camera);
        files::writeNpy(file, image.samples, image.height, image.width, image.channels);
        break;
    }
    case PictureFormat::nrrd:
        volume::writeNrrd(file,
                          picture::projectionVolume(render(scene.camera), scene.camera, lattice));
        break;
    case PictureFormat::frames: {
        files::FileSet frames(file);
        everyFrame(progress, [&](const QImage &frame, int n) {
            const fs::path aside = frames.aside(framePath(path, n).toStdString());
            write(frame, PictureFormat::png, QString::fromStdString(aside.string()), {});
        });
        frames.commit();
        break;
    }
    case PictureFormat::video: {
        files::VideoFile video(file, scene.camera.width, scene.camera.height, framesPerSecond);
        everyFrame(progress, [&](const QImage &frame, int) {
            video.add(bytesOf(frame.convertToFormat(QImage::Format_RGBA8888)), progress);
        });
        video.finish(progress);
        break;
    }
    case PictureFormat::captureLoop: {
        dicom::CaptureLoop loop(int(turn.cameras.size()), scene.camera.height, scene.camera.width,
                                isGrey, 1000.0 / framesPerSecond);
        everyFrame(progress, [&](const QImage &frame, int) {
            progress.check();
            loop.add(bytesOf(captured(frame, isGrey)));
        });
        loop.write(file, labels);
        break;
    }
    }
}

ProjectionJob projectionJob(const PictureExport &what, const Panes &panes, const Document &document,
                            const QString &path) {
    ProjectionView &view = *panes.projection;
    ProjectionJob job{what,
                      path,
                      view.sceneOfPicture(what.scale),
                      view.frames().renderer(),
                      view.devicePixelRatioF() * what.scale,
                      {},
                      {},
                      document.volume()->lattice(),
                      false};
    const scene::Camera &camera = job.scene.camera;
    job.isGrey = classify::isGrey(job.scene.look) && job.scene.shading.isGrey();
    const int count = what.isTurn() ? what.frameCount : 1;
    const Names names = what.isDeidentified ? Names::hidden : Names::shown;
    const dicom::CaptureLabels study = studyLabels(document);
    for (int n = 0; n < count; ++n) {
        const double degrees = 360.0 * n / count;
        job.turn.cameras.push_back(view.turnedAroundPatient(camera, degrees));
        job.turn.over.push_back(
            recorded(what.isAnnotated && what.isPicture(), [&](QPainter &painter) {
                view.paintAnnotations(
                    painter, view.turnedAroundPatient(document.scene().camera, degrees), names);
                drawText(painter, view.rect().adjusted(10, 8, -10, -8),
                         Qt::AlignRight | Qt::AlignTop, patientLine(what, study),
                         overlayColors("accent").text);
            }));
    }
    job.labels = labelsOf(document, {camera.axes()[0], camera.axes()[1]}, camera.pixelMm);
    if (what.isTurn()) {
        job.labels.seriesDescription = "Turntable";
        job.labels.patientOrientation.clear(); // differs from frame to frame
    } else if (document.volume()->notes().placed) {
        const scene::PositionerAngles angles = scene::positionerAngles(camera.orientation);
        job.labels.positionerDeg = {angles.primaryDeg, angles.secondaryDeg};
    }
    if (what.isDeidentified)
        job.labels = dicom::deidentified(job.labels);
    job.labels.isNamedInPicture = what.namesPatient();
    return job;
}

// All files that an export writes.
std::vector<fs::path> targets(const PictureExport &what, const QString &path) {
    std::vector<fs::path> files;
    for (int n = 0; n < (what.format == PictureFormat::frames ? what.frameCount : 0); ++n)
        files.emplace_back(framePath(path, n).toStdString());
    if (files.empty())
        files.emplace_back(path.toStdString());
    return files;
}

} // namespace

QWidget *Panes::of(Pane pane) const {
    return pane == Pane::projection ? static_cast<QWidget *>(projection)
                                    : planes[std::size_t(pane)];
}

Pane Panes::current() const {
    for (const Pane pane : {Pane::axial, Pane::coronal, Pane::sagittal})
        if (of(pane)->hasFocus())
            return pane;
    for (const Pane pane : {Pane::projection, Pane::axial, Pane::coronal, Pane::sagittal})
        if (of(pane)->isVisible())
            return pane;
    return Pane::projection;
}

QString suffixOf(PictureFormat format) {
    switch (format) {
    case PictureFormat::npy:
        return ".npy";
    case PictureFormat::nrrd:
        return ".nrrd";
    case PictureFormat::capture:
    case PictureFormat::captureLoop:
        return ".dcm";
    case PictureFormat::video:
        return ".mp4";
    default:
        return ".png";
    }
}

QString firstFileOf(const PictureExport &what, const QString &path) {
    return what.format == PictureFormat::frames ? framePath(path, 0) : path;
}

std::optional<task::Reason> obstacle(const PictureExport &what, const Panes &panes,
                                     const Document &document) {
    if (!document.volume() || document.currentSource() < 0)
        return because::noStudyIsOpen;
    const bool isPlane = what.pane != Pane::projection;
    if (!isPlane && !panes.projection->showsWhatIsAskedFor())
        return panes.projection->frames().planState() == PlanState::cancelled ||
                       panes.projection->frames().planState() == PlanState::failed
                   ? because::projectionIsNotPrepared
                   : because::projectionIsBeingMade;
    if (isPlane && !what.isPicture())
        return because::valuesOfTheProjectionOnly;
    if (isPlane && what.isTurn())
        return because::onlyTheProjectionTurns;
    if (what.format == PictureFormat::video && !files::VideoFile::isAvailable())
        return because::videosNeedFfmpeg;
    const scene::Scene &scene = document.scene();
    const bool isGrey = classify::isGrey(scene.look) && scene.shading.isGrey();
    if (!isGrey && (what.format == PictureFormat::png16 || what.format == PictureFormat::nrrd))
        return because::colorsHaveNoGreyValues;
    const scene::Camera &camera = scene.camera;
    if (what.format == PictureFormat::captureLoop &&
        dicom::CaptureLoop::bytesOf(what.frameCount, camera.height * what.scale,
                                    camera.width * what.scale,
                                    isGrey) > dicom::CaptureLoop::maxBytes)
        return because::loopIsTooLarge(dicom::CaptureLoop::maxBytes >> 20);
    if (std::max(camera.width, camera.height) * what.scale > scene::largestImageSize)
        return because::picturesHaveAtMost(scene::largestImageSize);
    return {};
}

PictureMaker pictureMaker(const PictureExport &what, const Panes &panes, const Document &document) {
    if (const auto why = obstacle(what, panes, document))
        throw task::Error(task::ErrorCode::usage, *why);
    if (what.pane != Pane::projection)
        return planeMaker(what, panes, document);
    return [job = projectionJob(what, panes, document, {})](const task::Progress &) {
        return job.picture(0);
    };
}

PictureWriter pictureWriter(const PictureExport &what, const Panes &panes, const Document &document,
                            const QString &path) {
    if (const auto why = obstacle(what, panes, document))
        throw task::Error(task::ErrorCode::usage, *why);
    document.requireOther(targets(what, path));
    if (what.pane != Pane::projection)
        return planeWriter(what, panes, document, path);
    return [job = projectionJob(what, panes, document, path)](const task::Progress &progress) {
        job.run(progress);
    };
}

} // namespace pellucid::ui
