// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/classify/shown_fields.h"
#include "core/picture/projector.h"
#include "core/plan/render_plan.h"
#include "core/render/frame_geometry.h"
#include "core/render/view_spectrum.h"

namespace pellucid::render {

/// Renders a few views without a spectrum of the volume: it sums the samples along each view. No
/// cue, no light. The bits do not depend on the number of threads.
class SumEngine final : public picture::PeriodProjector {
public:
    /// The engine holds the fields. `progress` cancels pictures. *Shape*: the box of the plan holds
    /// all nonzero samples.
    SumEngine(classify::ShownFields fields, const plan::RenderPlan &plan,
              const task::Progress &progress = {});
    ~SumEngine() override;

    const classify::ShownFields &fields() const { return m_fields; }

    task::Reason description() const override;
    /// *Requires*: plain shading.
    picture::ProjectionImage render(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading = {},
                                    picture::FrameTimes *times = nullptr) override;

protected:
    scene::Camera periodOf(const scene::Camera &camera,
                           const scene::ImageDefinition &image) override;

private:
    const volume::Lattice &lattice() const { return m_fields.channels.front().values.lattice(); }

    classify::ShownFields m_fields;
    volume::VoxelBox m_box;
    plan::FieldOfView m_fieldOfView;
    task::Progress m_progress;
    FramedGrid m_framed;
    /// What pictures of one direction, pixel and definition share.
    struct View;
    const View &viewFor(const scene::Camera &camera, const scene::ImageDefinition &image);
    /// The slice of a channel, transformed on the whole period.
    std::vector<float> plane(const View &view, std::size_t channel, const scene::Camera &camera,
                             const plan::SliceGrid &grid) const;
    std::unique_ptr<View> m_view; ///< the last one
};

} // namespace pellucid::render
