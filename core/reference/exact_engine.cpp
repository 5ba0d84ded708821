// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reference/exact_engine.h"

#include <chrono>
#include <utility>

#include "core/reference/reasons.h"
#include "core/reference/shaded_field.h"

namespace pellucid::reference {

ExactEngine::ExactEngine(classify::ShownFields fields, const shading::Shading &shading,
                         const task::Progress &progress)
    : m_fields(shading.isLit() ? classify::inPrimaries(std::move(fields), progress)
                               : std::move(fields)),
      m_progress(progress) {
    if (shading.isPlain())
        for (const classify::DensityField &field : m_fields.channels)
            m_spectra.emplace_back(field.values, field.support, m_progress);
}

task::Reason ExactEngine::description() const {
    return task::because::exactReference;
}

picture::ProjectionImage ExactEngine::render(const scene::Camera &camera,
                                             const scene::ImageDefinition &image,
                                             const shading::Shading &shading,
                                             picture::FrameTimes *times) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    std::vector<double> exact;
    if (m_spectra.empty() || !shading.isPlain()) {
        exact = shadedImage(m_fields, shading, camera, image, m_progress);
    } else {
        std::vector<std::vector<double>> planes;
        for (const WideKernel &spectrum : m_spectra)
            planes.push_back(spectrum.image(camera, image));
        exact = joinedPlanes(std::move(planes), m_fields);
    }
    const bool isGrey = m_fields.isGrey() && shading.isGrey();
    picture::ProjectionImage result{
        camera.width, camera.height, camera.pixelMm, {exact.begin(), exact.end()}, isGrey ? 1 : 3};
    if (times != nullptr)
        *times = {std::chrono::duration<double, std::milli>(Clock::now() - start).count(), 0.0};
    return result;
}

std::size_t ExactEngine::bytes(const volume::Lattice &lattice, const volume::VoxelBox &box,
                               std::size_t images, const scene::Camera &camera,
                               const scene::ImageDefinition &image,
                               const shading::Shading &shading) {
    const std::size_t imageBytes =
        images * (WideKernel::bytes(box) + sliceBytes(lattice, camera, image));
    // The enlarged field and its shaded copy; two colors are mixed to fields of three.
    const std::size_t copies = images == 2 ? 5 : 2,
                      shadingBytes =
                          shading.isPlain() ? 0 : copies * lattice.size().count() * sizeof(float);
    return imageBytes + shadingBytes;
}

} // namespace pellucid::reference
