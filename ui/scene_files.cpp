// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_files.h"

#include <QCoreApplication>
#include <QFile>
#include <QImage>
#include <QSaveFile>

#include "core/task/error.h"

namespace pellucid::ui {

namespace {

using task::Error;
using task::ErrorCode;

template <class Write> void save(const QString &path, const Write &write) {
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly) || !write(file) || !file.commit())
        throw Error(ErrorCode::output,
                    QCoreApplication::translate("SceneFiles", "cannot be written: %1")
                        .arg(file.errorString())
                        .toStdString(),
                    path.toStdString());
}

} // namespace

render::Scene readSceneFile(const QString &path) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        throw Error(ErrorCode::unusable, file.errorString().toStdString(), path.toStdString());
    try {
        return render::sceneFromJson(file.readAll().toStdString());
    } catch (const Error &error) {
        throw Error(error.code(), error.reason(), path.toStdString());
    }
}

void writeSceneFile(const QString &path, const render::Scene &scene) {
    const QByteArray text = QByteArray::fromStdString(render::toJson(scene));
    save(path, [&](QSaveFile &file) { return file.write(text) == text.size(); });
}

void writePictureFile(const QString &path, const QImage &picture) {
    save(path, [&](QSaveFile &file) { return picture.save(&file, "PNG"); });
}

} // namespace pellucid::ui
