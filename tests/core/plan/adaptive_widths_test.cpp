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

// Three views along the axes, one along the sheet, four from anywhere.
std::vector<glm::dquat> views(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto anywhere = [&] {
        return glm::dvec3(normal(random), normal(random), normal(random));
    };
    std::vector<glm::dquat> views;
    for (int n = 0; n < 8; ++n) {
        const glm::dvec3 right = n < 3    ? glm::dvec3(n == 0, n == 1, n == 2)
                                 : n == 3 ? oblique
                                          : anywhere();
        const glm::dvec3 other = n < 3 ? glm::dvec3(n == 1, n == 2, n == 0) : anywhere();
        const glm::dvec3 u = glm::normalize(right), w = glm::normalize(glm::cross(u, other));
        views.push_back(glm::quat_cast(glm::dmat3(u, glm::cross(w, u), w)));
    }
    return views;
}

// Pictures by several widths beside those that one kernel reads from the same spectra.
class Narrowed {
public:
    Narrowed(const scene::Scene &scene, const classify::DensityField &field)
        : m_scene(scene),
          m_whole(prepare::prepareEngine(scene, classify::ShownFields{{field}, {}}, {}).engine),
          m_parts(m_whole->parts()) {
        const fourier::SpectrumLayout &layout = m_parts.spectra.fields.front()->layout();
        m_kernels = std::make_shared<const fourier::KernelsByWidth>(layout);
        const auto energiesOf = [&](const render::EngineSpectra::Spectra &spectra) {
            plan::AdaptiveWidths::Energies energies;
            for (const auto &spectrum : spectra)
                energies.push_back(std::make_shared<const plan::SpectrumEnergies>(
                    *spectrum, *m_kernels, scene.image, 1e-4));
            return energies;
        };
        m_fields = energiesOf(m_parts.spectra.fields);
        m_gradients = energiesOf(m_parts.spectra.gradients);
    }

    struct Error {
        double predicted, measured;
    };
    Error errorFrom(const glm::dquat &view, double tolerance) {
        m_scene.camera.orientation = view;
        const auto render = [&](picture::Projector &engine) {
            return engine.render(m_scene.camera, m_scene.image, m_scene.shading).samples;
        };
        const auto widths = std::make_shared<const plan::AdaptiveWidths>(
            m_kernels, m_fields, m_gradients, m_scene.image, tolerance);
        render::CpuEngine narrow(m_parts.spectra, m_parts.fieldOfView);
        narrow.setChannelWeights(m_parts.channelWeights);
        narrow.setWidths(widths);
        render::FrameSetup setup(m_parts.fieldOfView, widths);
        const auto inputs = setup.inputsFor(m_parts.spectra, m_parts.channelWeights, m_scene.camera,
                                            m_scene.image, m_scene.shading);
        return {inputs.widths.value().estimatedError,
                test::relativeL2(render(narrow), render(*m_whole))};
    }

private:
    scene::Scene m_scene;
    std::shared_ptr<render::ProjectionEngine> m_whole;
    render::EngineParts m_parts;
    std::shared_ptr<const fourier::KernelsByWidth> m_kernels;
    plan::AdaptiveWidths::Energies m_fields, m_gradients;
};

// A scene of pixels of a third of a voxel or larger ones, read by one kernel.
scene::Scene sceneOf(const volume::Lattice &lattice, double voxelsPerPixel, int width) {
    scene::Scene scene;
    scene.camera = scene::defaultCamera(lattice);
    scene.camera.pixelMm *= voxelsPerPixel;
    scene.camera.width = scene.camera.height = int(scene.camera.width / voxelsPerPixel);
    scene.interpolation = {fourier::KernelChoice{fourier::KernelFamily::leastAliasing, width}, 1.5,
                           fourier::Storage::float32, true};
    return scene;
}

std::array<volume::Lattice, 2> lattices() {
    return {volume::Lattice::centred({60, 60, 60}, {1.0, 1.0, 1.0}),
            volume::Lattice::centred({60, 60, 20}, {1.0, 1.0, 3.0})};
}

constexpr double rounding = 3e-7;

