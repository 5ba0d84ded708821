// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shading/slice_shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace pellucid::shading {

ShadingScale shadingScale(const volume::Lattice &lattice) {
    return {lattice.radiusMm(), lattice.shortestStepMm()};
}

bool SliceShading::isPlain() const {
    return terms.size() == 1 && terms.front().weight == 1.0 && slope == 0.0 &&
           std::all_of(channels.begin(), channels.end(),
                       [](const Channel &channel) { return channel == Channel(); });
}

bool SliceShading::isGrey() const {
    return channels[0] == channels[1] && channels[1] == channels[2];
}

SliceShading sliceShading(const Shading &shading, const glm::dmat3 &axes,
                          const ShadingScale &scale) {
    SliceShading result;
    const DepthCue &cue = shading.cue;
    const double quarter = 0.25 / scale.radiusMm; // a quarter wave per radius
    // weight cos(2 pi offset (W.x) + turn) as two exponentials.
    const auto addCosine = [&](double weight, double offset, double turn) {
        result.terms.push_back({offset, 0.5 * weight * std::polar(1.0, -turn)});
        result.terms.push_back({-offset, 0.5 * weight * std::polar(1.0, turn)});
    };
    if (cue.isActive()) {
        switch (cue.kind) {
        case CueKind::none:
            break;
        case CueKind::linear:
            result.slope = cue.strength / scale.radiusMm;
            break;
        case CueKind::sine: // a cosine shifted by a quarter turn
            addCosine(cue.strength, quarter, -0.5 * std::numbers::pi);
            break;
        case CueKind::curve: {
            const std::vector<double> cosines = cosinesOf(cue.curve);
            result.terms.front().weight = 1.0 + cue.strength * (cosines.front() - 1.0);
            for (std::size_t k = 1; k < cosines.size(); ++k)
                if (cosines[k] != 0.0)
                    addCosine(cue.strength * cosines[k], double(k) * quarter,
                              0.5 * std::numbers::pi * double(k));
            break;
        }
        }
    }
    for (auto &channel : result.channels)
        channel.ambient = shading.ambient;
    for (const Light &light : shading.lights) {
        const glm::dvec3 along = glm::normalize(light.direction);
        const glm::dvec3 direction = light.frame == LightFrame::viewer ? axes * along : along;
        const std::array<double, 3> color{light.color.red, light.color.green, light.color.blue};
        for (std::size_t c = 0; c < color.size(); ++c) {
            const double half = 0.5 * light.strength * color[c];
            result.channels[c].magnitude += half;
            // The gradient points into dense matter, away from the light that its surface faces.
            result.channels[c].gradient -= half * direction;
        }
    }
    return result;
}

} // namespace pellucid::shading
