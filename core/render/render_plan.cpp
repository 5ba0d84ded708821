// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/render_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "core/fourier/padded_size.h"
#include "core/task/error.h"

namespace pellucid::render {

namespace {

// Relative times of a frequency sample by kernel width, with binary16 and with float cells.
constexpr std::array<double, 8> sampleTime{0.0, 0.4, 0.5, 0.7, 1.0, 1.7, 2.2, 2.9};
constexpr double floatCells = 1.4;

double leastTime(int width, fourier::Storage storage) {
    return sampleTime[std::size_t(width)] *
           (storage == fourier::Storage::float32 ? floatCells : 1.0);
}

// Larger slices take more memory than any image is worth.
constexpr int largestSliceGrid = 65536;

// How far a sample's footprint reaches, in samples: the tent ends after one; the cardinal B-spline
// has fallen to 4e-4 after six; the tapered sinc rings.
double footprint(const ImageDefinition &image) {
    switch (image.reconstruction) {
    case Reconstruction::linear:
        return 1.0;
    case Reconstruction::bandLimited:
        return 0.5 * ringingPixels(image.rollOff);
    case Reconstruction::cubic:
        break;
    }
    return 6.0;
}

// How far the projection reaches from the centre of rotation, in pixels, seen from any direction.
double reachPixels(const Camera &camera, const SliceRoom &room, const volume::Lattice &lattice,
                   const ImageDefinition &image) {
    const double longest =
        std::max({lattice.spacingMm(0), lattice.spacingMm(1), lattice.spacingMm(2)});
    return (room.radiusMm + footprint(image) * longest) / camera.pixelMm;
}

} // namespace

SliceRoom roomOfBox(const volume::Lattice &lattice, const volume::VoxelBox &box) {
    const glm::dvec3 center = lattice.center().mm;
    const auto &[lo, hi] = box;
    SliceRoom room;
    for (int corner = 0; corner < 8; ++corner) {
        const volume::VoxelPoint p{{(corner & 1) != 0 ? hi.i - 1 : lo.i,
                                    (corner & 2) != 0 ? hi.j - 1 : lo.j,
                                    (corner & 4) != 0 ? hi.k - 1 : lo.k}};
        room.radiusMm = std::max(room.radiusMm, glm::distance(center, lattice.patient(p).mm));
    }
    return room;
}

FieldSummary summarise(const classify::DensityField &field) {
    return {field.values.lattice(), field.support, energyMarginals(field.values, field.support)};
}

SliceGrid sliceGrid(const Camera &camera, const SliceRoom &room, const volume::Lattice &lattice,
                    const ImageDefinition &image) {
    const double projection = reachPixels(camera, room, lattice, image);
    // A copy of the projection, a period away, must stay outside the image: its near edge lies at
    // period - radius, the image's far edge at half its size plus the pan.
    const auto cells = [&](int size, double pan) {
        const double reach = projection + 0.5 * size + std::abs(pan) / camera.pixelMm;
        // The tails of the roll-off fold in along the border only, so their share of the image's
        // energy falls with its size, and so does the room they are given.
        const double tails =
            room.tails * ringingPixels(image.rollOff) * std::min(1.0, 64.0 / reach);
        if (!(reach + tails < largestSliceGrid))
            throw task::Error(
                task::ErrorCode::outOfMemory,
                fmt::format("pixels of {:.3g} mm need a slice of more than {} frequencies "
                            "a side",
                            camera.pixelMm, largestSliceGrid));
        return fourier::smoothEvenSize(int(std::ceil(reach + tails)));
    };
    return {cells(camera.width, camera.panMm.x), cells(camera.height, camera.panMm.y)};
}

namespace {

// The kernels of one axis by choice and padding, made when first asked for: each takes
// milliseconds.
class AxisCandidates {
public:
    AxisCandidates(int samples, const std::vector<double> &energy)
        : m_samples(samples), m_energy(energy), m_folded((std::size_t(samples) + 3) / 2, 0.0) {
        // From the wrap voxel, the middle one, outward.
        for (int n = 0; n < samples; ++n)
            m_folded[std::size_t(std::abs(n - samples / 2))] += energy[n];
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
            const AxisError error = axisError(kernel, padded, m_energy);
            slot = std::make_unique<Candidate>(Candidate{std::move(kernel), padded, error});
        }
        return *slot;
    }

private:
    int m_samples;
    const std::vector<double> &m_energy;
    std::vector<double> m_folded;
    std::map<std::pair<std::string, double>, std::unique_ptr<Candidate>> m_made;
};

// What the frames of a camera take beside the spectrum: the lines between the two transforms, and
// the image.
std::size_t frameBytes(const SliceGrid &grid, const Camera &camera) {
    return (std::size_t(grid.columns) * grid.rows * 2 + std::size_t(camera.width) * camera.height) *
           sizeof(float);
}

double wrappedShare(const Camera &camera, const SliceGrid &grid, const FieldSummary &field) {
    const double image = double(camera.width) * camera.height;
    const double period = double(grid.columns) * grid.rows;
    // A convex body's shadow has on average a quarter of its surface.
    const volume::GridSize size = field.support.size();
    const double a = size.i * field.lattice.spacingMm(0), b = size.j * field.lattice.spacingMm(1),
                 c = size.k * field.lattice.spacingMm(2);
    const double shadow = 0.5 * (a * b + b * c + c * a) / (camera.pixelMm * camera.pixelMm);
    return std::min(1.0, image / period) / std::min(1.0, image / shadow);
}

// The slice grid with the least room for the roll-off's tails that leaves the kernel most of the
// tolerance, and what these tails leave.
struct PlannedGrid {
    SliceGrid grid;
    SliceRoom room;
    double folded = 0.0;
};

PlannedGrid planGrid(const Scene &scene, const FieldSummary &field) {
    const Camera &camera = scene.camera;
    SliceRoom room{field.energy.radiusMm, 1.0};
    std::optional<PlannedGrid> best;
    SliceGrid least;
    for (const double tails : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0}) {
        room.tails = tails;
        SliceGrid grid;
        try {
            grid = sliceGrid(camera, room, field.lattice, scene.image);
        } catch (const task::Error &) {
            if (best)
                break;
            throw;
        }
        if (!best)
            least = grid;
        // Four times the work is the most that tails are worth, unless that is little.
        constexpr double littleWork = 512.0 * 512.0;
        if (double(grid.columns) * grid.rows >
            std::max(littleWork, 4.0 * double(least.columns) * double(least.rows)))
            break;
        const double folded = predictFoldedTails(scene.image, camera, grid.columns, grid.rows,
                                                 field.energy, field.lattice, field.support);
        if (!best || folded < best->folded)
            best = PlannedGrid{grid, room, folded};
        if (folded <= 0.3 * scene.tolerance)
            break;
    }
    return *best;
}

