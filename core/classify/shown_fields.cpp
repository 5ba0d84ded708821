// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/shown_fields.h"

#include <algorithm>
#include <array>

#include "core/classify/value_curve.h"
#include "core/task/error.h"

namespace pellucid::classify {

namespace {

// The most memory that running steps needs, in floats per sample: edges hold the smoothed values,
// their second derivative and its zero crossings, besides the memory for smoothing.
constexpr std::size_t stepFloats = 6;

std::function<double(double)> shapeOf(const std::optional<TransferFunction> &function) {
    if (!function || function->isPlain())
        return {};
    return [f = *function](double density) { return f.at(density); };
}

WeightedCurve curveOf(const TissueClass &tissue, const FieldWindow &window, DensityKind density,
                      bool oneColor) {
    const double w = tissue.weight;
    const Color &c = tissue.color;
    return {ValueCurve(window, density, tissue, shapeOf(tissue.transferFunction)),
            oneColor ? std::array{w, w, w} : std::array{w * c.red, w * c.green, w * c.blue}};
}

// The sums of the classes. All classes without steps share one pass over the volume.
void addClasses(const volume::Volume &volume, const FieldWindow &window,
                const std::vector<TissueClass> &shown, bool oneColor, StepRunner *runner,
                std::vector<std::vector<float>> &sums, const task::Progress &progress) {
    std::vector<WeightedCurve> together;
    double done = 0.0;
    for (const TissueClass &tissue : shown) {
        if (tissue.steps.empty()) {
            together.push_back(curveOf(tissue, window, DensityKind::window, oneColor));
            continue;
        }
        const double next = done + 0.9 / double(shown.size());
        const ClassSamples samples = samplesOf(volume, tissue, runner, progress.part(done, next));
        const WeightedCurve curve = curveOf(tissue, window, samples.density, oneColor);
        addCurves(samples.values, samples.regions.get(), {&curve, 1}, sums);
        done = next;
    }
    if (!together.empty())
        addCurves(volume, nullptr, together, sums, progress.part(done, 1.0));
}

} // namespace

ClassSamples samplesOf(const volume::Volume &volume, const TissueClass &tissue, StepRunner *runner,
                       const task::Progress &progress) {
    if (tissue.steps.empty())
        return {volume, DensityKind::window, nullptr};
    if (runner == nullptr)
        throw task::Error(task::ErrorCode::usage, task::because::stepsCannotRun(tissue.name));
    return runner->run(volume, tissue, progress);
}

std::size_t peakBytes(const Look &look, std::size_t samples) {
    const auto shown = visibleClasses(look);
    const bool hasSteps = std::any_of(shown.begin(), shown.end(), [](const TissueClass &tissue) {
        return !tissue.steps.empty();
    });
    const std::size_t floats =
        (mixesColors(look) ? 3 : 1) + (hasSteps ? stepFloats : std::size_t(0));
    return floats * samples * sizeof(float);
}

ShownFields shownFields(const volume::Volume &volume, const FieldWindow &window, const Look &look,
                        StepRunner *runner, const task::Progress &progress) {
    if (look.classes.empty() && look.transferFunction.isPlain())
        return {{densityField(volume, window, progress)}, {}};
    const std::vector<TissueClass> shown = visibleClasses(look);
    const bool oneColor = !mixesColors(look);
    ShownFields result;
    task::orOutOfMemory(task::because::noMemoryForTheClassFields, [&] {
        std::vector<std::vector<float>> sums(
            oneColor ? 1 : 3, std::vector<float>(volume.lattice().size().count(), 0.0F));
        if (look.classes.empty()) {
            const WeightedCurve curve{ValueCurve(window, DensityKind::window, std::nullopt,
                                                 shapeOf(look.transferFunction))};
            addCurves(volume, nullptr, {&curve, 1}, sums, progress);
        } else {
            addClasses(volume, window, shown, oneColor, runner, sums, progress);
        }
        for (auto &samples : sums)
            result.channels.push_back(fieldOf(volume, std::move(samples)));
    });
    if (oneColor && !shown.empty())
        result.color = shown.front().color;
    return result;
}

DensityField classField(const volume::Volume &volume, const FieldWindow &window,
                        const TissueClass &tissue, StepRunner *runner,
                        const task::Progress &progress) {
    TissueClass plain = tissue;
    plain.weight = 1.0;
    return shownFields(volume, window, {{}, {plain}}, runner, progress).channels.front();
}

} // namespace pellucid::classify
