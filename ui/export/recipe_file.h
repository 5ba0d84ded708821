// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <QString>

#include "core/task/reason.h"
#include "ui/export/picture_export.h"

namespace pellucid::ui {

/// Why no recipe can be made of an export; none if one can.
std::optional<task::Reason> obstacleToRecipe(const PictureExport &what, const Panes &panes,
                                             const Document &document);
/// Writes a recipe that exports the same of other studies, on the command line. The file appears
/// only when complete. *Throws* Error{usage} with the obstacle, Error{output}.
void writeRecipe(const QString &path, const PictureExport &what, const Panes &panes,
                 const Document &document);

} // namespace pellucid::ui