template <class T>
std::vector<T> choices(const std::optional<T> &fixed, std::initializer_list<T> planned) {
    return fixed ? std::vector<T>{*fixed} : std::vector<T>(planned);
}

std::string reasonFor(const RenderPlan &plan, const Scene &scene, bool overBudget) {
    const bool meets = plan.predictedError <= scene.tolerance;
    std::string fixed;
    const Interpolation &wanted = scene.interpolation;
    for (const auto &[given, what] : {std::pair(wanted.kernel.has_value(), "kernel"),
                                      std::pair(wanted.padding.has_value(), "padding"),
                                      std::pair(wanted.storage.has_value(), "storage")})
        if (given)
            fixed += (fixed.empty() ? "" : ", ") + std::string(what);
    std::string reason = meets        ? "the cheapest that keeps the tolerance"
                         : overBudget ? "the most accurate that fits the memory"
                                      : "the most accurate there is";
    if (!fixed.empty())
        reason += " with the chosen " + fixed;
    return reason;
}

} // namespace

RenderPlan planRender(const Scene &scene, const FieldSummary &field, const Budget &budget) {
    validate(scene);
    using fourier::KernelFamily;
    constexpr auto least = KernelFamily::leastGhosts;
    const auto kernels = choices<fourier::KernelChoice>(
        scene.interpolation.kernel, {{least, 3}, {least, 4}, {least, 5}, {least, 6}, {least, 7}});
    // Below 1.2 the seam of a full lattice shows.
    const auto paddings =
        choices(scene.interpolation.padding, {1.25, 1.375, 1.5, 1.625, 1.75, 2.0});
    const auto storages = choices(scene.interpolation.storage,
                                  {fourier::Storage::binary16, fourier::Storage::float32});
    const volume::GridSize size = field.support.size();
    std::array<AxisCandidates, 3> axes{AxisCandidates(size.i, field.energy.axis[0]),
                                       AxisCandidates(size.j, field.energy.axis[1]),
                                       AxisCandidates(size.k, field.energy.axis[2])};
    // The slice grid depends on box and camera alone.
    const PlannedGrid planned = planGrid(scene, field);
    const double wrapped = wrappedShare(scene.camera, planned.grid, field);

    std::optional<RenderPlan> best;
    double bestTime = 0.0;
    bool overBudget = false;
    std::size_t leastBytes = std::numeric_limits<std::size_t>::max();
    for (const auto storage : storages) {
        for (const auto &choice : kernels) {
            // More taps and wider cells cost time, whatever they save in padding.
            if (best && best->predictedError <= scene.tolerance &&
                leastTime(choice.width, storage) >= bestTime)
                continue;
            std::array<std::size_t, 3> level{};
            for (;;) {
                std::array<const AxisCandidates::Candidate *, 3> at;
                std::array<AxisError, 3> errors;
                for (int d = 0; d < 3; ++d) {
                    at[d] = &axes[d].at(choice, paddings[level[d]]);
                    errors[d] = at[d]->error;
                }
                const fourier::SpectrumLayout layout{{at[0]->kernel, at[1]->kernel, at[2]->kernel},
                                                     field.support,
                                                     {at[0]->padded, at[1]->padded, at[2]->padded},
                                                     storage};
                // A ghost lies a padded period away; what does not fall into the image at once may
                // still wrap into it.
                ImageShare share;
                for (int d = 0; d < 3; ++d) {
                    const double away = at[d]->padded * field.lattice.spacingMm(d);
                    const double half =
                        0.25 * (scene.camera.width + scene.camera.height) * scene.camera.pixelMm;
                    share.inImage[d] = std::max(wrapped, std::min(1.0, half / away));
                }
                const double predicted =
                    std::hypot(predictRelativeError(errors, storage, share), planned.folded);
                const std::size_t bytes =
                    layout.peakBytes() + frameBytes(planned.grid, scene.camera);
                leastBytes = std::min(leastBytes, bytes);
                if (bytes > budget.bytes) {
                    overBudget = true;
                    break; // more padding takes more
                }
                const bool meets = predicted <= scene.tolerance;
                // A larger spectrum is slower to read and to prepare: a tenth for each doubling.
                const double time =
                    leastTime(layout.width(), storage) *
                    (1.0 + 0.1 * std::max(0.0, std::log2(double(bytes) / double(1 << 20))));
                const bool bestMeets = best && best->predictedError <= scene.tolerance;
                if (!best || (meets && (!bestMeets || time < bestTime)) ||
                    (!meets && !bestMeets && predicted < best->predictedError)) {
                    best = RenderPlan{layout,
                                      scene.image,
                                      planned.room,
                                      predicted,
                                      predictMaximum(errors, storage) + planned.folded,
                                      bytes,
                                      {}};
                    bestTime = time;
                }
                if (meets)
                    break;
                // More padding where the ghosts are strongest.
                int worst = -1;
                for (int d = 0; d < 3; ++d)
                    if (level[d] + 1 < paddings.size() &&
                        (worst < 0 || errors[d].ghosts > errors[worst].ghosts))
                        worst = d;
                if (worst < 0)
                    break;
                ++level[std::size_t(worst)];
            }
        }
    }
    if (!best)
        throw task::Error(task::ErrorCode::outOfMemory,
                          fmt::format("the projection needs {} MB, {} MB are allowed",
                                      (leastBytes >> 20) + 1, budget.bytes >> 20));
    best->reason = reasonFor(*best, scene, overBudget);
    return *best;
}

} // namespace pellucid::render
