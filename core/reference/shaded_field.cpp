// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reference/shaded_field.h"

#include <algorithm>
#include <array>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/reference/reasons.h"
#include "core/reference/wide_kernel.h"
#include "core/shading/gradient_magnitude.h"
#include "core/task/error.h"

namespace pellucid::reference {

classify::DensityField shadedField(const classify::DensityField &field,
                                   const shading::Shading &shading, const glm::dmat3 &axes,
                                   int channel, const shading::ShadingScale &scale,
                                   const task::Progress &progress) {
    const classify::DensityField larger = shading::grown(field);
    const volume::Lattice &lattice = larger.values.lattice();
    const volume::GridSize size = lattice.size();
    const glm::dvec3 center = lattice.center().mm;
    const auto cue = shading::cueFunction(shading.cue);
    struct Pole {
        glm::dvec3 direction; // LPS
        double intensity;
    };
    std::vector<Pole> poles;
    for (const shading::Light &light : shading.lights) {
        const glm::dvec3 along = glm::normalize(light.direction);
        const double color = channel == 0   ? light.color.red
                             : channel == 1 ? light.color.green
                                            : light.color.blue;
        poles.push_back({light.frame == shading::LightFrame::viewer ? axes * along : along,
                         light.strength * color});
    }
    return task::orOutOfMemory(task::because::noMemoryForTheExactShadedField, [&] {
        std::vector<float> samples(size.count(), 0.0F);
        tbb::parallel_for(0, size.k, [&](int k) {
            progress.check();
            for (int j = 0; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i) {
                    const volume::VoxelIndex n{i, j, k};
                    double shaded = shading.ambient * larger.values.value(n);
                    if (!poles.empty()) {
                        const glm::dvec3 g = shading::gradientAt(larger.values, n, scale.stepMm);
                        for (const Pole &pole : poles)
                            shaded += 0.5 * pole.intensity *
                                      (glm::length(g) - glm::dot(g, pole.direction));
                    }
                    if (shaded == 0.0)
                        continue;
                    const double depth =
                        glm::dot(axes[2], lattice.patient(n).mm - center) / scale.radiusMm;
                    samples[(std::size_t(k) * size.j + j) * size.i + i] =
                        float(cue(depth) * shaded);
                }
        });
        return classify::fieldOf(larger.values, std::move(samples));
    });
}

std::vector<double> joinedPlanes(std::vector<std::vector<double>> planes,
                                 const classify::ShownFields &fields) {
    if (planes.size() == 1 && fields.isGrey())
        return std::move(planes.front());
    const std::size_t pixels = planes.front().size();
    const auto componentsOf = [&](std::size_t field) {
        const classify::Color &color = fields.colors[field];
        return std::array{color.red, color.green, color.blue};
    };
    std::vector<double> result(3 * pixels, 0.0);
    for (std::size_t n = 0; n < pixels; ++n)
        if (planes.size() > fields.channels.size()) // one field in colored light
            for (std::size_t c = 0; c < 3; ++c)
                result[3 * n + c] = componentsOf(0)[c] * planes[c][n];
        else
            for (std::size_t p = 0; p < planes.size(); ++p)
                for (std::size_t c = 0; c < 3; ++c)
                    result[3 * n + c] += componentsOf(p)[c] * planes[p][n];
    return result;
}

std::vector<double> shadedImage(const classify::ShownFields &shown, const shading::Shading &shading,
                                const scene::Camera &camera, const scene::ImageDefinition &image,
                                const task::Progress &progress) {
    const auto scale = shading::shadingScale(shown.channels.front().values.lattice());
    // Light is not linear in the fields: it shades those of red, green and blue.
    const classify::ShownFields fields =
        shading.isLit() ? classify::inPrimaries(shown, progress) : shown;
    std::vector<std::vector<double>> planes;
    // The channels of a field in grey light differ only by its color.
    const std::size_t count = shading.isGrey() ? fields.channels.size() : std::size_t(3);
    for (std::size_t c = 0; c < count; ++c) {
        const auto shaded = shadedField(fields.channels[std::min(c, fields.channels.size() - 1)],
                                        shading, camera.axes(), int(c), scale, progress);
        planes.push_back(WideKernel(shaded.values, shaded.support, progress).image(camera, image));
    }
    return joinedPlanes(std::move(planes), fields);
}

} // namespace pellucid::reference
