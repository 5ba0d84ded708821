// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "core/classify/shown_fields.h"
#include "core/error/spot_check.h"
#include "core/render/projection_engine.h"

namespace pellucid::prepare {

/// Makes the fields of a look of the study, at full resolution. It may be called on any thread.
/// *Throws* Error{outOfMemory}, Cancelled.
using StudyFields = std::function<classify::ShownFields(const task::Progress &)>;

/// The camera of the picture whose error is measured: its pixels are no smaller than
/// `scene::finestPixelMm`, because a period of smaller ones might not fit into memory.
scene::Camera checkedCamera(const scene::Camera &camera, const volume::Lattice &lattice);

/// The error of a picture of these fields, measured, see `error::spotCheck`. *Units*: `scale`: that
/// of the study. *Throws* as above.
error::StatedError
measuredError(const StudyFields &study, const shading::ShadingScale &scale,
              const picture::PeriodPicture &period, const scene::ImageDefinition &image,
              const shading::Shading &shading, const error::CheckEffort &effort = {},
              const task::Progress &progress = {},
              const std::function<void(const error::StatedError &)> &refined = {});

/// The same for the picture that an engine makes of these fields, at their own scale. Renders the
/// period with `checkedCamera(camera)`.
error::StatedError measuredError(picture::PeriodProjector &engine,
                                 const classify::ShownFields &study, const scene::Camera &camera,
                                 const scene::ImageDefinition &image,
                                 const shading::Shading &shading = {},
                                 const error::CheckEffort &effort = {},
                                 const task::Progress &progress = {});

} // namespace pellucid::prepare
