// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/layers.h"

#include <utility>

#include "core/classify/reasons.h"
#include "core/classify/shown_fields.h"
#include "core/classify/value_curve.h"
#include "core/task/error.h"

namespace pellucid::classify {

namespace {

// Weight, color and name do not change its samples.
Layer alone(TissueClass tissue) {
    tissue.weight = 1.0;
    tissue.color = {};
    tissue.name = "class";
    return {std::move(tissue), -1, 0, 0.0, 1.0, {}, 0};
}

std::array<double, 3> weightsOf(const TissueClass &tissue) {
    const double w = tissue.weight;
    const Color &c = tissue.color;
    return {w * c.red, w * c.green, w * c.blue};
}

Mixture termsOf(const TransferFunction &function) {
    Mixture mixture;
    const auto &weights = function.weights;
    for (std::size_t n = 0; n < weights.size(); ++n) {
        mixture.layers.push_back(
            {{}, int(n), function.degree(), function.low, function.high, {}, 0});
        mixture.channelWeights.push_back({weights[n], weights[n], weights[n]});
    }
    return mixture;
}

} // namespace

Mixture mixtureOf(const Look &source, std::optional<std::size_t> adjusted) {
    if (source.classes.empty())
        return termsOf(source.transferFunction);
    const Look look{source.transferFunction, withOperands(source)};
    Mixture mixture;
    const auto add = [&](const TissueClass &tissue) {
        mixture.layers.push_back(alone(tissue));
        mixture.channelWeights.push_back(weightsOf(tissue));
    };
    if (look.classes.size() <= maxLayers) {
        for (const TissueClass &tissue : look.classes)
            add(tissue);
        return mixture;
    }
    Look others = look;
    if (adjusted && *adjusted < look.classes.size()) {
        add(look.classes[*adjusted]);
        others.classes.erase(others.classes.begin() + std::ptrdiff_t(*adjusted));
    }
    others.classes = visibleClasses(others);
    for (TissueClass &tissue : others.classes)
        tissue.name = "class";
    if (others.classes.empty())
        return mixture;
    const ColorBasis basis = colorBasisOf(others);
    for (std::size_t c = 0; c < basis.colors.size(); ++c) {
        mixture.layers.push_back({{}, -1, 0, 0.0, 1.0, others.classes, int(c)});
        mixture.channelWeights.push_back(basis.colors[c]);
    }
    return mixture;
}

std::optional<std::size_t> onlyDifference(const Look &a, const Look &b) {
    if (a.classes.size() != b.classes.size() || a.transferFunction != b.transferFunction)
        return std::nullopt;
    std::optional<std::size_t> difference;
    for (std::size_t n = 0; n < a.classes.size(); ++n) {
        if (a.classes[n] == b.classes[n])
            continue;
        if (difference)
            return std::nullopt;
        difference = n;
    }
    return difference;
}

DensityField layerField(const volume::Volume &volume, const FieldWindow &window, const Layer &layer,
                        StepRunner *runner, const task::Progress &progress) {
    if (!layer.sum.empty())
        return shownFields(volume, window, {{}, layer.sum}, runner, progress)
            .channels[std::size_t(layer.channel)];
    if (layer.index < 0)
        return classField(volume, window, layer.tissue, runner, progress);
    TransferFunction basis{std::vector<double>(std::size_t(layer.degree) + 1, 0.0), layer.low,
                           layer.high};
    basis.weights[std::size_t(layer.index)] = 1.0;
    const WeightedCurve curve{ValueCurve(
        window, DensityKind::window, std::nullopt, [&](double f) { return basis.at(f); },
        layer.high - layer.low)};
    return task::orOutOfMemory(task::because::noMemoryForABasisField, [&] {
        std::vector<std::vector<float>> sums(
            1, std::vector<float>(volume.lattice().size().count(), 0.0F));
        addCurves({volume}, {&curve, 1}, sums, progress);
        return fieldOf(volume, std::move(sums.front()));
    });
}

LayerFields::LayerFields(volume::Volume volume, const FieldWindow &window, Mixture mixture,
                         StepRunner *runner)
    : m_volume(std::move(volume)), m_window(window), m_mixture(std::move(mixture)),
      m_runner(runner) {}

DensityField LayerFields::field(std::size_t n, const task::Progress &progress) {
    const Layer &layer = m_mixture.layers[n];
    if (layer.sum.empty())
        return layerField(m_volume, m_window, layer, m_runner, progress);
    if (m_channels.empty())
        m_channels = shownFields(m_volume, m_window, {{}, layer.sum}, m_runner, progress).channels;
    DensityField made = std::exchange(m_channels[std::size_t(layer.channel)], {});
    if (n + 1 == m_mixture.layers.size())
        m_channels.clear();
    return made;
}

} // namespace pellucid::classify
