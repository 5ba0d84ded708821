// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/scene/scene.h"

class QImage;

namespace pellucid::ui {

/// *Throws* task::Error with the path and the reason.
scene::Scene readSceneFile(const QString &path);
/// Writes a scene as JSON. The file appears only when complete. *Throws* task::Error.
void writeSceneFile(const QString &path, const scene::Scene &scene);
/// Writes a picture as PNG. The file appears only when complete. *Throws* task::Error.
void writePictureFile(const QString &path, const QImage &picture);

} // namespace pellucid::ui
