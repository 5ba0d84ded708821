// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/prepare/measured_error.h"

namespace pellucid::prepare {

scene::Camera checkedCamera(const scene::Camera &camera, const volume::Lattice &lattice) {
    return scene::withPixelsAtLeast(camera, scene::finestPixelMm(lattice));
}

error::StatedError measuredError(const StudyFields &study, const shading::ShadingScale &scale,
                                 const picture::PeriodPicture &period,
                                 const scene::ImageDefinition &image,
                                 const shading::Shading &shading, const error::CheckEffort &effort,
                                 const task::Progress &progress,
                                 const std::function<void(const error::StatedError &)> &refined) {
    const classify::ShownFields fields = study(progress);
    const error::ShownRows rows(fields.channels, render::channelWeightsOf(fields), shading,
                                period.camera.axes(), scale);
    return error::spotCheck(period, image, rows, effort, progress, refined);
}

error::StatedError measuredError(picture::PeriodProjector &engine,
                                 const classify::ShownFields &study, const scene::Camera &camera,
                                 const scene::ImageDefinition &image,
                                 const shading::Shading &shading, const error::CheckEffort &effort,
                                 const task::Progress &progress) {
    const volume::Lattice &lattice = study.channels.front().values.lattice();
    return measuredError([&](const task::Progress &) { return study; },
                         shading::shadingScale(lattice),
                         engine.renderPeriod(checkedCamera(camera, lattice), image, shading), image,
                         shading, effort, progress);
}

} // namespace pellucid::prepare
