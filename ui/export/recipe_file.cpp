// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/export/recipe_file.h"

#include "core/batch/recipe.h"
#include "core/files/atomic_file.h"
#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/export/reasons.h"
#include "ui/views/projection_view.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;

batch::Format formatOf(PictureFormat format) {
    switch (format) {
    case PictureFormat::png:
    case PictureFormat::frames:
        return batch::Format::png;
    case PictureFormat::png16:
        return batch::Format::png16;
    case PictureFormat::npy:
        return batch::Format::npy;
    case PictureFormat::nrrd:
        return batch::Format::nrrd;
    case PictureFormat::capture:
        return batch::Format::capture;
    case PictureFormat::captureLoop:
        return batch::Format::captureLoop;
    case PictureFormat::video:
        return batch::Format::video;
    }
    return batch::Format::png;
}

} // namespace

std::optional<task::Reason> obstacleToRecipe(const PictureExport &what, const Panes &panes,
                                             const Document &document) {
    if (what.pane != Pane::projection)
        return because::recipesAreOfProjections;
    if (auto why = obstacle(what, panes, document))
        return why;
    if (document.volume()->notes().isDifference)
        return because::recipesAreOfOneVolume;
    return std::nullopt;
}

void writeRecipe(const QString &path, const PictureExport &what, const Panes &panes,
                 const Document &document) {
    if (const auto why = obstacleToRecipe(what, panes, document))
        throw task::Error(task::ErrorCode::usage, *why);
    document.requireOther({path.toStdString()});
    const scene::Scene scene = panes.projection->sceneOfPicture(what.scale);
    const presets::Preset look = presets::presetOf("Recipe", scene.look, scene.shading,
                                                   document.fieldWindow(), *document.volume());
    files::AtomicFile file(path.toStdString());
    file.write(batch::recipeOf(scene, look, formatOf(what.format),
                               what.isTurn() ? what.frameCount : 0, what.isDeidentified));
    file.commit();
}

} // namespace pellucid::ui
