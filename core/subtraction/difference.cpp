// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/subtraction/difference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <tbb/parallel_for.h>

#include "core/mpr/linear_samples.h"
#include "core/subtraction/reasons.h"
#include "core/task/error.h"
#include "core/volume/statistics.h"

namespace pellucid::subtraction {

namespace {

namespace because = task::because;
using volume::GridSize;
using volume::Lattice;
using volume::Volume;

// Rounding may move a sample from the border to just outside it.
constexpr double borderTolerance = 1e-4;

Volume labelled(const Lattice &lattice, auto samples, const Volume &minuend,
                const Volume &subtrahend, const Weights &weights) {
    volume::VolumeNotes notes = minuend.notes();
    notes.title = weights == Weights()
                      ? notes.title + " - " + subtrahend.notes().title
                      : fmt::format("{:g} x {} {} {:g} x {}", weights.minuend, notes.title,
                                    weights.subtrahend < 0.0 ? '-' : '+',
                                    std::abs(weights.subtrahend), subtrahend.notes().title);
    notes.windows.clear(); // those of the minuend do not suit differences
    notes.darkIsHigh = false;
    notes.isDifference = true;
    notes.lossy = notes.lossy || subtrahend.notes().lossy;
    return Volume(lattice, std::move(samples), volume::ValueUnit::none, std::move(notes));
}

// Exact sums of whole numbers on one lattice; nothing if one does not fit or a weight is not whole.
std::optional<std::vector<std::int16_t>> wholeDifference(const Volume &a, const Volume &b,
                                                         const Weights &weights,
                                                         const task::Progress &progress) {
    std::optional<std::vector<std::int16_t>> result;
    const int ofA = int(weights.minuend), ofB = int(weights.subtrahend);
    if (ofA != weights.minuend || ofB != weights.subtrahend)
        return result;
    a.visit([&](auto from) {
        b.visit([&](auto with) {
            using Shorts = std::span<const std::int16_t>;
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(from)>, Shorts> &&
                          std::is_same_v<std::remove_cvref_t<decltype(with)>, Shorts>) {
                std::vector<std::int16_t> values(from.size());
                const GridSize size = a.lattice().size();
                const std::size_t plane = size.offsetOf(0, 0, 1);
                std::atomic<bool> fits = true;
                tbb::parallel_for(0, size.k, [&](int k) {
                    progress.check();
                    for (std::size_t n = k * plane; n < (k + 1) * plane; ++n) {
                        const int d = ofA * int(from[n]) + ofB * int(with[n]);
                        if (d != std::int16_t(d))
                            fits = false;
                        values[n] = std::int16_t(d);
                    }
                });
                if (fits)
                    result = std::move(values);
            }
        });
    });
    return result;
}

} // namespace

std::vector<float> resampledOnto(const Lattice &lattice, const Volume &volume,
                                 const RigidTransform &toVolume, const task::Progress &progress) {
    const GridSize size = lattice.size(), source = volume.lattice().size();
    const auto voxel = [&](double i, double j, double k) {
        return volume.lattice()
            .voxel({toVolume(lattice.patient(volume::VoxelPoint{{i, j, k}}).mm)})
            .v;
    };
    const glm::dvec3 step = voxel(1, 0, 0) - voxel(0, 0, 0);
    const glm::dvec3 low(-borderTolerance),
        high(source.i - 1 + borderTolerance, source.j - 1 + borderTolerance,
             source.k - 1 + borderTolerance);
    return task::orOutOfMemory(because::noMemoryForTheDifference, [&] {
        std::vector<float> result(size.count());
        volume.visit([&](auto samples) {
            tbb::parallel_for(0, size.k, [&](int k) {
                progress.check();
                std::array<float, mpr::SampleLine::maxPoints> values{};
                for (int j = 0; j < size.j; ++j)
                    for (int i = 0; i < size.i; i += mpr::SampleLine::maxPoints) {
                        const glm::dvec3 start = voxel(i, j, k);
                        const int count = std::min(mpr::SampleLine::maxPoints, size.i - i);
                        mpr::linearSamples(samples.data(), source, {start, step, count},
                                           values.data());
                        float *const to = result.data() + size.offsetOf(i, j, k);
                        for (int n = 0; n < count; ++n) {
                            const glm::dvec3 at = start + double(n) * step;
                            const bool isInside = glm::all(glm::greaterThanEqual(at, low)) &&
                                                  glm::all(glm::lessThanEqual(at, high));
                            to[n] = isInside ? values[std::size_t(n)]
                                             : std::numeric_limits<float>::quiet_NaN();
                        }
                    }
            });
        });
        return result;
    });
}

