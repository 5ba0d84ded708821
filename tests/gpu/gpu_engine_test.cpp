// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include "app/bench/subjects.h"
#include "core/prepare/prepared_engine.h"
#include "core/task/error.h"
#include "gpu/gpu_engine.h"
#include "tests/gpu/card.h"
#include "tests/support/fields.h"
#include "tests/support/json_text.h"

namespace pellucid {

namespace {

using fourier::Storage;
using shading::CueKind;
using shading::Shading;

// The largest difference of both engines under the same plan. Both read the same bits and sum in
// float, so binary16 leaves no more than float32.
constexpr double withinFloat32 = 2e-5, withinBinary16 = 2e-5;

class GpuEngine : public test::CardTest {
protected:
    static std::vector<glm::dquat> views() {
        std::mt19937 random(3);
        return {test::randomOrientation(random), scene::viewOrientation(scene::StandardView::front),
                scene::viewOrientation(scene::StandardView::left, {.azimuthDeg = 30.0})};
    }

    // The largest difference of the engines over the views, relative L2.
    static double difference(const scene::Scene &asked, const classify::ShownFields &fields,
                             std::size_t maxTextureBytes = std::size_t(1) << 30) {
        scene::Scene scene = asked;
        const auto prepared = prepare::prepareEngine({scene, fields});
        const render::EngineParts parts = prepared.engine->parts();
        gpu::GpuEngine engine(
            gpu::SpectrumTextures::upload(card, parts.spectra, {}, maxTextureBytes),
            parts.channelWeights, parts.fieldOfView, parts.adaptive);
        double worst = 0.0;
        for (const glm::dquat &view : views()) {
            scene.camera.orientation = view;
            const auto expected = prepared.engine->render(scene.camera, scene.image, scene.shading);
            const auto found = engine.render(scene.camera, scene.image, scene.shading);
            EXPECT_EQ(found.channels, expected.channels);
            EXPECT_EQ(found.width, expected.width);
            EXPECT_EQ(found.samples.size(), expected.samples.size());
            worst = std::max(worst, test::relativeL2(found.samples, expected.samples));
        }
        return worst;
    }

    static classify::ShownFields tiltedNoise() {
        return {{test::noiseField(test::tiltedLattice({36, 30, 21}, {0.8, 1.0, 2.1}, 20.0))}, {}};
    }
    static scene::Scene sceneOf(const classify::ShownFields &fields) {
        scene::Scene scene;
        scene.camera = scene::defaultCamera(fields.channels.front().values.lattice());
        // A software renderer takes minutes to compile wider slices; `EveryWidth` has them all.
        scene.interpolation.kernel = fourier::kernelFromName("LS4");
        return scene;
    }
};

class HardField : public GpuEngine, public testing::WithParamInterface<std::size_t> {};

TEST_P(HardField, IsTheProcessorsPicture) {
    const classify::ShownFields fields{{bench::hardSubjects()[GetParam()].make()}, {}};
    scene::Scene scene = sceneOf(fields);
    scene.interpolation.storage = Storage::float32;
    EXPECT_LE(difference(scene, fields), withinFloat32);
    scene.interpolation.storage = Storage::binary16;
    EXPECT_LE(difference(scene, fields), withinBinary16);
}

std::string nameOf(const testing::TestParamInfo<std::size_t> &info) {
    std::string name = bench::hardSubjects()[info.param].name;
    for (char &c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0)
            c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Fields, HardField,
                         testing::Range(std::size_t(0), bench::hardSubjects().size()), nameOf);

TEST_F(GpuEngine, EveryWidthAndFamilyOfKernels) {
    const auto fields = tiltedNoise();
    for (const char *kernel : {"nearest", "trilinear", "catmull-rom", "b-spline", "hamming-sinc",
                               "ES6", "KB4", "LS2", "LS3", "LS4", "LS5", "LS7"}) {
        scene::Scene scene = sceneOf(fields);
        scene.interpolation.kernel = fourier::kernelFromName(kernel);
        scene.interpolation.padding = 2.0;
        scene.interpolation.storage = Storage::float32;
        EXPECT_LE(difference(scene, fields), withinFloat32) << kernel;
    }
}

TEST_F(GpuEngine, NarrowKernelsReadASmoothField) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1.0, 1.0, 1.0});
    const classify::ShownFields fields{
        {classify::densityField(
            test::volumeOf(lattice,
                           [](const glm::dvec3 &mm) { return std::exp(-glm::dot(mm, mm) / 50.0); }),
            {0.0, 1.0})},
        {}};
    scene::Scene scene = sceneOf(fields);
    scene.tolerance = 1e-2;
    EXPECT_LE(difference(scene, fields), withinBinary16);
    const auto parts = prepare::prepareEngine({scene, fields}).engine->parts();
    ASSERT_TRUE(parts.adaptive);
    gpu::GpuEngine engine(gpu::SpectrumTextures::upload(card, parts.spectra, {}, 1U << 30U),
                          parts.channelWeights, parts.fieldOfView, parts.adaptive);
    picture::FrameTimes times;
    engine.render(scene.camera, scene.image, {}, &times);
    EXPECT_GE(std::count_if(times.widthShares.begin(), times.widthShares.end(),
                            [](double share) { return share > 0.0; }),
              2);
}

