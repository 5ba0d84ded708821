// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/layers.h"

#include "core/classify/shown_fields.h"
#include "core/classify/value_curve.h"
#include "core/task/error.h"

namespace pellucid::classify {

Mixture mixtureOf(const Look &look) {
    Mixture mixture;
    if (look.classes.empty()) {
        const auto &weights = look.transferFunction.weights;
        for (std::size_t n = 0; n < weights.size(); ++n) {
            mixture.layers.push_back({{}, int(n), look.transferFunction.degree()});
            mixture.channelWeights.push_back({weights[n], weights[n], weights[n]});
        }
        return mixture;
    }
    for (TissueClass tissue : look.classes) {
        const double w = tissue.weight;
        const Color c = tissue.color;
        mixture.channelWeights.push_back({w * c.red, w * c.green, w * c.blue});
        // Weight, color and name do not change its samples.
        tissue.weight = 1.0;
        tissue.color = {};
        tissue.name = "class";
        mixture.layers.push_back({tissue, -1, 0});
    }
    return mixture;
}

DensityField layerField(const volume::Volume &volume, const FieldWindow &window, const Layer &layer,
                        StepRunner *runner, const task::Progress &progress) {
    if (layer.index < 0)
        return classField(volume, window, layer.tissue, runner, progress);
    const WeightedCurve curve{ValueCurve(window, DensityKind::window, std::nullopt, [&](double f) {
        return bernstein(layer.index, layer.degree, f);
    })};
    return task::orOutOfMemory(task::because::noMemoryForABasisField, [&] {
        std::vector<std::vector<float>> sums(
            1, std::vector<float>(volume.lattice().size().count(), 0.0F));
        addCurves({volume}, {&curve, 1}, sums, progress);
        return fieldOf(volume, std::move(sums.front()));
    });
}

} // namespace pellucid::classify