// The difference from a picture that one kernel reads never exceeds the predicted one.
TEST_P(AdaptiveWidths, DifferNoMoreThanPredicted) {
    const unsigned seed = test::freshSeed();
    for (const volume::Lattice &lattice : lattices()) {
        const classify::DensityField shown = field(lattice, seed);
        for (const double voxelsPerPixel : {1.0 / 3.0, 1.7})
            for (const int width : {3, 4, 5, 7}) {
                Narrowed narrowed(sceneOf(lattice, voxelsPerPixel, width), shown);
                int differing = 0;
                for (const glm::dquat &view : views(seed))
                    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
                        const auto [predicted, measured] = narrowed.errorFrom(view, tolerance);
                        EXPECT_LE(measured, predicted + rounding)
                            << GetParam().name << " " << voxelsPerPixel << " " << width;
                        EXPECT_LE(predicted, tolerance);
                        differing += measured > 0.0 ? 1 : 0;
                    }
                if (voxelsPerPixel < 1.0) {
                    EXPECT_GT(differing, 4) << GetParam().name;
                }
            }
    }
}

TEST_P(AdaptiveWidths, DifferNoMoreThanPredictedUnderCuesAndLights) {
    const unsigned seed = test::freshSeed();
    shading::Shading lit, sine, curve, linear;
    lit.ambient = 0.3;
    lit.lights.resize(2);
    lit.lights[0].direction = {0.4, 0.6, 1.0};
    lit.lights[1] = {{-1.0, 0.2, 0.3}, {1.0, 0.5, 0.2}, 0.7};
    sine.cue.kind = shading::CueKind::sine;
    sine.cue.strength = 0.8;
    curve.cue.kind = shading::CueKind::curve;
    curve.cue.curve = {1.0, 0.8, 0.3, 0.2};
    curve.cue.strength = 1.0;
    linear.cue = {shading::CueKind::linear, 0.8};
    shading::Shading litLinear = lit;
    litLinear.cue = linear.cue;
    const volume::Lattice lattice = lattices()[1];
    const classify::DensityField shown = field(lattice, seed);
    for (const shading::Shading &shading : {lit, sine, curve, linear, litLinear}) {
        scene::Scene scene = sceneOf(lattice, 1.0 / 3.0, 4);
        scene.shading = shading;
        Narrowed narrowed(scene, shown);
        int differing = 0;
        for (const glm::dquat &view : views(seed))
            for (const double tolerance : {1e-2, 1e-3}) {
                const auto [predicted, measured] = narrowed.errorFrom(view, tolerance);
                EXPECT_LE(measured, predicted + rounding) << GetParam().name;
                EXPECT_LE(predicted, tolerance);
                differing += measured > 0.0 ? 1 : 0;
            }
        // With a linear cue, frequencies are only left out.
        EXPECT_GT(differing, shading.cue.hasMoments() ? 0 : 4) << GetParam().name;
    }
}

// The point of narrower kernels: a smooth field needs few taps.
TEST(WidthShares, ASmoothFieldReadsLessThanHalfOfTheTaps) {
    const volume::Lattice lattice = lattices()[0];
    const volume::Volume blob = test::volumeOf(
        lattice, [](const glm::dvec3 &mm) { return std::exp(-glm::dot(mm, mm) / 100.0); });
    scene::Scene scene = sceneOf(lattice, 1.0, 5);
    scene.interpolation = {};
    scene.tolerance = 1e-2;
    const auto prepared = prepare::prepareEngine(
        scene, classify::ShownFields{{classify::densityField(blob, {0.0, 1.0})}, {}}, {});
    picture::FrameTimes times;
    prepared.engine->render(scene.camera, scene.image, {}, &times);
    const auto &shares = times.widthShares;
    const int widest = prepared.plan.spectrum.width();
    double all = 0.0, taps = 0.0;
    for (std::size_t width = 0; width < shares.size(); ++width) {
        all += shares[width];
        taps += shares[width] * std::pow(double(width) / widest, 3);
    }
    EXPECT_NEAR(all, 1.0, 1e-9);
    EXPECT_LT(taps, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Shapes, AdaptiveWidths, testing::ValuesIn(shapes),
                         [](const auto &shape) { return std::to_string(shape.index); });

} // namespace

} // namespace pellucid
