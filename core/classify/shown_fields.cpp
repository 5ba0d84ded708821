// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/shown_fields.h"

#include <algorithm>
#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/classify/reasons.h"
#include "core/classify/value_curve.h"
#include "core/task/error.h"

namespace pellucid::classify {

namespace {

// Whether a look shows the density itself.
bool isDensity(const Look &look) {
    return look.classes.empty() && look.transferFunction.isPlain();
}

// The most memory that finding the samples of classes needs, in floats per sample: edges hold the
// smoothed values, their second derivative and its zero crossings, besides the memory for
// smoothing.
constexpr std::size_t stepFloats = 6;

std::function<double(double)> shapeOf(const std::optional<TransferFunction> &function) {
    if (!function || function->isPlain())
        return {};
    return [f = *function](double density) { return f.at(density); };
}

double rangeOf(const std::optional<TransferFunction> &function) {
    return function ? function->high - function->low : 1.0;
}

// `amounts`: of the class in each sum.
WeightedCurve curveOf(const TissueClass &tissue, const FieldWindow &window, DensityKind density,
                      const ColorBasis::Rgb &amounts) {
    const double w = tissue.weight;
    return {ValueCurve(window, density, tissue, shapeOf(tissue.transferFunction),
                       rangeOf(tissue.transferFunction)),
            std::array{w * amounts[0], w * amounts[1], w * amounts[2]}};
}

// The sums of the classes. All classes that values alone define share one pass over the volume.
// *Shape*: one entry of `amounts` for each class.
void addClasses(const volume::Volume &volume, const FieldWindow &window,
                const std::vector<TissueClass> &shown, const std::vector<ColorBasis::Rgb> &amounts,
                StepRunner *runner, std::vector<std::vector<float>> &sums,
                const task::Progress &progress) {
    std::vector<WeightedCurve> together;
    double done = 0.0;
    for (std::size_t n = 0; n < shown.size(); ++n) {
        const TissueClass &tissue = shown[n];
        if (tissue.isRange()) {
            together.push_back(curveOf(tissue, window, DensityKind::window, amounts[n]));
            continue;
        }
        const double next = done + 0.9 / double(shown.size());
        const ClassSamples samples = samplesOf(volume, tissue, runner, progress.part(done, next));
        const WeightedCurve curve = curveOf(tissue, window, samples.density, amounts[n]);
        addCurves(samples, {&curve, 1}, sums);
        done = next;
    }
    if (!together.empty())
        addCurves({volume}, together, sums, progress.part(done, 1.0));
}

} // namespace

ClassSamples samplesOf(const volume::Volume &volume, const TissueClass &tissue, StepRunner *runner,
                       const task::Progress &progress) {
    if (tissue.isRange())
        return {volume};
    if (runner == nullptr)
        throw task::Error(task::ErrorCode::usage, task::because::stepsCannotRun(tissue.name));
    return runner->run(volume, tissue, progress);
}

std::size_t peakBytes(const Look &look, std::size_t samples) {
    if (isDensity(look))
        return 0; // is read from the volume
    const std::size_t floats =
        channelsOf(look) + (haveRegions(visibleClasses(look)) ? stepFloats : std::size_t(0));
    return floats * samples * sizeof(float);
}

ShownFields shownFields(const volume::Volume &volume, const FieldWindow &window, const Look &look,
                        StepRunner *runner, const task::Progress &progress) {
    if (isDensity(look))
        return {{densityField(volume, window, progress)}, {}};
    const std::vector<TissueClass> shown = visibleClasses(look);
    const ColorBasis basis = colorBasisOf(look);
    ShownFields result;
    for (std::size_t n = 0; n < basis.colors.size(); ++n)
        result.colors[n] = {basis.colors[n][0], basis.colors[n][1], basis.colors[n][2]};
    task::orOutOfMemory(task::because::noMemoryForTheClassFields, [&] {
        std::vector<std::vector<float>> sums(
            basis.colors.size(), std::vector<float>(volume.lattice().size().count(), 0.0F));
        if (look.classes.empty()) {
            const WeightedCurve curve{ValueCurve(window, DensityKind::window, std::nullopt,
                                                 shapeOf(look.transferFunction),
                                                 rangeOf(look.transferFunction))};
            addCurves({volume}, {&curve, 1}, sums, progress);
        } else {
            addClasses(volume, window, shown, basis.amounts, runner, sums, progress);
        }
        for (auto &samples : sums)
            result.channels.push_back(fieldOf(volume, std::move(samples)));
    });
    return result;
}

ShownFields inPrimaries(ShownFields fields, const task::Progress &progress) {
    if (fields.channels.size() != 2)
        return fields;
    return task::orOutOfMemory(task::because::noMemoryForTheClassFields, [&] {
        const volume::Field &first = fields.channels[0].values, &second = fields.channels[1].values;
        const volume::GridSize size = first.lattice().size();
        const auto mixed = [&](double a, double b) {
            std::vector<float> samples(size.count());
            tbb::parallel_for(0, size.k, [&](int k) {
                progress.check();
                std::vector<float> buffer(2 * std::size_t(size.i));
                for (int j = 0; j < size.j; ++j) {
                    const float *const from = first.row({0, j, k}, size.i, buffer.data()),
                                       *const with =
                                           second.row({0, j, k}, size.i, buffer.data() + size.i);
                    float *const to = samples.data() + size.offsetOf(0, j, k);
                    for (int i = 0; i < size.i; ++i)
                        to[i] = float(a * double(from[i]) + b * double(with[i]));
                }
            });
            return fieldOf(first, std::move(samples));
        };
        const Color &a = fields.colors[0], &b = fields.colors[1];
        ShownFields result{{}, primaries};
        result.channels.push_back(mixed(a.red, b.red));
        result.channels.push_back(mixed(a.green, b.green));
        result.channels.push_back(mixed(a.blue, b.blue));
        return result;
    });
}

DensityField classField(const volume::Volume &volume, const FieldWindow &window,
                        const TissueClass &tissue, StepRunner *runner,
                        const task::Progress &progress) {
    TissueClass plain = tissue;
    plain.weight = 1.0;
    return shownFields(volume, window, {{}, {plain}}, runner, progress).channels.front();
}

} // namespace pellucid::classify
