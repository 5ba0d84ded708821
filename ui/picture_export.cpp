// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/picture_export.h"

#include <algorithm>
#include <cmath>

#include <QCoreApplication>
#include <QImage>
#include <QPainter>

#include "core/files/image_files.h"
#include "core/render/projection_volume.h"
#include "core/task/error.h"
#include "core/volume/nrrd.h"
#include "ui/document.h"
#include "ui/scene_files.h"
#include "ui/views/mpr_view.h"
#include "ui/views/projection_view.h"

namespace pellucid::ui {

namespace {

QString tr(const char *text) {
    return QCoreApplication::translate("PictureExport", text);
}

// From the lower to the upper end of the window in a straight line: figures, not looks.
QImage sixteenBits(const render::ProjectionImage &image, const render::Tone &tone) {
    QImage out(image.width, image.height, QImage::Format_Grayscale16);
    const double scale = 65535.0 / (*tone.high - *tone.low);
    for (int r = 0; r < image.height; ++r) {
        auto *const row = reinterpret_cast<quint16 *>(out.scanLine(r));
        const float *const in = image.samples.data() + std::size_t(r) * std::size_t(image.width);
        for (int c = 0; c < image.width; ++c) {
            const double v = std::clamp((double(in[c]) - *tone.low) * scale, 0.0, 65535.0);
            row[c] = quint16(std::lround(tone.inverted ? 65535.0 - v : v));
        }
    }
    return out;
}

QImage asItLooks(const PictureExport &what, const Panes &panes) {
    if (what.pane != Pane::projection)
        return panes.planes[std::size_t(what.pane)]->picture(what.scale, what.isAnnotated);
    ProjectionView &view = *panes.projection;
    const render::ProjectionImage image = view.imageOfPicture(what.scale);
    const auto rgba = render::compose(image, view.sceneOfPicture(what.scale).tone);
    QImage picture = QImage(rgba.data(), image.width, image.height, QImage::Format_RGBA8888)
                         .convertToFormat(QImage::Format_RGB32);
    picture.setDevicePixelRatio(view.devicePixelRatioF() * what.scale);
    if (what.isAnnotated) {
        QPainter painter(&picture);
        view.paintAnnotations(painter);
    }
    return picture;
}

} // namespace

QWidget *Panes::of(Pane pane) const {
    return pane == Pane::projection ? static_cast<QWidget *>(projection)
                                    : planes[std::size_t(pane)];
}

QString obstacle(const PictureExport &what, const Panes &panes, const Document &document) {
    if (!document.volume())
        return tr("No study is open");
    const bool isPlane = what.pane != Pane::projection;
    if (!isPlane && !panes.projection->showsWhatIsAskedFor())
        return tr("The projection is still being made");
    if (isPlane && what.format != PictureFormat::png)
        return tr("Values are written of the projection only");
    const render::Scene &scene = document.scene();
    const bool isGrey = classify::isGrey(scene.look) && scene.shading.isGrey();
    if (!isGrey && (what.format == PictureFormat::png16 || what.format == PictureFormat::nrrd))
        return tr("A picture in colour has no grey values: write it as it looks, or as NumPy");
    const render::Camera &camera = scene.camera;
    if (std::max(camera.width, camera.height) * what.scale > render::largestImageSize)
        return tr("Pictures have at most %1 pixels a side").arg(render::largestImageSize);
    return {};
}

void writePicture(const PictureExport &what, const Panes &panes, const Document &document,
                  const QString &path) {
    if (const QString why = obstacle(what, panes, document); !why.isEmpty())
        throw task::Error(task::ErrorCode::usage, why.toStdString());
    ProjectionView &view = *panes.projection;
    if (what.format == PictureFormat::png) {
        QImage picture = asItLooks(what, panes);
        picture.setDevicePixelRatio(1.0);
        picture.setText("Comment", "Not for diagnostic use");
        writePictureFile(path, picture);
        return;
    }
    const render::ProjectionImage image = view.imageOfPicture(what.scale);
    const render::Scene scene = view.sceneOfPicture(what.scale);
    if (what.format == PictureFormat::png16)
        writePictureFile(path, sixteenBits(image, scene.tone));
    else if (what.format == PictureFormat::npy)
        files::writeNpy(path.toStdString(), image.samples, image.height, image.width,
                        image.channels);
    else
        volume::writeNrrd(
            path.toStdString(),
            render::projectionVolume(image, scene.camera, document.volume()->lattice()));
}

} // namespace pellucid::ui
