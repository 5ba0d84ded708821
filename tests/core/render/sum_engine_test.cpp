// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include "core/plan/reasons.h"
#include "core/plan/sum_plan.h"
#include "core/prepare/prepared_engine.h"
#include "core/reference/shaded_field.h"
#include "core/render/sum_engine.h"
#include "core/task/error.h"
#include "tests/support/fields.h"

// Pictures from sums along the view, without a spectrum of the volume.
namespace pellucid {

namespace {

using scene::Reconstruction;
using scene::StandardView;

struct Subject {
    classify::ShownFields fields;
    scene::Scene scene;
    plan::RenderPlan plan;

    explicit Subject(classify::ShownFields shown, const scene::ImageDefinition &image = {})
        : fields(std::move(shown)), scene(sceneOf(fields, image)), plan(planOf(fields, scene)) {}

    // An engine on so wide a grid that hardly any tails fold back.
    render::SumEngine wideEngine() const {
        plan::RenderPlan wide = plan;
        wide.fieldOfView.aliasingLimit = 1e-6;
        return {fields, wide};
    }
    double sumError() const { return plan::sumError(plan.spectrum.box.size()); }
    double error(render::SumEngine &engine) const {
        return test::relativeL2(engine.render(scene.camera, scene.image).samples,
                                reference::shadedImage(fields, {}, scene.camera, scene.image));
    }

private:
    static scene::Scene sceneOf(const classify::ShownFields &fields,
                                const scene::ImageDefinition &image) {
        scene::Scene scene;
        scene.image = image;
        scene.camera = scene::defaultCamera(fields.channels.front().values.lattice());
        scene.camera.panMm = {3.2, -1.7};
        scene.camera.width = std::max(40, scene.camera.width);
        scene.camera.height = std::max(40, scene.camera.height) - 6;
        return scene;
    }
    static plan::RenderPlan planOf(const classify::ShownFields &fields, const scene::Scene &scene) {
        const auto summaries =
            field::summarise(std::span<const classify::DensityField>(fields.channels));
        return plan::planSums(scene, summaries, prepare::compositionOf(fields.channels.size(), {}))
            .value();
    }
};

const std::vector<std::pair<StandardView, scene::ViewAngles>> directions{
    {StandardView::front, {}},
    {StandardView::top, {}},
    {StandardView::left, {}},
    {StandardView::front, {30.0, 0.0, 0.0}},
    {StandardView::left, {12.0, 40.0, 7.0}},
    {StandardView::bottom, {50.0, -33.0, 120.0}},
    {StandardView::left, {0.0, 1e-5, 0.0}},
    {StandardView::top, {45.0, 45.0, 45.0}}};

// With a wide roll-off, what remains is the error of the sums.
TEST(SumEngine, MakesTheExactPictureFromEveryDirection) {
    for (const volume::Lattice &lattice :
         {volume::Lattice::centred({31, 26, 22}, {1.0, 1.0, 1.0}),
          volume::Lattice::centred({40, 36, 7}, {0.7, 0.7, 5.0}),
          volume::Lattice::centred({25, 30, 1}, {1.0, 1.0, 3.0}),
          volume::Lattice::centred({1, 1, 1}, {1.0, 1.0, 1.0}),
          test::tiltedLattice({30, 26, 19}, {0.8, 1.0, 2.1}, 15.0)})
        for (const auto reconstruction : {Reconstruction::cubic, Reconstruction::linear,
                                          Reconstruction::bandLimited, Reconstruction::spline}) {
            Subject subject({{test::noiseField(lattice, 3)}, {}},
                            {.reconstruction = reconstruction, .rollOff = 0.8});
            render::SumEngine engine = subject.wideEngine();
            for (const double zoom : {1.0, 1.7, 0.4})
                for (const auto &[view, angles] : directions) {
                    scene::Camera &camera = subject.scene.camera;
                    camera.orientation = scene::viewOrientation(view, angles);
                    camera.pixelMm = lattice.shortestStepMm() / zoom;
                    EXPECT_LE(subject.error(engine), subject.sumError())
                        << lattice.size().k << " " << int(reconstruction) << " " << zoom;
                }
        }
}

TEST(SumEngine, KeepsItsBound) {
    const auto lattice = test::tiltedLattice({30, 26, 19}, {0.8, 1.0, 2.1}, 15.0);
    for (const scene::ImageDefinition &image :
         {scene::ImageDefinition{}, scene::ImageDefinition{.detail = 3.0, .detailMm = 2.0}}) {
        Subject subject({{test::noiseField(lattice, 7), test::noiseField(lattice, 8)},
                         {{{1.0, 0.4, 0.1}, {0.3, 0.6, 1.0}}}},
                        image);
        render::SumEngine engine(subject.fields, subject.plan);
        for (const auto &[width, height] : {std::pair(40, 32), {37, 21}, {301, 163}}) {
            scene::Camera &camera = subject.scene.camera;
            camera.orientation = scene::viewOrientation(StandardView::left, {12.0, 40.0, 7.0});
            camera.width = width;
            camera.height = height;
            EXPECT_LE(subject.error(engine), subject.plan.predictedError)
                << image.rollOff << " " << width;
        }
    }
}

// Part of the lattice is empty: rows, columns, planes, and rows within the box.
TEST(SumEngine, ReadsOnlyTheBoxOfItsField) {
    const auto lattice = volume::Lattice::centred({70, 34, 45}, {1.0, 1.2, 0.9});
    std::vector<float> samples(lattice.size().count(), 0.0F);
    for (int k = 4; k < 41; ++k)
        for (int j = 5; j < 30; ++j)
            for (int i = 9; i < 60; ++i)
                if ((j + k) % 5 != 0)
                    samples[lattice.size().offsetOf(i, j, k)] = float((i * j + k) % 17);
    Subject subject({{classify::fieldOf(volume::Volume(lattice, std::vector<float>(samples),
                                                       volume::ValueUnit::none),
                                        std::move(samples))},
                     {}},
                    {.rollOff = 0.8});
    ASSERT_EQ(subject.fields.channels.front().support.lo.i, 9);
    render::SumEngine engine = subject.wideEngine();
    for (const auto &[view, angles] : directions) {
        subject.scene.camera.orientation = scene::viewOrientation(view, angles);
        EXPECT_LE(subject.error(engine), subject.sumError()) << int(view);
    }
}

TEST(SumEngine, GivesTheSameBitsForAnyNumberOfThreads) {
    const auto lattice = volume::Lattice::centred({90, 80, 70}, {1.0, 1.0, 1.0});
    Subject subject({{test::noiseField(lattice, 5)}, {}});
    subject.scene.camera.pixelMm = 0.4; // many blocks of rows
    for (const auto &[view, angles] : directions) {
        subject.scene.camera.orientation = scene::viewOrientation(view, angles);
        const auto render = [&](std::size_t threads) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            return render::SumEngine(subject.fields, subject.plan)
                .render(subject.scene.camera, subject.scene.image)
                .samples;
        };
        EXPECT_EQ(render(1), render(4));
    }
}

TEST(SumEngine, ShowsThePeriodOfItsPicture) {
    const auto lattice = volume::Lattice::centred({31, 26, 22}, {1.0, 1.0, 1.0});
    Subject subject({{test::noiseField(lattice, 3)}, {}});
    scene::Camera &camera = subject.scene.camera;
    camera.orientation = scene::viewOrientation(StandardView::left, {12.0, 40.0, 7.0});
    render::SumEngine engine(subject.fields, subject.plan);
    const auto picture = engine.render(camera, subject.scene.image);
    const auto period = engine.renderPeriod(camera, subject.scene.image);
    for (int r = 0; r < camera.height; ++r)
        for (int c = 0; c < camera.width; ++c)
            ASSERT_NEAR(
                picture.samples[std::size_t(r * camera.width + c)],
                period.image
                    .samples[std::size_t((period.top + r) * period.image.width + period.left + c)],
                1e-4);
    const auto stated = prepare::measuredError(engine, subject.fields, camera, subject.scene.image);
    EXPECT_LE(subject.error(engine), 1.1 * stated.high);
}

// Fields of other boxes, one of them empty in most planes.
TEST(SumEngine, MixesTheFieldsOfALook) {
    const auto lattice = volume::Lattice::centred({40, 34, 30}, {1.0, 1.2, 0.9});
    const auto blockAt = [&](int first, int last) {
        std::vector<float> samples(lattice.size().count(), 0.0F);
        for (int n = first; n < last; ++n)
            samples[lattice.size().offsetOf(n, n, n)] = 1.0F;
        return classify::fieldOf(
            volume::Volume(lattice, std::vector<float>(samples), volume::ValueUnit::none),
            std::move(samples));
    };
    Subject subject({{blockAt(3, 25), blockAt(20, 30)}, {{{1.0, 0.4, 0.1}, {0.3, 0.6, 1.0}}}},
                    {.rollOff = 0.8});
    render::SumEngine engine = subject.wideEngine();
    for (const auto &[view, angles] : directions) {
        subject.scene.camera.orientation = scene::viewOrientation(view, angles);
        EXPECT_LE(subject.error(engine), std::sqrt(2.0) * subject.sumError());
    }
}

TEST(SumEngine, IsChosenForOnePictureOfALargeVolume) {
    const auto lattice = volume::Lattice::centred({128, 128, 128}, {1.0, 1.0, 1.0});
    const classify::ShownFields fields{{test::noiseField(lattice, 3)}, {}};
    scene::Scene scene;
    scene.camera = scene::defaultCamera(lattice);
    const auto prepared = [&](int pictures) {
        return prepare::prepareEngine(
            {.scene = scene, .fields = fields, .mayBeSums = true, .pictures = pictures});
    };
    const auto one = prepared(1);
    ASSERT_TRUE(one.sums);
    EXPECT_FALSE(one.engine);
    EXPECT_LE(one.plan.predictedError, scene.tolerance);
    EXPECT_LT(one.plan.bytes, prepared(2).plan.bytes);
    EXPECT_TRUE(prepared(2).engine);
    EXPECT_TRUE(prepare::prepareEngine({.scene = scene, .fields = fields, .pictures = 1}).engine);
    const scene::Scene plain = scene;
    scene.tolerance = 1e-5; // the sums round more
    EXPECT_TRUE(prepared(1).engine);
    scene = plain;
    scene.interpolation.padding = 1.5;
    EXPECT_TRUE(prepared(1).engine);
    scene = plain;
    scene.plannedFor = scene::PlannedFor::volume;
    EXPECT_TRUE(prepared(1).engine);
    scene = plain;
    scene.shading.cue = {shading::CueKind::linear, 1.0};
    EXPECT_TRUE(prepared(1).engine);
    scene = plain;
    scene.camera.pixelMm = 0.1; // the sums would need more cells than the spectrum
    EXPECT_TRUE(prepared(1).engine);
}

// The error names the sums' need, not that of a spectrum.
TEST(SumEngine, NamesTheLeastMemoryThatIsEnough) {
    const auto lattice = volume::Lattice::centred({128, 128, 128}, {1.0, 1.0, 1.0});
    const classify::ShownFields fields{{test::noiseField(lattice, 3)}, {}};
    scene::Scene scene;
    scene.camera = scene::defaultCamera(lattice);
    const auto prepared = [&](std::size_t bytes) {
        return prepare::prepareEngine({.scene = scene,
                                       .fields = fields,
                                       .budget = {bytes},
                                       .mayBeSums = true,
                                       .pictures = 1});
    };
    const std::size_t enough = prepared(std::size_t(1) << 30).plan.bytes;
    EXPECT_TRUE(prepared(enough).sums);
    try {
        prepared(enough / 16);
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.reason().english(),
                  task::Reason(
                      task::because::projectionNeedsMemory((enough >> 20) + 1, (enough / 16) >> 20))
                      .english());
    }
}

