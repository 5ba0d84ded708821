// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/classify/shown_fields.h"
#include "core/picture/projector.h"
#include "core/reference/wide_kernel.h"
#include "core/task/progress.h"

namespace pellucid::reference {

/// The exact pictures of a look, in double precision, for tolerances that no other engine meets.
class ExactEngine final : public picture::Projector {
public:
    /// Without cue and light the spectra of the fields are computed at once; otherwise each picture
    /// shades the fields for its own view. `progress` also cancels pictures. *Throws*
    /// Error{outOfMemory}, Cancelled.
    ExactEngine(classify::ShownFields fields, const shading::Shading &shading,
                const task::Progress &progress = {});

    task::Reason description() const override;
    picture::ProjectionImage render(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading = {},
                                    picture::FrameTimes *times = nullptr) override;

    /// The largest number of bytes held at once, besides the fields, for pictures of this many
    /// images. *Shape*: the box contains all nonzero samples of every field.
    static std::size_t bytes(const volume::Lattice &lattice, const volume::VoxelBox &box,
                             std::size_t images, const scene::Camera &camera,
                             const scene::ImageDefinition &image, const shading::Shading &shading);

private:
    classify::ShownFields m_fields;
    task::Progress m_progress;
    std::vector<WideKernel> m_spectra; ///< of each channel if there is no cue or light, else empty
};

} // namespace pellucid::reference
