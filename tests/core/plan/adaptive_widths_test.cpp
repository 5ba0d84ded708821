// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/plan/adaptive_widths.h"
#include "core/prepare/prepared_engine.h"
#include "core/render/frame_inputs.h"
#include "tests/support/fields.h"
#include "tests/support/fresh_seed.h"

namespace pellucid {

namespace {

// Fields whose energy is spread over all frequencies, or lies in a ball, on a line, in a point.
struct Shape {
    const char *name;
    std::function<double(const glm::dvec3 &mm, std::mt19937 &random)> density;
};

double inBall(const glm::dvec3 &mm) {
    return std::clamp(26.5 - glm::length(mm), 0.0, 1.0);
}

const glm::dvec3 oblique = glm::normalize(glm::dvec3(0.31, 0.52, 0.8));

const Shape shapes[] = {
    {"ball", [](const glm::dvec3 &mm, std::mt19937 &) { return inBall(mm); }},
    {"noise",
     [](const glm::dvec3 &mm, std::mt19937 &random) {
         return inBall(mm) * std::uniform_real_distribution<double>()(random);
     }},
    {"shell", [](const glm::dvec3 &mm,
                 std::mt19937 &) { return std::max(0.0, 1.0 - std::abs(glm::length(mm) - 22.0)); }},
    {"sheet",
     [](const glm::dvec3 &mm, std::mt19937 &) {
         return inBall(mm) * std::max(0.0, 1.0 - std::abs(glm::dot(oblique, mm)));
     }},
    {"sheet along the lattice",
     [](const glm::dvec3 &mm, std::mt19937 &) { return std::abs(mm.x) < 0.6 ? inBall(mm) : 0.0; }},
    {"stripes",
     [](const glm::dvec3 &mm, std::mt19937 &) {
         return inBall(mm) *
                (0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * 0.31 * glm::dot(oblique, mm)));
     }},
    {"points",
     [](const glm::dvec3 &mm, std::mt19937 &random) {
         return std::uniform_real_distribution<double>()(random) < 2e-3 ? inBall(mm) : 0.0;
     }},
    {"box",
     [](const glm::dvec3 &mm, std::mt19937 &) {
         return std::abs(mm.x) < 20.0 && std::abs(mm.y) < 14.0 && std::abs(mm.z) < 24.0 ? 1.0 : 0.0;
     }},
};

class AdaptiveWidths : public testing::TestWithParam<Shape> {
protected:
    classify::DensityField field(const volume::Lattice &lattice, unsigned seed) const {
        std::mt19937 random(seed);
        std::vector<float> samples;
        const volume::GridSize n = lattice.size();
        for (int k = 0; k < n.k; ++k)
            for (int j = 0; j < n.j; ++j)
                for (int i = 0; i < n.i; ++i)
                    samples.push_back(float(GetParam().density(
                        lattice.patient(volume::VoxelIndex{i, j, k}).mm, random)));
        return classify::densityField(
            volume::Volume(lattice, std::move(samples), volume::ValueUnit::none), {0.0, 1.0});
    }
};

double difference(const picture::ProjectionImage &a, const picture::ProjectionImage &b) {
    double error = 0.0, energy = 0.0;
    for (std::size_t n = 0; n < b.samples.size(); ++n) {
        error += std::pow(double(a.samples[n]) - double(b.samples[n]), 2);
        energy += std::pow(double(b.samples[n]), 2);
    }
    return std::sqrt(error / energy);
}

// The difference from a picture that one kernel reads never exceeds what was said, with pixels a
// third of a voxel wide, seen along the axes, along what the fields have, and from anywhere.
TEST_P(AdaptiveWidths, DifferNoMoreThanTheySay) {
    const unsigned seed = test::freshSeed();
    for (const volume::Lattice &lattice :
         {volume::Lattice::centred({60, 60, 60}, {1.0, 1.0, 1.0}),
          volume::Lattice::centred({60, 60, 20}, {1.0, 1.0, 3.0})}) {
        const classify::DensityField shown = field(lattice, seed);
        scene::Scene scene;
        scene.camera = scene::defaultCamera(lattice);
        scene.camera.pixelMm /= 3.0;
        scene.camera.width = scene.camera.height = 3 * scene.camera.width;
        for (const int width : {3, 4, 5}) {
            scene.interpolation = {fourier::KernelChoice{fourier::KernelFamily::leastAliasing, width},
                                   1.5, fourier::Storage::float32, true};
            const auto engine = prepare::prepareEngine(scene, {{shown}, {}}, {}).engine;
            const auto parts = engine->parts();
            const fourier::Spectrum &spectrum = *parts.spectra.fields.front();
            const auto kernels =
                std::make_shared<const fourier::KernelsByWidth>(spectrum.layout());
            const auto energies = std::make_shared<const plan::SpectrumEnergies>(
                spectrum, *kernels, scene.image, 1e-4);
            std::mt19937 random(seed);
            std::normal_distribution<double> normal;
            int narrowed = 0;
            for (int n = 0; n < 8; ++n) {
                // Three along the axes, one along the sheet, the others anywhere.
                const glm::dvec3 right =
                    n < 3    ? glm::dvec3(n == 0, n == 1, n == 2)
                    : n == 3 ? oblique
                             : glm::dvec3(normal(random), normal(random), normal(random));
                const glm::dvec3 other =
                    n < 3 ? glm::dvec3(n == 1, n == 2, n == 0)
                          : glm::dvec3(normal(random), normal(random), normal(random));
                const glm::dvec3 u = glm::normalize(right), w = glm::normalize(glm::cross(u, other));
                scene.camera.orientation = glm::quat_cast(glm::dmat3(u, glm::cross(w, u), w));
                const auto all = engine->render(scene.camera, scene.image, {});
                for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
                    const auto widths = std::make_shared<const plan::AdaptiveWidths>(
                        kernels, plan::AdaptiveWidths::Energies{energies},
                        plan::AdaptiveWidths::Energies{}, tolerance);
                    render::CpuEngine narrow(parts.spectra, parts.fieldOfView);
                    narrow.setChannelWeights(parts.channelWeights);
                    narrow.setWidths(widths);
                    const plan::SliceGrid grid = plan::sliceGrid(scene.camera, parts.fieldOfView,
                                                                 lattice, scene.image);
                    const render::FrameGeometry geometry(scene.camera, grid, spectrum);
                    const auto map = widths->mapFor(
                        scene.camera.axes(), render::slicePlane(scene.camera, grid, geometry),
                        parts.channelWeights);
                    const double measured =
                        difference(narrow.render(scene.camera, scene.image, {}), all);
                    EXPECT_LE(measured, std::max(map.left, 2e-7))
                        << GetParam().name << " " << width << " " << n << " " << tolerance;
                    EXPECT_LE(map.left, tolerance);
                    narrowed += measured > 0.0 ? 1 : 0;
                    std::printf("RATIO %s w %d tol %.0e: %.2f\n", GetParam().name, width, tolerance, map.left/std::max(measured,2e-7));
                }
            }
            EXPECT_GT(narrowed, 4) << GetParam().name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, AdaptiveWidths, testing::ValuesIn(shapes),
                         [](const auto &shape) { return std::to_string(shape.index); });

} // namespace

} // namespace pellucid
