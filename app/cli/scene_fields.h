// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "core/classify/shown_fields.h"
#include "core/presets/preset.h"
#include "core/scene/scene.h"
#include "core/segment/segment_set.h"

namespace pellucid::cli {

/// The window of a scene's field: its own, or the volume's default.
classify::FieldWindow windowFor(const scene::Scene &scene, const volume::Volume &volume);

/// The cropped fields of a volume that a scene shows. `segments`: null if none are loaded. The
/// results of steps are not kept. *Throws* Error{outOfMemory}, Cancelled.
classify::ShownFields fieldsFor(const scene::Scene &scene, const volume::Volume &volume,
                                const std::shared_ptr<const segment::SegmentSet> &segments,
                                const Context &context);

/// Warnings about options that contradict each other or do not suit the volume, a line each.
std::vector<std::string> lookWarnings(const CLI::App &command,
                                      const std::optional<presets::Preset> &preset,
                                      const scene::Scene &scene, const volume::Volume &volume);

/// Why all fields are empty, one line; an empty text if one is not.
std::string whyEmpty(const scene::Scene &scene, const volume::Volume &volume,
                     const classify::ShownFields &fields);

} // namespace pellucid::cli