void validate(const Weights &weights) {
    for (const double weight : {weights.minuend, weights.subtrahend})
        if (!(std::abs(weight) <= Weights::largest))
            throw task::Error(task::ErrorCode::usage, because::subtractionWeightOutOfRange(
                                                          fmt::format("{:g}", weight),
                                                          fmt::format("{:g}", -Weights::largest),
                                                          fmt::format("{:g}", Weights::largest)));
}

Volume difference(const Volume &minuend, const Volume &subtrahend,
                  const RigidTransform &toSubtrahend, const Weights &weights,
                  const task::Progress &progress) {
    validate(weights);
    return task::orOutOfMemory(because::noMemoryForTheDifference, [&] {
        const Lattice &lattice = minuend.lattice();
        if (toSubtrahend.isIdentity() && lattice == subtrahend.lattice())
            if (auto whole = wholeDifference(minuend, subtrahend, weights, progress))
                return labelled(lattice, std::move(*whole), minuend, subtrahend, weights);
        std::vector<float> values =
            resampledOnto(lattice, subtrahend, toSubtrahend, progress.part(0.0, 0.8));
        std::atomic<bool> overlaps = false;
        minuend.visit([&](auto samples) {
            const GridSize size = lattice.size();
            tbb::parallel_for(0, size.k, [&](int k) {
                progress.check();
                for (std::size_t n = size.offsetOf(0, 0, k), end = size.offsetOf(0, 0, k + 1);
                     n < end; ++n) {
                    const auto d = float(weights.minuend * double(samples[n]) +
                                         weights.subtrahend * double(values[n]));
                    if (std::isfinite(d))
                        overlaps = true;
                    values[n] = std::isfinite(d) ? d : 0.0F;
                }
            });
        });
        if (!overlaps)
            throw task::Error(task::ErrorCode::unusable, because::volumesDoNotOverlap);
        return labelled(lattice, std::move(values), minuend, subtrahend, weights);
    });
}

Volume onLatticeOf(const Volume &minuend, const Volume &subtrahend,
                   const RigidTransform &toSubtrahend, const task::Progress &progress) {
    return task::orOutOfMemory(because::noMemoryForTheDifference, [&] {
        std::vector<float> values =
            resampledOnto(minuend.lattice(), subtrahend, toSubtrahend, progress);
        const double lowest = volume::quantiles(subtrahend, {0.0}).front();
        bool overlaps = false;
        for (float &value : values) {
            overlaps = overlaps || std::isfinite(value);
            value = std::isfinite(value) ? value : float(lowest);
        }
        if (!overlaps)
            throw task::Error(task::ErrorCode::unusable, because::volumesDoNotOverlap);
        volume::VolumeNotes notes = subtrahend.notes();
        notes.frameOfReferenceUid = minuend.notes().frameOfReferenceUid;
        return Volume(minuend.lattice(), std::move(values), subtrahend.unit(), std::move(notes));
    });
}

Subtraction subtract(const Volume &minuend, const Volume &subtrahend, Registering registering,
                     const Weights &weights, const task::Progress &progress) {
    if (registering == Registering::none)
        return {difference(minuend, subtrahend, {}, weights, progress), std::nullopt,
                minuend.notes().frameOfReferenceUid != subtrahend.notes().frameOfReferenceUid};
    const Registration found = registerRigidly(minuend, subtrahend, progress.part(0.0, 0.8));
    return {difference(minuend, subtrahend, found.toMoving, weights, progress.part(0.8, 1.0)),
            found, false};
}

} // namespace pellucid::subtraction
