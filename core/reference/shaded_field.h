// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <glm/mat3x3.hpp>

#include "core/classify/shown_fields.h"
#include "core/scene/camera.h"
#include "core/scene/image_definition.h"
#include "core/shading/slice_shading.h"
#include "core/task/progress.h"

namespace pellucid::reference {

/// The reference for cue and light: a channel's field, shaded sample by sample in double as
/// `shading::Shading` defines, for one view. Its plain image is the exact shaded image. The lattice
/// is larger by one sample on every side, with the same centre. *Shape*: axes are [U V W]; channel
/// 0 to 2 of the lights' colors. *Throws* Error{outOfMemory}, Cancelled.
classify::DensityField shadedField(const classify::DensityField &field,
                                   const shading::Shading &shading, const glm::dmat3 &axes,
                                   int channel, const shading::ShadingScale &scale,
                                   const task::Progress &progress = {});

/// The exact images of a look's channels as a picture: a single image if it is grey, else red,
/// green and blue of each pixel. *Shape*: one image, or three.
std::vector<double> joinedPlanes(std::vector<std::vector<double>> planes,
                                 const classify::ShownFields &fields);

/// The exact picture of a look with cue and light. *Shape*: camera.height x camera.width, times 3
/// if the look or the light has colors. *Throws* Error{outOfMemory}, Cancelled.
std::vector<double> shadedImage(const classify::ShownFields &fields,
                                const shading::Shading &shading, const scene::Camera &camera,
                                const scene::ImageDefinition &image,
                                const task::Progress &progress = {});

} // namespace pellucid::reference