TEST(SumEngine, IsNotForSamplesThatMayCancel) {
    const auto lattice = volume::Lattice::centred({20, 20, 20}, {1.0, 1.0, 1.0});
    classify::DensityField field = test::noiseField(lattice);
    std::vector<float> samples(lattice.size().count(), 1.0F);
    samples[17] = -1.0F;
    field.values = volume::Volume(lattice, std::move(samples), volume::ValueUnit::none);
    scene::Scene scene;
    scene.camera = scene::defaultCamera(lattice);
    const field::Summary summary = field::summarise(field);
    EXPECT_FALSE(plan::planSums(scene, {&summary, 1}, {}));
}

TEST(SumEngine, StopsWhenItIsCancelled) {
    const auto lattice = volume::Lattice::centred({31, 26, 22}, {1.0, 1.0, 1.0});
    const Subject subject({{test::noiseField(lattice, 3)}, {}});
    std::stop_source stop;
    stop.request_stop();
    render::SumEngine engine(subject.fields, subject.plan, task::Progress(stop.get_token()));
    for (const auto &[view, angles] : directions) {
        scene::Camera camera = subject.scene.camera;
        camera.orientation = scene::viewOrientation(view, angles);
        EXPECT_THROW(engine.render(camera, subject.scene.image), task::Cancelled);
    }
}

} // namespace
} // namespace pellucid