TEST_F(GpuEngine, EveryReconstructionAndFraming) {
    const auto fields = tiltedNoise();
    const scene::Camera whole = sceneOf(fields).camera;
    scene::Camera fine = whole, moved = whole, wide = whole, tiny = whole;
    fine.pixelMm *= 0.4; // frequencies beyond the samples' own: the spectrum is periodic
    moved.panMm = {7.3, -4.1};
    moved.width = 31;
    wide.width = 201; // odd, and larger than the period
    wide.height = 167;
    tiny.width = tiny.height = 1;
    const auto expectAlike = [&](const scene::Camera &camera, const scene::ImageDefinition &image) {
        scene::Scene scene = sceneOf(fields);
        scene.camera = camera;
        scene.image = image;
        scene.interpolation.storage = Storage::float32;
        EXPECT_LE(difference(scene, fields), withinFloat32)
            << int(image.reconstruction) << " " << image.rollOff << " " << camera.width << " x "
            << camera.height << ", pan " << camera.panMm.x;
    };
    using scene::Reconstruction;
    for (const auto reconstruction : {Reconstruction::cubic, Reconstruction::linear,
                                      Reconstruction::bandLimited, Reconstruction::spline}) {
        for (const double rollOff : {0.0, 1.0})
            expectAlike(whole, {reconstruction, rollOff});
        for (const scene::Camera &camera : {whole, fine, moved, wide, tiny})
            expectAlike(camera, {reconstruction, 0.05});
    }
}

TEST_F(GpuEngine, CuesAndLights) {
    const auto fields = tiltedNoise();
    const shading::DepthCue linear{CueKind::linear, 0.9}, sine{CueKind::sine, 1.0};
    const shading::DepthCue curve{CueKind::curve, 0.8, {0.2, 1.5, 0.4, 1.0}};
    const std::vector<shading::Light> grey{{{1, 1, 0.6}}};
    const std::vector<shading::Light> colored{{{1, 0, 0}, {1.0, 0.2, 0.0}},
                                              {{0, 1, 1}, {0.0, 1.0, 0.5}, 0.7}};
    const std::vector<shading::Light> opposite{{{1, 0, 0}}, {{-1, 0, 0}}};
    for (const Shading &shading :
         {Shading{.cue = linear}, Shading{.cue = sine}, Shading{.cue = curve},
          Shading{.ambient = 0.3}, Shading{.ambient = 0.3, .lights = grey},
          Shading{.ambient = 0.0, .lights = colored}, Shading{.lights = opposite},
          Shading{.cue = linear, .ambient = 0.5, .lights = grey},
          Shading{.cue = linear, .ambient = 0.5, .lights = colored},
          Shading{.cue = sine, .ambient = 0.5, .lights = colored}})
        for (const Storage storage : {Storage::float32, Storage::binary16}) {
            // A software renderer compiles again for each format, which takes seconds.
            if (storage == Storage::binary16 && shading.lights.size() != 1)
                continue;
            scene::Scene scene = sceneOf(fields);
            scene.shading = shading;
            scene.interpolation.storage = storage;
            EXPECT_LE(difference(scene, fields),
                      storage == Storage::float32 ? withinFloat32 : withinBinary16)
                << shading::jsonOf(shading).dump();
        }
}

