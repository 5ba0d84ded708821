// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/phantom/phantom.h"
#include "core/picture/compose.h"
#include "core/prepare/prepared_engine.h"
#include "core/task/error.h"

namespace pellucid::picture {

namespace {

struct Study {
    explicit Study(phantom::Kind kind, int side = 96)
        : Study(phantom::makePhantom(kind, phantom::phantomLattice(
                                               kind, {.size = volume::GridSize{side, side, side}})),
                {-900, 2000}) {}
    Study(const volume::Volume &shown, const classify::FieldWindow &window) : volume(shown) {
        scene.camera = scene::defaultCamera(volume.lattice());
        scene.plannedFor = scene::PlannedFor::volume;
        engine = prepare::prepareEngine({scene, classify::shownFields(volume, window, {}, nullptr)})
                     .engine;
    }
    scene::Exposure exposure(const scene::Tone &tone = {}) const {
        return measureExposure(*engine, volume.lattice(), scene.image, scene.shading, tone,
                               backgroundOf(volume));
    }
    // In the middle row of the front view, `x` mm from its middle.
    int frontGrey(const scene::Tone &tone, double x) const {
        const auto front = scene::viewOrientation(scene::StandardView::front);
        const ProjectionImage image = seen(front);
        const Pixels pixels = compose(image, displayOf(tone, front));
        const int c = int(std::lround(0.5 * (image.width - 1) + x / image.pixelMm));
        return int(pixels[4 * (std::size_t(image.height / 2) * std::size_t(image.width) +
                               std::size_t(c))]);
    }
    ProjectionImage seen(const glm::dquat &orientation) const {
        scene::Camera camera = scene.camera;
        camera.orientation = orientation;
        return engine->render(camera, scene.image, scene.shading);
    }
    // The greys of the body in a view, ascending.
    std::vector<int> greys(const glm::dquat &orientation, const scene::Tone &tone) const {
        const ProjectionImage image = seen(orientation);
        const Display display = displayOf(tone, orientation);
        const Pixels pixels = compose(image, display);
        std::vector<int> greys;
        for (std::size_t n = 0; n < image.samples.size(); ++n)
            if (double(image.samples[n]) > display.airFade)
                greys.push_back(pixels[4 * n]);
        std::sort(greys.begin(), greys.end());
        return greys;
    }

