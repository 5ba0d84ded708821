// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/scene/scene.h"

class QImage;

namespace pellucid::ui {

/// *Throws* task::Error with the path and the reason.
scene::Scene readSceneFile(const QString &path);
/// Files that appear only when complete. *Throws* task::Error.
void writeSceneFile(const QString &path, const scene::Scene &scene);
void writePictureFile(const QString &path, const QImage &picture);

} // namespace pellucid::ui
