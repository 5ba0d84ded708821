// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/export/scene_files.h"

#include <QBuffer>
#include <QImage>

#include "core/files/atomic_file.h"
#include "core/files/read_text.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::ui {

namespace {

using task::Error;
using task::ErrorCode;

} // namespace

scene::Scene readSceneFile(const QString &path) {
    const std::string text = files::readText(path.toStdString(), files::maxSceneBytes);
    try {
        return scene::sceneFromJson(text);
    } catch (const Error &error) {
        throw Error(ErrorCode::unusable, error.reason(), path.toStdString());
    }
}

void writeSceneFile(const QString &path, const scene::Scene &scene) {
    files::AtomicFile file(path.toStdString());
    file.write(scene::toJson(scene));
    file.commit();
}

void writePictureFile(const QString &path, const QImage &picture) {
    QByteArray png;
    QBuffer buffer(&png);
    if (!buffer.open(QIODevice::WriteOnly) || !picture.save(&buffer, "PNG"))
        throw Error(ErrorCode::output,
                    task::because::cannotBeEncoded(buffer.errorString().toStdString()),
                    path.toStdString());
    files::AtomicFile file(path.toStdString());
    file.write({png.constData(), std::size_t(png.size())});
    file.commit();
}

} // namespace pellucid::ui