    volume::Volume volume;
    scene::Scene scene;
    std::shared_ptr<render::ProjectionEngine> engine;
};

int at(const std::vector<int> &sorted, double share) {
    return sorted[std::size_t(share * double(sorted.size() - 1))];
}

} // namespace

// The body spreads over the greys in every standard view, and between them.
TEST(Exposure, SpreadsTheBodyOverTheGreys) {
    for (const phantom::Kind kind : {phantom::Kind::chest, phantom::Kind::head}) {
        const Study study(kind);
        scene::Tone tone;
        tone.exposure = study.exposure();
        for (const auto &view :
             {scene::viewOrientation(scene::StandardView::front),
              scene::viewOrientation(scene::StandardView::left),
              scene::viewOrientation(scene::StandardView::top),
              scene::viewOrientation(scene::StandardView::front, {30.0, 20.0, 0.0})}) {
            const auto greys = study.greys(view, tone);
            ASSERT_GT(greys.size(), 500U);
            EXPECT_GE(at(greys, 0.985), 200);
            EXPECT_LE(at(greys, 0.98), 254); // just below white
            EXPECT_LE(at(greys, 0.05), 90);
            EXPECT_GE(at(greys, 0.5), 100);
            EXPECT_LE(at(greys, 0.5), 175);
        }
    }
}

TEST(Exposure, IsTheSameWhateverTheView) {
    const Study study(phantom::Kind::chest, 64);
    const scene::Exposure first = study.exposure();
    study.seen(scene::viewOrientation(scene::StandardView::top));
    EXPECT_EQ(study.exposure(), first);
    const scene::Exposure chosen = study.exposure({.detail = 0.1, .latitude = 0.9});
    EXPECT_EQ(chosen.detail, 0.1);
    EXPECT_EQ(chosen.latitude, 0.9);
    EXPECT_EQ(chosen.axes[1].bright, first.axes[1].bright);
}

// The greys change smoothly: a turn by a degree moves the ends by less than a fiftieth.
TEST(Exposure, DoesNotFlickerWhileTheViewTurns) {
    const Study study(phantom::Kind::chest, 64);
    scene::Tone tone;
    tone.exposure = study.exposure();
    for (int degrees = 0; degrees < 360; ++degrees) {
        const auto displayAt = [&](double azimuth) {
            return displayOf(tone, scene::viewOrientation(scene::StandardView::front,
                                                          {azimuth, 0.4 * azimuth, 0.0}));
        };
        const ToneRange now = displayAt(degrees).range, next = displayAt(degrees + 1).range;
        const double width = now.high - now.low;
        EXPECT_NEAR(now.low, next.low, 0.02 * width);
        EXPECT_NEAR(now.high, next.high, 0.02 * width);
    }
}

// Along an axis, the display is that axis' own; the ends that the user sets replace the automatic
// ones.
TEST(Exposure, UserEndsReplaceTheAutomaticOnes) {
    scene::Tone tone;
    tone.exposure.emplace();
    for (std::size_t n = 0; n < 3; ++n)
        tone.exposure->axes[n] = {
            0.0, 1.0, 10.0 + double(n), 2.0, 20.0 + double(n), 1.0 + 0.1 * double(n)};
    const auto front = scene::viewOrientation(scene::StandardView::back);
    EXPECT_NEAR(displayOf(tone, front).range.high, 21.0, 1e-9);
    EXPECT_NEAR(displayOf(tone, front).exponent, 1.1, 1e-9);
    EXPECT_NEAR(displayOf(tone, front).contrast.bright, 11.0, 1e-9);
    tone.high = 5.0;
    tone.inverted = true;
    EXPECT_EQ(displayOf(tone, front).range.high, 5.0);
    EXPECT_TRUE(displayOf(tone, front).inverted);
    const Display plain = plainDisplayOf({.exposure = tone.exposure}, front);
    EXPECT_TRUE(plain.contrast.isOff());
    EXPECT_EQ(plain.range.low, 0.0);
    EXPECT_NEAR(plain.range.high, 11.0, 1e-9);
}

// The box is that of the body, within the pixels that it is measured by.
TEST(Exposure, FindsTheBoxOfTheBody) {
    std::vector<std::int16_t> samples(std::size_t(60) * 50 * 40, -1000);
    for (int k = 5; k < 30; ++k)
        for (int j = 20; j < 45; ++j)
            for (int i = 10; i < 30; ++i)
                samples[std::size_t((k * 50 + j) * 60 + i)] = 40;
    Study study(phantom::Kind::cube, 8);
    study.volume = volume::Volume(volume::Lattice::centred({60, 50, 40}, {2, 2, 2}),
                                  std::move(samples), volume::ValueUnit::hounsfield);
    study.scene.camera = scene::defaultCamera(study.volume.lattice());
    study.engine =
        prepare::prepareEngine(
            {study.scene, classify::shownFields(study.volume, {-900, 2000}, {}, nullptr)})
            .engine;
    const scene::Exposure exposure = study.exposure();
    const glm::dvec3 low{-40, -10, -30}, high{0, 40, 20};
    const double pixel = 2.0 * study.volume.lattice().radiusMm() / 320.0;
    for (int n = 0; n < 3; ++n) {
        // Interpolation adds up to half a voxel of faint shadow.
        EXPECT_NEAR(exposure.lowMm[n], low[n], 1.5 + pixel) << n;
        EXPECT_NEAR(exposure.highMm[n], high[n], 1.5 + pixel) << n;
    }
}

// Values without a unit have air above zero: it is black, and no measure of the body.
TEST(Exposure, AirOfValuesWithoutAUnitIsBlack) {
    std::vector<float> samples(std::size_t(60) * 60 * 60, 0.25F);
    const auto lattice = volume::Lattice::centred({60, 60, 60}, {3, 3, 3});
    for (int k = 0; k < 60; ++k)
        for (int j = 0; j < 60; ++j)
            for (int i = 0; i < 60; ++i)
                if ((i - 30) * (i - 30) + (j - 30) * (j - 30) < 18 * 18)
                    samples[std::size_t((k * 60 + j) * 60 + i)] = 1.0F;
    const Study study(volume::Volume(lattice, samples, volume::ValueUnit::none), {0.0, 1.0});
    scene::Tone tone;
    tone.exposure = study.exposure();
    EXPECT_NEAR(tone.exposure->axes[1].air, 1.1 * 0.25 * 60 * 3, 3.0);
    EXPECT_LE(study.frontGrey(tone, -75.0), 3); // within the volume, beside the body
    EXPECT_GE(study.frontGrey(tone, 0.0), 180);
    EXPECT_NEAR(tone.exposure->lowMm.x, -54.0, 5.0);
}

// The same in an oblique volume, whose corners are all that its outer columns show.
TEST(Exposure, AirOfAnObliqueVolumeIsFound) {
    constexpr int side = 60;
    std::vector<float> samples(std::size_t(side) * side * side, 0.15F);
    for (int k = 20; k < 40; ++k)
        for (int j = 20; j < 40; ++j)
            for (int i = 20; i < 40; ++i)
                samples[std::size_t((k * side + j) * side + i)] = 3.0F;
    const glm::dmat3 turn =
        glm::mat3_cast(glm::normalize(glm::dquat(1.0, 0.07, 0.07, 0.07))); // 14 degrees
    const auto lattice = volume::Lattice::make(
        {side, side, side}, {turn * glm::dvec3(-88.5)},
        {turn * glm::dvec3(3, 0, 0), turn * glm::dvec3(0, 3, 0), turn * glm::dvec3(0, 0, 3)});
    const Study study(volume::Volume(lattice, samples, volume::ValueUnit::none), {0.0, 1.0});
    scene::Tone tone;
    tone.exposure = study.exposure();
    for (const scene::Exposure::Axis &axis : tone.exposure->axes)
        EXPECT_NEAR(axis.air, 1.1 * 0.15 * 184, 6.0); // the cube is 180 mm thick, or somewhat more
    EXPECT_GE(study.frontGrey(tone, 0.0), 180);
    EXPECT_LE(study.frontGrey(tone, -65.0), 12); // within the volume, beside the body
}

// A class without air: the flank of a dim body beside something bright is not air, so the body
// stays visible.
TEST(Exposure, ABodyWithoutAirIsNotTakenForAir) {
    constexpr int side = 100;
    ProjectionImage image{side, side, 1.0, Samples(std::size_t(side) * side, 0.0F)};
    for (int r = 0; r < side; ++r)
        for (int c = 0; c < side; ++c) {
            const int x = c - 50, y = r - 45;
            float &sample = image.samples[std::size_t(r) * side + std::size_t(c)];
            if (x * x + y * y < 40 * 40)
                sample = 1.0F + 0.2F * float(x) / 40.0F;
            if (std::abs(x - 20) < 6 && std::abs(y - 30) < 12)
                sample += 8.0F;
        }
    scene::Tone tone;
    tone.exposure = exposureOf(image, tone, Background::measured);
    EXPECT_EQ(tone.exposure->axes[0].air, 0.0);
    const glm::dquat front = scene::viewOrientation(scene::StandardView::front);
    const Pixels pixels = compose(image, displayOf(tone, front));
    EXPECT_GT(int(pixels[4 * (45 * side + 30)]), 20);
}

TEST(Exposure, AnEmptyPictureHasADisplay) {
    const ProjectionImage image{8, 8, 1.0, Samples(64, 0.0F)};
    scene::Tone tone;
    tone.exposure = exposureOf(image, tone);
    EXPECT_NO_THROW(scene::validate(*tone.exposure));
    for (const std::uint8_t byte : compose(image, displayOf(tone, {1, 0, 0, 0})))
        EXPECT_TRUE(byte == 0 || byte == 255);
    const ProjectionImage flat{8, 8, 1.0, Samples(64, 7.0F)};
    tone.exposure = exposureOf(flat, tone);
    EXPECT_NO_THROW(scene::validate(*tone.exposure));
    EXPECT_GT(compose(flat, displayOf(tone, {1, 0, 0, 0}))[0], 100);
}

} // namespace pellucid::picture
