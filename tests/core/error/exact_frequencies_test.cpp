// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <random>
#include <stop_token>
#include <vector>

#include <hwy/targets.h>

#include "core/error/exact_frequencies.h"
#include "core/reference/direct_sum.h"
#include "core/reference/shaded_field.h"
#include "core/scene/camera.h"
#include "tests/support/fields.h"
#include "tests/support/json_text.h"

namespace pellucid {

namespace {

using Complex = std::complex<double>;
using Rgb = std::array<double, 3>;

const std::vector<shading::Shading> shadings{
    {},
    {.cue = {shading::CueKind::linear, 0.8}},
    {.cue = {shading::CueKind::sine, 1.0}, .lights = {{}}},
    {.cue = {shading::CueKind::curve, 0.7, {0.5, 1.5, 0.2, 1.0}},
     .ambient = 0.4,
     .lights = {{{1, 2, 3}, {1.0, 0.5, 0.2}},
                {{-1, 0, 1}, {0.0, 0.5, 1.0}, 0.5, shading::LightFrame::patient}}}};

// Frequencies of a view, the first of them 0.
std::vector<glm::dvec3> frequenciesOf(const glm::dmat3 &axes, int count) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0.0, 0.3);
    std::vector<glm::dvec3> frequencies{glm::dvec3(0.0)};
    while (int(frequencies.size()) < count)
        frequencies.push_back(normal(random) * axes[0] + normal(random) * axes[1]);
    return frequencies;
}

glm::dmat3 someAxes(const volume::Lattice &lattice) {
    scene::Camera camera = scene::defaultCamera(lattice);
    camera.orientation = scene::viewOrientation(scene::StandardView::front, {20, 30, 40});
    return camera.axes();
}

// D of each channel by the rows' images.
std::vector<std::vector<Complex>> channelsOf(const error::ShownRows &rows,
                                             const std::vector<glm::dvec3> &frequencies) {
    const auto sums = error::exactFrequencies(rows, frequencies);
    std::vector<std::vector<Complex>> channels(3, std::vector<Complex>(frequencies.size()));
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t image = 0; image < sums.size(); ++image)
            for (std::size_t n = 0; n < frequencies.size(); ++n)
                channels[c][n] += rows.share(int(image), int(c)) * sums[image][n];
    return channels;
}

} // namespace

// Against sums in double of the field that the reference shades, which has float samples.
TEST(ExactFrequencies, AreThoseOfTheReference) {
    for (const volume::GridSize size :
         {volume::GridSize{20, 21, 22}, {33, 1, 7}, {1, 1, 1}, {2, 40, 3}})
        for (const shading::Shading &shading : shadings) {
            const auto lattice = test::tiltedLattice(size, {1, 0.9, 2.5}, 20);
            const auto field = test::noiseField(lattice);
            const glm::dmat3 axes = someAxes(lattice);
            const auto scale = shading::shadingScale(lattice);
            const auto frequencies = frequenciesOf(axes, 37); // no whole number of vectors
            const Rgb weight{1.0, 1.0, 1.0};
            const error::ShownRows rows({&field, 1}, {&weight, 1}, shading, axes, scale);
            EXPECT_EQ(rows.images(), shading.isGrey() ? 1 : 3);
            const auto channels = channelsOf(rows, frequencies);
            for (int c = 0; c < 3; ++c) {
                const auto shaded = reference::shadedField(field, shading, axes, c, scale);
                std::vector<Complex> exact(frequencies.size());
                reference::directSum(shaded.values, frequencies, exact);
                for (std::size_t n = 0; n < exact.size(); ++n)
                    EXPECT_LT(std::abs(channels[std::size_t(c)][n] - exact[n]),
                              2e-7 * std::abs(exact[0]))
                        << size.i << " " << shading::jsonOf(shading).dump() << " " << n;
            }
        }
}

// Layers and classes: any fields in any colors.
TEST(ExactFrequencies, OfWeightedFieldsAreWeightedSums) {
    const auto lattice = test::tiltedLattice({15, 12, 9}, {1, 1, 2}, 10);
    const glm::dmat3 axes = someAxes(lattice);
    const auto frequencies = frequenciesOf(axes, 20);
    for (const std::vector<Rgb> &weights :
         {std::vector<Rgb>{{0.5, 0.5, 0.5}, {2, 2, 2}, {0, 0, 0}, {1, 1, 1}},
          {{1, 0, 0}, {0, 1, 0.5}},
          {{1, 0.2, 0}, {0, 1, 0.5}, {0.3, 0, 1}, {0.1, 0.1, 0.1}, {2, 0, 0}},
          {{0, 0, 0}}}) {
        std::vector<classify::DensityField> fields;
        for (std::size_t n = 0; n < weights.size(); ++n)
            fields.push_back(test::noiseField(lattice, unsigned(n + 1)));
        const auto channels =
            channelsOf(error::ShownRows(fields, weights, {}, axes, shading::shadingScale(lattice)),
                       frequencies);
        std::vector<std::vector<Complex>> expected(3, std::vector<Complex>(frequencies.size()));
        for (std::size_t n = 0; n < fields.size(); ++n) {
            std::vector<Complex> exact(frequencies.size());
            reference::directSum(fields[n].values, frequencies, exact);
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t m = 0; m < exact.size(); ++m)
                    expected[c][m] += weights[n][c] * exact[m];
        }
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t m = 0; m < frequencies.size(); ++m)
                EXPECT_LT(std::abs(channels[c][m] - expected[c][m]),
                          1e-6 * std::max(1.0, std::abs(expected[0][0])));
    }
}

TEST(ExactFrequencies, AreTheSameOnEveryInstructionSet) {
    const auto lattice = test::tiltedLattice({45, 30, 17}, {1, 1, 2}, 10);
    const auto field = test::noiseField(lattice);
    const glm::dmat3 axes = someAxes(lattice);
    const auto frequencies = frequenciesOf(axes, 40);
    const Rgb weight{1.0, 1.0, 1.0};
    for (const shading::Shading &shading : shadings) {
        const error::ShownRows rows({&field, 1}, {&weight, 1}, shading, axes,
                                    shading::shadingScale(lattice));
        std::vector<std::vector<Complex>> best;
        for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
            hwy::SetSupportedTargetsForTest(rest & -rest);
            hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            const auto sums = error::exactFrequencies(rows, frequencies);
            hwy::SetSupportedTargetsForTest(0);
            hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            if (best.empty())
                best = sums;
            for (std::size_t image = 0; image < sums.size(); ++image)
                for (std::size_t n = 0; n < frequencies.size(); ++n)
                    EXPECT_LT(std::abs(sums[image][n] - best[image][n]),
                              1e-6 * std::abs(best[image][0]));
        }
    }
}

TEST(ExactFrequencies, AreCancelled) {
    const auto field = test::noiseField(volume::Lattice::centred({8, 8, 8}, {1, 1, 1}));
    const Rgb weight{1.0, 1.0, 1.0};
    const error::ShownRows rows({&field, 1}, {&weight, 1}, {}, glm::dmat3(1.0), {});
    std::stop_source stop;
    stop.request_stop();
    const std::vector<glm::dvec3> frequencies(3, glm::dvec3(0.1));
    EXPECT_THROW(error::exactFrequencies(rows, frequencies, task::Progress(stop.get_token())),
                 task::Cancelled);
}

} // namespace pellucid