// Three channels of their own, two fields in two colors, one in a color, and all under colored
// light.
TEST_F(GpuEngine, Colors) {
    const auto lattice = test::tiltedLattice({36, 30, 21}, {0.8, 1.0, 2.1}, 20.0);
    const classify::ShownFields channels{
        {test::noiseField(lattice, 1), test::noiseField(lattice, 2), test::noiseField(lattice, 3)},
        classify::primaries};
    const classify::ShownFields mixed{{test::noiseField(lattice, 1), test::noiseField(lattice, 2)},
                                      {{{1.0, 0.4, 0.1}, {0.2, 0.3, 0.9}}}};
    const classify::ShownFields colored{{test::noiseField(lattice, 1)}, {{{1.0, 0.4, 0.1}}}};
    const std::vector<shading::Light> light{{{1, 0, 0.3}, {0.2, 1.0, 0.7}}};
    for (const auto &fields : {channels, mixed, colored})
        for (const Shading &shading :
             {Shading{}, Shading{.cue = {CueKind::linear, 1.0}}, Shading{.lights = light}}) {
            scene::Scene scene = sceneOf(fields);
            scene.shading = shading;
            scene.interpolation.storage = Storage::float32;
            EXPECT_LE(difference(scene, fields), withinFloat32) << shading::jsonOf(shading).dump();
        }
}

// There are as many layers as the card reads at once, and their channel weights change.
TEST_F(GpuEngine, LayersWithMovingShares) {
    const auto lattice = test::tiltedLattice({20, 22, 15}, {0.8, 1.0, 2.1}, 20.0);
    std::vector<classify::DensityField> fields;
    for (unsigned n = 0; n < 16; ++n)
        fields.push_back(test::noiseField(lattice, n));
    scene::Scene scene{.camera = scene::defaultCamera(lattice)};
    scene.interpolation.kernel = fourier::kernelFromName("LS4"); // as in sceneOf
    const auto plan = plan::planRender(scene, field::summarise(fields), {3});
    render::EngineSpectra spectra;
    for (const auto &field : fields)
        spectra.fields.push_back(std::make_shared<const fourier::Spectrum>(
            fourier::Spectrum::prepare(field.values, plan.spectrum)));
    spectra.scale = shading::shadingScale(lattice);
    render::CpuEngine processor(spectra, plan.fieldOfView);
    const auto engine = gpu::copyToCard(card, processor);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(0.0, 2.0);
    for (const bool grey : {true, false}) {
        std::vector<render::ChannelWeights> channelWeights(fields.size());
        for (auto &share : channelWeights) {
            share = {uniform(random), uniform(random), uniform(random)};
            if (grey)
                share[1] = share[2] = share[0];
        }
        channelWeights[5] = {0.0, 0.0, 0.0}; // costs nothing, and must not be read
        processor.setChannelWeights(channelWeights);
        const auto expected = processor.render(scene.camera, scene.image);
        const auto found =
            engine->withChannelWeights(channelWeights)->render(scene.camera, scene.image);
        EXPECT_EQ(found.channels, grey ? 1 : 3);
        EXPECT_LE(test::relativeL2(found.samples, expected.samples), withinBinary16);
    }
    // Nothing is shown.
    const std::vector<render::ChannelWeights> none(fields.size(), {0.0, 0.0, 0.0});
    const auto dark = engine->withChannelWeights(none)->render(scene.camera, scene.image);
    EXPECT_EQ(dark.samples.size(), std::size_t(dark.width) * std::size_t(dark.height));
    EXPECT_EQ(*std::max_element(dark.samples.begin(), dark.samples.end()), 0.0F);
}

TEST_F(GpuEngine, ASpectrumInSeveralTextures) {
    const auto fields = tiltedNoise();
    scene::Scene scene = sceneOf(fields);
    scene.interpolation.storage = Storage::float32;
    const auto prepared = prepare::prepareEngine({scene, fields});
    const auto whole = gpu::SpectrumTextures::upload(card, prepared.engine->parts().spectra);
    ASSERT_EQ(whole->layout().slabs, 1);
    const std::size_t bytes = whole->bytes();
    for (const std::size_t parts : {2U, 5U}) {
        const auto slabs = gpu::SpectrumTextures::upload(card, prepared.engine->parts().spectra, {},
                                                         bytes / parts);
        EXPECT_GE(slabs->layout().slabs, int(parts));
        EXPECT_EQ(slabs->fieldPages(), slabs->layout().slabs);
        EXPECT_LE(difference(scene, fields, bytes / parts), withinFloat32) << parts;
    }
    scene.shading.lights.push_back({{1, 0, 0}});
    EXPECT_LE(difference(scene, fields, bytes / 2), withinFloat32);
}

