// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/prepare/prepared_engine.h"
#include "core/render/cpu_engine.h"
#include "tests/support/fields.h"

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
    // A peak of a few frequencies, anywhere in a tile.
    {"wave in a window",
     [](const glm::dvec3 &mm, std::mt19937 &) {
         const auto hann = [](double at) { return std::pow(std::cos(std::numbers::pi * at), 2.0); };
         return hann(mm.x / 61.0) * hann(mm.y / 61.0) * hann(mm.z / 61.0) *
                (0.5 + 0.05 * std::cos(2.0 * std::numbers::pi * 0.27 * glm::dot(oblique, mm)));
     }},
    // Narrow kernels blur the faint part much more than the bright one.
    {"bright middle",
     [](const glm::dvec3 &mm, std::mt19937 &random) {
         return std::exp(-glm::dot(mm, mm) / 20.0) +
                0.01 * inBall(mm) * std::uniform_real_distribution<double>()(random);
     }},
    {"box",
     [](const glm::dvec3 &mm, std::mt19937 &) {
         return std::abs(mm.x) < 20.0 && std::abs(mm.y) < 14.0 && std::abs(mm.z) < 24.0 ? 1.0 : 0.0;
     }},
};

class FrameWidths : public testing::TestWithParam<Shape> {
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

constexpr double rounding = 3e-7;

// Pictures by several widths beside those that one kernel reads from the same spectra.
class Narrowed {
public:
    Narrowed(const scene::Scene &scene, const classify::DensityField &field)
        : m_scene(scene),
          m_whole(prepare::prepareEngine({scene, classify::ShownFields{{field}, {}}}).engine),
          m_parts(m_whole->parts()) {
        const auto energiesOf = [](const render::EngineSpectra::Spectra &spectra) {
            widths::AdaptiveWidths::Energies energies;
            for (const auto &spectrum : spectra)
                energies.push_back(std::make_shared<const widths::BlockEnergies>(*spectrum));
            return energies;
        };
        m_adaptive = {std::make_shared<const fourier::KernelsByWidth>(
                          m_parts.spectra.fields.front()->layout()),
                      energiesOf(m_parts.spectra.fields), energiesOf(m_parts.spectra.gradients)};
    }

    // The distance from the picture that one kernel reads, over the tolerance.
    double errorFrom(const glm::dquat &view, double tolerance) {
        m_scene.camera.orientation = view;
        m_adaptive.tolerance = tolerance;
        const auto render = [&](picture::Projector &engine) {
            return engine.render(m_scene.camera, m_scene.image, m_scene.shading).samples;
        };
        render::CpuEngine narrow(m_parts.spectra, m_parts.fieldOfView);
        narrow.setChannelWeights(m_parts.channelWeights);
        narrow.setWidths(std::make_shared<const widths::AdaptiveWidths>(m_adaptive));
        return std::max(0.0, test::relativeL2(render(narrow), render(*m_whole)) - rounding) /
               tolerance;
    }

private:
    scene::Scene m_scene;
    std::shared_ptr<render::ProjectionEngine> m_whole;
    render::EngineParts m_parts;
    widths::AdaptiveWidths m_adaptive;
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

// The errors of many pictures. A few lines of the slice estimate each with three standard errors to
// spare: hardly any is above the tolerance, and none by much; a peak that no line crosses may
// double it.
class Errors {
public:
    void add(double ofTolerance) {
        ++m_count;
        m_above += ofTolerance > 1.0 ? 1 : 0;
        m_spent += ofTolerance > 0.0 ? 1 : 0;
        m_largest = std::max(m_largest, ofTolerance);
    }
    ~Errors() {
        EXPECT_LE(m_largest, 2.0) << m_name;
        EXPECT_LE(m_above, 1 + m_count / 50) << m_name;
        EXPECT_GE(m_spent, m_least) << m_name;
    }
    Errors(const char *name, int least) : m_name(name), m_least(least) {}
    Errors(const Errors &) = delete;
    Errors &operator=(const Errors &) = delete;

private:
    const char *m_name;
    int m_least;
    int m_count = 0, m_above = 0, m_spent = 0;
    double m_largest = 0.0;
};

constexpr unsigned seed = 7;

TEST_P(FrameWidths, StayWithinTheTolerance) {
    Errors errors(GetParam().name, 32);
    for (const volume::Lattice &lattice : lattices()) {
        const classify::DensityField shown = field(lattice, seed);
        for (const double voxelsPerPixel : {1.0 / 3.0, 1.7})
            for (const int width : {3, 4, 5, 7}) {
                Narrowed narrowed(sceneOf(lattice, voxelsPerPixel, width), shown);
                for (const glm::dquat &view : views(seed))
                    for (const double tolerance : {1e-2, 1e-3, 1e-4})
                        errors.add(narrowed.errorFrom(view, tolerance));
            }
    }
}

TEST_P(FrameWidths, StayWithinTheToleranceUnderCuesAndLights) {
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
    Errors errors(GetParam().name, 20);
    for (const shading::Shading &shading : {lit, sine, curve, linear, litLinear}) {
        scene::Scene scene = sceneOf(lattice, 1.0 / 3.0, 4);
        scene.shading = shading;
        Narrowed narrowed(scene, shown);
        for (const glm::dquat &view : views(seed))
            for (const double tolerance : {1e-2, 1e-3})
                errors.add(narrowed.errorFrom(view, tolerance));
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
        {scene, classify::ShownFields{{classify::densityField(blob, {0.0, 1.0})}, {}}});
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

INSTANTIATE_TEST_SUITE_P(Shapes, FrameWidths, testing::ValuesIn(shapes),
                         [](const auto &shape) { return std::to_string(shape.index); });

} // namespace

} // namespace pellucid
