// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/prepare/shaded_fields.h"

#include <algorithm>

#include "core/shading/gradient_magnitude.h"

namespace pellucid::prepare {

ShadedFields shadedFields(classify::ShownFields fields, const shading::Shading &shading,
                          const shading::ShadingScale &scale, const task::Progress &progress) {
    if (shading.isLit())
        fields = classify::inPrimaries(std::move(fields), progress);
    ShadedFields result{std::move(fields.channels), {}, scale, fields.colors};
    if (!shading.isLit())
        return result;
    if (!std::all_of(result.fields.begin(), result.fields.end(), shading::holdsGradient))
        for (classify::DensityField &field : result.fields)
            field = shading::grown(field);
    const double count = double(result.fields.size());
    for (const classify::DensityField &field : result.fields) {
        const double done = double(result.gradients.size());
        result.gradients.push_back(shading::gradientMagnitude(
            field, scale.stepMm, progress.part(done / count, (done + 1.0) / count)));
    }
    return result;
}

std::size_t bytesForLight(const shading::Shading &shading, const volume::GridSize &size,
                          std::size_t channels) {
    const volume::GridSize larger{size.i + 2, size.j + 2, size.k + 2};
    // Two fields become three, each with a gradient.
    const std::size_t fields = channels == 2 ? 6 : 2 * channels;
    return shading.isLit() ? fields * larger.count() * sizeof(float) : 0;
}

std::size_t bytesForFields(const classify::Look &look, const shading::Shading &shading,
                           const volume::GridSize &size) {
    return classify::peakBytes(look, size.count()) +
           bytesForLight(shading, size, classify::channelsOf(look));
}

std::vector<field::Summary> summarise(const ShadedFields &fields, const shading::DepthCue &cue) {
    std::vector<classify::DensityField> all = fields.fields;
    all.insert(all.end(), fields.gradients.begin(), fields.gradients.end());
    std::vector<field::Summary> summaries =
        field::summarise(std::span<const classify::DensityField>(all));
    if (cue.hasMoments())
        for (std::size_t n = 0; n < all.size(); ++n)
            summaries[n].slabs = field::slabProducts(all[n].values, summaries[n].support);
    for (field::Summary &summary : summaries)
        summary.depthRadiusMm = fields.scale.radiusMm;
    return summaries;
}

plan::Composition compositionOf(std::size_t fields, const shading::Shading &shading) {
    if (shading.isLit()) // red, green and blue have a field each
        return {fields > 1 || !shading.isGrey() ? 3 : 1, 1};
    return {int(fields), fields == 2 ? 2 : 1};
}

} // namespace pellucid::prepare
