// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/render_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "core/fourier/transforms/padded_size.h"
#include "core/task/error.h"

namespace pellucid::plan {

namespace {

namespace because = task::because;

// Relative times of a frequency sample by kernel width when its cells lie in the cache, with
// binary16 and with float cells, and of its part in the transforms.
constexpr std::array<double, 8> sampleTime{0.0, 0.4, 0.5, 0.7, 1.0, 1.7, 2.2, 2.9};
constexpr double floatCells = 1.4;
constexpr double transformTime = 0.2;
// The time to bring in what a cell of the slice's area adds for a width of 4: 6 ns beside the 24 of
// a sample.
constexpr double cellTime = 0.25;

double timeInCache(int width, fourier::Storage storage) {
    return transformTime + sampleTime[std::size_t(width)] *
                               (storage == fourier::Storage::float32 ? floatCells : 1.0);
}

// The time of the frames of a slice grid, its frequencies being the unit.
double frameTime(const SliceGrid &grid, const scene::Camera &camera, const volume::Lattice &lattice,
                 const fourier::SpectrumLayout &layout) {
    // In cells, the slice of a view along an axis is as large as the other two axes are padded.
    const double i = layout.padded.i * lattice.spacingMm(0) / camera.pixelMm,
                 j = layout.padded.j * lattice.spacingMm(1) / camera.pixelMm,
                 k = layout.padded.k * lattice.spacingMm(2) / camera.pixelMm;
    const double area = (i * j + j * k + k * i) / 3.0;
    const double frequencies = double(grid.columns) * grid.rows;
    const double inCells =
        cellTime * (0.25 * layout.width()) * (double(bytesPerCell(layout.storage)) / 4.0) * area;
    // What is larger takes longer to prepare too: a twentieth for each doubling.
    const double doublings = std::max(0.0, std::log2(double(layout.bytes()) / double(1 << 20)));
    return (frequencies * timeInCache(layout.width(), layout.storage) + inCells) *
           (1.0 + 0.05 * doublings);
}

} // namespace

FieldSummary summarise(const classify::DensityField &field) {
    return summarise({&field, 1}).front();
}

std::vector<FieldSummary> summarise(std::span<const classify::DensityField> fields) {
    volume::VoxelBox box = fields.front().support;
    for (const classify::DensityField &field : fields)
        box = volume::united(box, field.support);
    std::vector<FieldSummary> summaries;
    for (const classify::DensityField &field : fields)
        summaries.push_back(
            {field.values.lattice(), box, energyMarginals(field.values, box), {}, {}});
    return summaries;
}

namespace {

// The kernels of one axis by choice and padding, made when first asked for: each takes
// milliseconds.
class AxisCandidates {
public:
    /// `cued`: with the error of a linear cue's moments.
    AxisCandidates(int axis, std::span<const FieldSummary> fields, bool cued)
        : m_cued(cued), m_samples(fields.front().support.size()[axis]), m_axis(std::size_t(axis)),
          m_fields(fields), m_folded((std::size_t(m_samples) + 3) / 2, 0.0) {
        // From the wrap voxel, the middle one, outward.
        for (const FieldSummary &field : fields)
            for (int n = 0; n < m_samples; ++n)
                m_folded[std::size_t(std::abs(n - m_samples / 2))] +=
                    field.energy.axis[m_axis][std::size_t(n)] / double(fields.size());
    }

