// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <memory>
#include <numeric>

#include <tbb/global_control.h>

#include "core/fourier/transforms/padded_size.h"
#include "core/phantom/phantom.h"
#include "core/prepare/prepared_engine.h"
#include "core/render/cpu_engine.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

struct Subject {
    classify::DensityField field;
    render::CpuEngine engine;
    scene::Camera camera;

    explicit Subject(classify::DensityField f, double tolerance = scene::Scene().tolerance)
        : Subject(f, plan(f, tolerance).spectrum) {}
    Subject(classify::DensityField f, const fourier::SpectrumLayout &layout)
        : field(std::move(f)), engine(std::make_shared<const fourier::Spectrum>(
                                   fourier::Spectrum::prepare(field.values, layout))),
          camera(scene::defaultCamera(field.values.lattice())) {}

    static plan::RenderPlan plan(const classify::DensityField &f, double tolerance) {
        scene::Scene scene;
        scene.camera = scene::defaultCamera(f.values.lattice());
        scene.tolerance = tolerance;
        return plan::planRender(scene, field::summarise(f));
    }
};

// Linear to rounding: cells in float, and one kernel whatever the field.
fourier::SpectrumLayout linearLayout(const volume::Lattice &lattice) {
    const auto kernel = fourier::Kernel::leastAliasing(5, 1.5);
    const auto padded = [&](int d) { return fourier::paddedSize(lattice.size()[d], 1.5); };
    return {{kernel, kernel, kernel},
            lattice.bounds(),
            {padded(0), padded(1), padded(2)},
            fourier::Storage::float32};
}

Subject headSubject(double tolerance = scene::Scene().tolerance) {
    const auto lattice =
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{72, 70, 40},
                                                      .spacingMm = glm::dvec3(3.2, 3.3, 6.0),
                                                      .tiltRad = 0.3});
    const auto volume = phantom::makePhantom(phantom::Kind::head, lattice);
    return Subject(classify::densityField(volume, classify::defaultFieldWindow(volume)), tolerance);
}

double sum(const picture::ProjectionImage &image) {
    return std::accumulate(image.samples.begin(), image.samples.end(), 0.0) * image.pixelMm *
           image.pixelMm;
}

// Over a period the image sums to the field's own sum, exactly. What of it lies outside the image
// are aliases, which the tolerance limits and which change sign, so that at most a fifth of it
// remains, and tails of the exact image, which are 4e-7 here.
TEST(Invariants, TheMeanIsTheFieldsSumForEveryView) {
    for (const double tolerance : {1.1e-3, 1e-4, 1e-5}) {
        Subject head = headSubject(tolerance);
        double mass = 0.0;
        head.field.values.asVolume().visit(
            [&](auto samples) { mass = std::accumulate(samples.begin(), samples.end(), 0.0); });
        mass *= head.field.values.lattice().cellVolumeMm3();
        std::mt19937 random(3);
        for (int view = 0; view < 50; ++view) {
            head.camera.orientation = test::randomOrientation(random);
            EXPECT_NEAR(sum(head.engine.render(head.camera, {})) / mass, 1.0,
                        0.2 * tolerance + 2e-6);
        }
    }
}

TEST(Invariants, OppositeViewsMirror) {
    // p(-W) with the same V is p(W) with columns reversed: the same frequencies, conjugated. They
    // differ by rounding in float, and by the roll-off's symmetric treatment of even sizes: not at
    // all.
    Subject head = headSubject();
    head.camera.orientation = scene::viewOrientation(scene::StandardView::left, {12, 25, 5});
    const auto front = head.engine.render(head.camera, {});
    const auto axes = head.camera.axes();
    head.camera.orientation = glm::quat_cast(glm::dmat3(-axes[0], axes[1], -axes[2]));
    const auto back = head.engine.render(head.camera, {});
    std::vector<float> mirrored(back.samples.size());
    for (int r = 0; r < head.camera.height; ++r)
        for (int c = 0; c < head.camera.width; ++c)
            mirrored[std::size_t(r) * head.camera.width + c] =
                back.samples[std::size_t(r) * head.camera.width + head.camera.width - 1 - c];
    EXPECT_LT(test::relativeL2(mirrored, front.samples), 2e-6);
}

TEST(Invariants, TheSliceOfASumIsTheSumOfTheSlices) {
    const auto lattice = test::tiltedLattice({20, 18, 10}, {1, 1, 2}, 15);
    const auto a = test::noiseField(lattice, 1), b = test::noiseField(lattice, 2);
    std::vector<float> both(lattice.size().count());
    a.values.samples().visit([&](auto x) {
        b.values.samples().visit([&](auto y) {
            for (std::size_t n = 0; n < both.size(); ++n)
                both[n] = float(x[n] + y[n]);
        });
    });
    const auto layout = linearLayout(lattice);
    Subject one(a, layout), two(b, layout),
        sumOf({volume::Volume(lattice, both, volume::ValueUnit::none), lattice.bounds()}, layout);
    std::mt19937 random(9);
    sumOf.camera.orientation = test::randomOrientation(random);
    const auto pa = one.engine.render(sumOf.camera, {}), pb = two.engine.render(sumOf.camera, {});
    const auto p = sumOf.engine.render(sumOf.camera, {});
    picture::Samples added(pa.samples);
    for (std::size_t n = 0; n < added.size(); ++n)
        added[n] += pb.samples[n];
    EXPECT_LT(test::relativeL2(added, p.samples), 1e-6); // float rounding of a few hundred terms
}

TEST(Invariants, TheSameBitsForAnyNumberOfThreads) {
    const auto render = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Subject head = headSubject();
        head.camera.orientation = scene::viewOrientation(scene::StandardView::front, {10, 20, 30});
        return head.engine.render(head.camera, {}).samples;
    };
    EXPECT_EQ(render(1), render(2));
}

// Where a view meets the grid its frequencies lie on the edges of the kernels, which may jump
// there: directions that differ by rounding alone must read the same cells.
TEST(Invariants, ViewsAlongTheGridDoNotDependOnRounding) {
    for (const double thickness : {1.0, 8.0}) {
        const auto lattice = volume::Lattice::centred({24, 20, 16}, {0.5, 1.0, thickness});
        const auto field = test::noiseField(lattice);
        scene::Scene scene{.camera = scene::defaultCamera(lattice)};
        scene.camera.pixelMm = 0.75 / 2.0;    // thirds of a cell from column to column
        scene.interpolation.isUniform = true; // widths may change wherever the error allows it
        const auto prepared = prepare::prepareEngine({scene, classify::ShownFields{{field}, {}}});
        std::mt19937 random(6);
        std::normal_distribution<double> tiny(0.0, 1e-14);
        for (const auto view :
             {scene::StandardView::front, scene::StandardView::left, scene::StandardView::top}) {
            scene.camera.orientation = scene::viewOrientation(view);
            const auto exact = prepared.engine->render(scene.camera, scene.image);
            for (int n = 0; n < 4; ++n) {
                scene::Camera camera = scene.camera;
                camera.orientation = glm::normalize(
                    camera.orientation * glm::dquat(1.0, tiny(random), tiny(random), tiny(random)));
                EXPECT_LT(test::relativeL2(prepared.engine->render(camera, scene.image).samples,
                                           exact.samples),
                          3e-6) // floats
                    << thickness;
            }
        }
    }
}

} // namespace
} // namespace pellucid