// Images whose lines are longer than the card's shared memory, both ways.
TEST_F(GpuEngine, LongImages) {
    const auto fields = tiltedNoise();
    scene::Scene scene = sceneOf(fields);
    scene.interpolation.storage = Storage::float32;
    scene.camera.width = 9000;
    scene.camera.height = 5;
    EXPECT_LE(difference(scene, fields), withinFloat32);
    std::swap(scene.camera.width, scene.camera.height);
    EXPECT_LE(difference(scene, fields), withinFloat32);
}

TEST_F(GpuEngine, LightsGoOut) {
    const auto fields = tiltedNoise();
    scene::Scene scene = sceneOf(fields);
    scene.shading.lights.push_back({{1, 0, 0}});
    const auto prepared = prepare::prepareEngine({scene, fields});
    const auto lit = gpu::copyToCard(card, *prepared.engine);
    const auto unlit = lit->withoutLight();
    EXPECT_LT(unlit->textures().bytes(), lit->textures().bytes());
    const auto expected =
        prepare::withoutLight(prepared).engine->render(scene.camera, scene.image, scene.shading);
    const auto found = unlit->render(scene.camera, scene.image, scene.shading);
    EXPECT_LE(test::relativeL2(found.samples, expected.samples), withinBinary16);
}

// A picture must not be overwritten while it is held.
TEST_F(GpuEngine, PicturesKeepTheirPixels) {
    const auto fields = tiltedNoise();
    scene::Scene scene = sceneOf(fields);
    const auto prepared = prepare::prepareEngine({scene, fields});
    const auto engine = gpu::copyToCard(card, *prepared.engine);
    std::vector<std::shared_ptr<const gpu::CardPicture>> held;
    std::vector<picture::Samples> first;
    for (int n = 0; n < 7; ++n) {
        scene.camera.orientation =
            scene::viewOrientation(scene::StandardView::front, {.azimuthDeg = 10.0 * n});
        held.push_back(engine->renderOnCard(scene.camera, scene.image));
        first.push_back(held.back()->download().samples);
    }
    for (std::size_t n = 0; n < held.size(); ++n) {
        EXPECT_EQ(held[n]->download().samples, first[n]);
        if (n > 0) {
            EXPECT_NE(first[n], first[n - 1]);
        }
    }
}

TEST_F(GpuEngine, TooLargeSpectraAndSlicesAreRefused) {
    const auto fields = tiltedNoise();
    scene::Scene scene = sceneOf(fields);
    const auto prepared = prepare::prepareEngine({scene, fields});
    const auto expectTooLarge = [](const std::function<void()> &what) {
        try {
            what();
            ADD_FAILURE() << "was not refused";
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::outOfMemory) << error.what();
        }
    };
    // The spectrum needs more textures than there are units.
    expectTooLarge([&] {
        gpu::SpectrumTextures::upload(card, prepared.engine->parts().spectra, {},
                                      std::size_t(1) << 15);
    });
    // A slice that exceeds a buffer is refused, and then the engine still works.
    const auto engine = gpu::copyToCard(card, *prepared.engine);
    const double cells = double(card->device().capabilities().storageBytes) / 8.0;
    const double side = 1.2 * std::sqrt(2.0 * cells); // half the columns
    if (side < 60000.0) {
        scene::Camera large = scene.camera;
        large.pixelMm *= large.width / (2.0 * side);
        expectTooLarge([&] { engine->renderOnCard(large, scene.image); });
    }
    const auto expected = prepared.engine->render(scene.camera, scene.image);
    EXPECT_LE(test::relativeL2(engine->render(scene.camera, scene.image).samples, expected.samples),
              withinBinary16);
}

TEST_F(GpuEngine, CopyingCanBeCancelled) {
    const auto fields = tiltedNoise();
    const auto prepared = prepare::prepareEngine({sceneOf(fields), fields});
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(gpu::copyToCard(card, *prepared.engine, task::Progress(stop.get_token())),
                 task::Cancelled);
}

} // namespace
} // namespace pellucid