    struct Candidate {
        fourier::Kernel kernel;
        int padded;
        AxisError error;
    };
    const Candidate &at(const fourier::KernelChoice &choice, double wanted) {
        auto &slot = m_made[{fourier::kernelName(choice), wanted}];
        if (!slot) {
            const int padded = fourier::paddedSize(m_samples, wanted);
            // Small axes are padded to more than they need: the kernel may know.
            // Least ghosts are sought for a field that leaves some room.
            const double padding =
                std::clamp(double(padded) / m_samples, 1.05, std::max(2.5, wanted));
            auto kernel = fourier::makeKernel(choice, padding, m_folded);
            std::optional<fourier::MomentKernel> moment;
            if (m_cued)
                moment.emplace(kernel, double(padded) / m_samples);
            // The worst of the fields; the amplitudes of blocks are the kernel's alone.
            AxisError error;
            for (const FieldSummary &field : m_fields) {
                AxisError e = axisError(kernel, padded, field.energy.axis[m_axis]);
                if (moment)
                    addMomentError(e, kernel, *moment, padded,
                                   field.slabs ? (*field.slabs)[m_axis]
                                               : evenSlabProducts(field.energy.axis[m_axis]));
                e.brightest = std::max(error.brightest, e.brightest);
                e.moment = std::max(error.moment, e.moment);
                e.brightestMoment = std::max(error.brightestMoment, e.brightestMoment);
                error = std::move(e);
            }
            slot = std::make_unique<Candidate>(Candidate{std::move(kernel), padded, error});
        }
        return *slot;
    }

private:
    bool m_cued;
    int m_samples;
    std::size_t m_axis;
    std::span<const FieldSummary> m_fields;
    std::vector<double> m_folded;
    std::map<std::pair<std::string, double>, std::unique_ptr<Candidate>> m_made;
};

// A slice grid and what the tails that fold back into it leave.
struct PlannedGrid {
    SliceGrid grid;
    SliceRoom room;
    double folded = 0.0;
    double cells() const { return double(grid.columns) * grid.rows; }
};

// The slice grids worth their time, smallest first.
std::vector<PlannedGrid> planGrids(const scene::Scene &scene,
                                   std::span<const FieldSummary> fields) {
    const scene::Camera &camera = scene.camera;
    SliceRoom room;
    for (const FieldSummary &field : fields)
        room.spreads.push_back(field.energy.spread);
    std::vector<PlannedGrid> grids;
    for (const double share : {0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1}) {
        room.foldedTails = share * scene.tolerance;
        const SliceGrid grid = sliceGrid(camera, room, fields.front().lattice, scene.image);
        if (!grids.empty() && grid == grids.back().grid)
            continue;
        double folded = 0.0;
        for (const auto &spread : room.spreads)
            folded = std::max(
                folded, predictFoldedTails(scene.image, camera, grid.columns, grid.rows, *spread));
        grids.push_back({grid, room, folded});
    }
    return grids;
}

// The worst of the fields.
double imageShare(const scene::Camera &camera, std::span<const FieldSummary> fields) {
    double share = 1.0;
    for (const FieldSummary &field : fields)
        share = std::min(share, shareInImage(camera, *field.energy.spread));
    return share;
}

// Of an axis's ghosts where they are strongest.
double strength(const AxisError &error) {
    double most = 0.0;
    for (const BlockAmplitudes &block : error.blocks)
        most = std::max(most, block.ghosts);
    return most;
}

template <class T>
std::vector<T> choices(const std::optional<T> &fixed, std::initializer_list<T> planned) {
    return fixed ? std::vector<T>{*fixed} : std::vector<T>(planned);
}

task::Reason reasonFor(const RenderPlan &plan, const scene::Scene &scene, bool overBudget) {
    const bool meets = plan.predictedError <= scene.tolerance;
    std::string fixed;
    const scene::Interpolation &wanted = scene.interpolation;
    for (const auto &[given, what] : {std::pair(wanted.kernel.has_value(), "kernel"),
                                      std::pair(wanted.padding.has_value(), "padding"),
                                      std::pair(wanted.storage.has_value(), "storage")})
        if (given)
            fixed += (fixed.empty() ? "" : ", ") + std::string(what);
    if (fixed.empty())
        return meets        ? because::cheapest
               : overBudget ? because::mostAccurateThatFits
                            : because::mostAccurate;
    return meets        ? because::cheapestWith(fixed)
           : overBudget ? because::mostAccurateThatFitsWith(fixed)
                        : because::mostAccurateWith(fixed);
}

} // namespace

RenderPlan planRender(const scene::Scene &scene, const FieldSummary &field, const Budget &budget) {
    return planRender(scene, {&field, 1}, 1, budget);
}

RenderPlan planRender(const scene::Scene &scene, std::span<const FieldSummary> fields, int channels,
                      const Budget &budget) {
    scene::validate(scene);
    const FieldSummary &field = fields.front(); // lattice and box are the same of all
    using fourier::KernelFamily;
    constexpr auto least = KernelFamily::leastGhosts;
    const auto kernels = choices<fourier::KernelChoice>(
        scene.interpolation.kernel, {{least, 3}, {least, 4}, {least, 5}, {least, 6}, {least, 7}});
    // Below 1.2 the seam of a full lattice shows.
    const auto paddings =
        choices(scene.interpolation.padding, {1.25, 1.375, 1.5, 1.625, 1.75, 2.0});
    const auto storages = choices(scene.interpolation.storage,
                                  {fourier::Storage::binary16, fourier::Storage::float32});
    const shading::DepthCue &cue = scene.shading.cue;
    const bool cued = cue.isActive() && cue.kind == shading::CueKind::linear;
    std::array<AxisCandidates, 3> axes{AxisCandidates(0, fields, cued),
                                       AxisCandidates(1, fields, cued),
                                       AxisCandidates(2, fields, cued)};
    const std::vector<PlannedGrid> grids = planGrids(scene, fields);

    const double leastFolded =
        std::min_element(grids.begin(), grids.end(), [](const auto &a, const auto &b) {
            return a.folded < b.folded;
        })->folded;

    // Planes are joined into a picture of their own.
    const std::size_t joinedBytes = channels > 1 ? std::size_t(channels) * scene.camera.width *
                                                       scene.camera.height * sizeof(float)
                                                 : 0;

    std::optional<RenderPlan> best;
    double bestTime = std::numeric_limits<double>::infinity(); // of those within the tolerance
    bool overBudget = false;
    std::size_t leastBytes = std::numeric_limits<std::size_t>::max();
    using Levels = std::array<std::size_t, 3>; // of padding, by axis
    const auto layoutAt = [&](const fourier::KernelChoice &choice, fourier::Storage storage,
                              const Levels &level, std::array<AxisError, 3> &errors) {
        const auto &i = axes[0].at(choice, paddings[level[0]]);
        const auto &j = axes[1].at(choice, paddings[level[1]]);
        const auto &k = axes[2].at(choice, paddings[level[2]]);
        errors = {i.error, j.error, k.error};
        return fourier::SpectrumLayout{
            {i.kernel, j.kernel, k.kernel}, field.support, {i.padded, j.padded, k.padded}, storage};
    };
    // The worst of the fields.
    const auto weightOf = [&](const fourier::SpectrumLayout &layout) {
        CueWeight worst;
        for (const FieldSummary &one : fields) {
            const CueWeight weight =
                cueWeight(cue, one.lattice, one.depthRadiusMm.value_or(one.lattice.radiusMm()),
                          layout, one.energy);
            worst.ghosts = std::max(worst.ghosts, weight.ghosts);
            for (std::size_t d = 0; d < worst.moments.size(); ++d)
                worst.moments[d] = std::max(worst.moments[d], weight.moments[d]);
        }
        return worst;
    };
    const double inImage = imageShare(scene.camera, fields);
    const auto predict = [&](const fourier::SpectrumLayout &layout,
                             const std::array<AxisError, 3> &errors) {
        const CueWeight weight = weightOf(layout);
        double worst = 0.0;
        for (const FieldSummary &one : fields)
            worst = std::max(
                worst, predictRelativeError(errors, layout.storage, one.energy, inImage, weight));
        return worst;
    };
    const auto maximum = [&](const fourier::SpectrumLayout &layout,
                             const std::array<AxisError, 3> &errors) {
        double worst = 0.0;
        for (const FieldSummary &one : fields)
            worst = std::max(worst,
                             predictMaximum(errors, layout.storage, one.energy, weightOf(layout)));
        return worst;
    };
    // Kernels that no padding makes good enough are left out at first: making one takes
    // milliseconds.
    const auto hopeless = [&](const fourier::KernelChoice &choice, fourier::Storage storage) {
        std::array<AxisError, 3> errors;
        const std::size_t most = paddings.size() - 1;
        const auto layout = layoutAt(choice, storage, {most, most, most}, errors);
        return std::hypot(predict(layout, errors), leastFolded) > scene.tolerance;
    };
    const auto consider = [&](const fourier::KernelChoice &choice, fourier::Storage storage) {
        Levels level{};
        for (;;) {
            std::array<AxisError, 3> errors;
            const auto layout = layoutAt(choice, storage, level, errors);
            if (!layout.addressable()) {
                overBudget = true;
                return;
            }
            // All but the last are there when the last is prepared.
            const std::size_t spectrumBytes =
                layout.peakBytes() + (fields.size() - 1) * layout.bytes();
            bool fits = false;
            const double ofGhosts = predict(layout, errors);
            for (const PlannedGrid &planned : grids) {
                const std::size_t bytes =
                    spectrumBytes + std::size_t(channels) * frameBytes(planned.grid, scene.camera) +
                    joinedBytes;
                leastBytes = std::min(leastBytes, bytes);
                if (bytes > budget.bytes) {
                    overBudget = true;
                    break; // wider grids take more
                }
                fits = true;
                const double predicted = std::hypot(ofGhosts, planned.folded);
                const double time = frameTime(planned.grid, scene.camera, field.lattice, layout);
                const bool meets = predicted <= scene.tolerance;
                const bool unmet = std::isinf(bestTime);
                if (meets ? time < bestTime
                          : unmet && (!best || predicted < best->predictedError)) {
                    best = RenderPlan{layout,    planned.room,
                                      predicted, maximum(layout, errors) + planned.folded,
                                      0.0,       bytes};
                    if (meets)
                        bestTime = time;
                }
                if (meets && &planned == &grids.front())
                    return; // more padding takes more
                if (meets)
                    break; // wider grids take longer
            }
            if (!fits)
                return;
            // More padding where the ghosts are strongest.
            int worst = -1;
            for (int d = 0; d < 3; ++d)
                if (level[d] + 1 < paddings.size() &&
                    (worst < 0 || strength(errors[d]) > strength(errors[worst])))
                    worst = d;
            if (worst < 0)
                return;
            ++level[std::size_t(worst)];
        }
    };
    // More taps and wider cells cost time, whatever they save elsewhere.
    const auto faster = [&](const fourier::KernelChoice &choice, fourier::Storage storage) {
        return grids.front().cells() * timeInCache(choice.width, storage) < bestTime;
    };
    for (const bool thorough : {false, true}) {
        if (thorough && !std::isinf(bestTime))
            break;
        for (const auto storage : storages)
            for (const auto &choice : kernels)
                if (faster(choice, storage) && (thorough || !hopeless(choice, storage)))
                    consider(choice, storage);
    }
    if (!best && leastBytes == std::numeric_limits<std::size_t>::max())
        throw task::Error(task::ErrorCode::outOfMemory, because::projectionNeedsTooManyCells);
    if (!best)
        throw task::Error(
            task::ErrorCode::outOfMemory,
            because::projectionNeedsMemory((leastBytes >> 20) + 1, budget.bytes >> 20));
    double added = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
        double worst = 0.0;
        for (const FieldSummary &one : fields)
            worst = std::max(worst, filterError(best->spectrum.kernels[d],
                                                best->spectrum.padded[int(d)], one.energy.axis[d]));
        added += worst;
    }
    best->filterError = std::sqrt(added);
    best->reason = reasonFor(*best, scene, overBudget);
    return *best;
}

} // namespace pellucid::plan
