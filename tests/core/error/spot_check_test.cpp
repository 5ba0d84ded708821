// SPDX-License-Identifier: GPL-3.0-or-later
// What is measured of a picture's error, against its error by the double-precision reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "core/error/checked_pictures.h"
#include "core/error/shown_part.h"
#include "core/prepare/measured_error.h"
#include "core/prepare/prepared_engine.h"
#include "core/reference/wide_kernel.h"
#include "core/scene/planning_scene.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using FieldValue = std::function<float(const glm::dvec3 &)>; // of a place in -1..1

struct Kind {
    const char *name;
    FieldValue value;
};

// Fields that are hard to project, or to judge.
const std::vector<Kind> kinds{
    {"smooth", [](const glm::dvec3 &x) { return float(std::exp(-4.0 * glm::dot(x, x))); }},
    {"two corners",
     [](const glm::dvec3 &x) {
         return std::min({x.x, x.y, x.z}) > 0.9 || std::max({x.x, x.y, x.z}) < -0.9 ? 1.0F : 0.0F;
     }},
    {"oblique sheet",
     [](const glm::dvec3 &x) {
         return std::abs(x.x + 0.37 * x.y - 0.61 * x.z) < 0.03 ? 1.0F : 0.0F;
     }},
    {"two faces", [](const glm::dvec3 &x) { return std::abs(x.z) > 0.99 ? 1.0F : 0.0F; }},
    {"rod", [](const glm::dvec3 &x) { return std::hypot(x.x, x.y - 0.3) < 0.05 ? 1.0F : 0.0F; }},
    {"wave",
     [](const glm::dvec3 &x) {
         return float(0.5 + 0.5 * std::sin(glm::dot(x, glm::dvec3(40.0, 11.0, 23.0))));
     }},
    {"shell", [](const glm::dvec3 &x) {
         const double r = glm::length(x);
         return r > 0.7 && r < 0.76 ? 1.0F : 0.0F;
     }}};

classify::DensityField fieldOf(const volume::Lattice &lattice, const FieldValue &value) {
    const glm::dvec3 half(0.5 * (lattice.size().i - 1), 0.5 * (lattice.size().j - 1),
                          0.5 * (lattice.size().k - 1));
    return classify::fieldOf(test::volumeOf(lattice, [&](const glm::dvec3 &mm) {
        return value((lattice.voxel({mm}).v - half) / half);
    }));
}

scene::Scene sceneOf(const volume::Lattice &lattice, double tolerance) {
    scene::Scene scene;
    scene.tolerance = tolerance;
    scene.camera = scene::defaultCamera(lattice);
    return scene;
}

// A picture of a field, its error, and the engine that made it.
class Checked {
public:
    Checked(const classify::DensityField &field, const scene::Scene &scene)
        : m_fields{{field}, {}}, m_scene(scene),
          m_engine(prepare::prepareEngine({scene, m_fields}).engine),
          truth(test::relativeL2(m_engine->render(scene.camera, scene.image).samples,
                                 reference::WideKernel(field.values, field.support)
                                     .image(scene.camera, scene.image))) {}
    error::StatedError stated(const error::CheckEffort &effort = {}) const {
        return prepare::measuredError(*m_engine, m_fields, m_scene.camera, m_scene.image, {},
                                      effort);
    }

private:
    classify::ShownFields m_fields;
    scene::Scene m_scene;
    std::shared_ptr<render::ProjectionEngine> m_engine;

public:
    const double truth;
};

} // namespace

// Where every frequency is summed, the measurement is the error, but for what folds back.
TEST(SpotCheck, MeasuresTheErrorOfHardFields) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1});
    for (const Kind &kind : kinds) {
        const auto field = fieldOf(lattice, kind.value);
        for (const double tolerance : {1e-2, 1.1e-3, 1e-4})
            for (const glm::dvec3 &turn : {glm::dvec3(20, 30, 40), {0, 45, 0}}) {
                scene::Scene scene = sceneOf(lattice, tolerance);
                scene.camera.orientation =
                    scene::viewOrientation(scene::StandardView::front, {turn.x, turn.y, turn.z});
                const Checked one(field, scene);
                const error::StatedError stated = one.stated({.multiplications = 1e12});
                EXPECT_LE(stated.low, 1.001 * one.truth) << kind.name << " " << tolerance;
                EXPECT_GE(1.1 * stated.high, one.truth) << kind.name << " " << tolerance;
                EXPECT_TRUE(stated.isMeasured());
            }
    }
}

// Far from the volume, a picture is larger than the period of its slice, and repeats itself.
TEST(SpotCheck, CountsWhatAPictureRepeats) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1});
    for (const Kind &kind : kinds) {
        const auto field = fieldOf(lattice, kind.value);
        for (const double tolerance : {3e-2, 1.1e-3}) {
            scene::Scene scene = sceneOf(lattice, tolerance);
            scene.camera.width *= 3;
            scene.camera.height *= 2;
            const Checked one(field, scene);
            const error::StatedError stated = one.stated({.multiplications = 1e12});
            EXPECT_LE(stated.low, 1.001 * one.truth) << kind.name << " " << tolerance;
            EXPECT_GE(stated.high, one.truth) << kind.name << " " << tolerance;
        }
    }
}

// Samples of the frequencies: the error is within the interval, but for the part of it that lies
// beside the picture; and the same seed finds the same.
TEST(SpotCheck, ItsSampleFindsTheErrorOfAllFrequencies) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1});
    int outside = 0, all = 0;
    for (const Kind &kind : kinds) {
        const auto field = fieldOf(lattice, kind.value);
        const Checked one(field, sceneOf(lattice, 1.1e-3));
        for (unsigned seed = 1; seed <= 10; ++seed, ++all) {
            const error::CheckEffort effort{.multiplications = 0.0, .atLeast = 512, .seed = seed};
            const error::StatedError stated = one.stated(effort);
            const bool isOutside = one.truth > stated.high || one.truth < stated.low;
            outside += isOutside ? 1 : 0;
            EXPECT_LE(one.truth, 1.1 * stated.high) << kind.name << " " << seed;
            EXPECT_LE(stated.frequencies, 512 + 150);
            if (seed == 1) {
                EXPECT_EQ(one.stated(effort), stated);
            }
        }
    }
    EXPECT_LE(outside, all / 20);
}

// Where only the tolerance counts, a quarter of the frequencies is enough to show that a picture
// keeps it: of 1,024, beside the hundred brightest and those near zero.
TEST(SpotCheck, EndsWhenItsUpperLimitIsLowEnough) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1});
    const Checked one(fieldOf(lattice, kinds.front().value), sceneOf(lattice, 1.1e-3));
    error::CheckEffort effort{.multiplications = 0.0, .atLeast = 1024, .within = 0.0};
    EXPECT_GE(one.stated(effort).frequencies, 1024);
    effort.enough = 1.1e-3;
    const error::StatedError stated = one.stated(effort);
    EXPECT_LE(stated.frequencies, 256 + 150);
    EXPECT_LE(stated.high, effort.enough);
    EXPECT_GE(1.1 * stated.high, one.truth);
}

// A picture that something has spoilt says so.
TEST(SpotCheck, FindsWhatHasSpoiltAPicture) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1});
    const auto field = fieldOf(lattice, kinds.front().value);
    const scene::Scene scene = sceneOf(lattice, 1.1e-3);
    const auto engine = prepare::prepareEngine({scene, classify::ShownFields{{field}, {}}}).engine;
    const picture::PeriodPicture whole = engine->renderPeriod(scene.camera, scene.image);
    const auto measured = [&](const std::function<void(picture::Samples &)> &spoil,
                              const error::CheckEffort &effort) {
        picture::PeriodPicture spoilt = whole;
        spoil(spoilt.image.samples);
        double change = 0.0, energy = 0.0; // in the part that is shown
        for (int y = whole.top; y < whole.top + whole.height; ++y)
            for (int x = whole.left; x < whole.left + whole.width; ++x) {
                const auto n = std::size_t(y) * std::size_t(whole.image.width) + std::size_t(x);
                change += std::pow(double(spoilt.image.samples[n] - whole.image.samples[n]), 2);
                energy += std::pow(double(whole.image.samples[n]), 2);
            }
        const auto error = prepare::measuredError(
            [&](const task::Progress &) {
                return classify::ShownFields{{field}, {}};
            },
            shading::shadingScale(lattice), spoilt, scene.image, {}, effort);
        return std::pair(error.relative, std::sqrt(change / energy));
    };
    const int width = whole.image.width;
    const std::vector<std::function<void(picture::Samples &)>> faults{
        [&](picture::Samples &s) { // a row of the transform
            for (int x = 0; x < width; ++x)
                s[std::size_t(whole.image.height / 2) * std::size_t(width) + std::size_t(x)] *=
                    1.5F;
        },
        [](picture::Samples &s) { // a card that returns noise
            std::mt19937 random(1);
            std::normal_distribution<float> noise(0.0F, 5.0F);
            for (float &sample : s)
                sample += noise(random);
        },
        [&](picture::Samples &s) { // a pixel with a flipped bit
            s[s.size() / 2 + std::size_t(width / 2 + 1)] *= 4.0F;
        },
        [&](picture::Samples &s) { // moved by a pixel
            std::rotate(s.begin(), s.begin() + 1, s.end());
        }};
    for (const auto &fault : faults) {
        const auto [found, made] = measured(fault, {.multiplications = 1e12});
        EXPECT_GT(made, scene.tolerance);
        EXPECT_NEAR(found, made, 0.01 * made);
        // A sample of the frequencies finds it too, wherever in the period it is.
        EXPECT_GT(measured(fault, {.multiplications = 0.0}).first, 0.5 * made);
    }
}

// A coarse picture is measured against the study.
TEST(SpotCheck, MeasuresWhatACoarsePictureLacks) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1}),
               coarse = volume::Lattice::centred({20, 20, 20}, {2, 2, 2});
    const auto field = fieldOf(lattice, kinds.back().value),
               less = fieldOf(coarse, kinds.back().value);
    const scene::Scene scene = sceneOf(lattice, 1.1e-3);
    const auto engine = prepare::prepareEngine({scene, classify::ShownFields{{less}, {}}}).engine;
    const auto exact =
        reference::WideKernel(field.values, field.support).image(scene.camera, scene.image);
    const double truth = test::relativeL2(engine->render(scene.camera, scene.image).samples, exact);
    const auto stated = prepare::measuredError(*engine, {{field}, {}}, scene.camera, scene.image);
    EXPECT_GT(truth, 0.01);
    EXPECT_NEAR(stated.relative, truth, 0.1 * truth);
}

// The error must be that of the part, not of the whole period, which would be of 1,800 x 1,800 of
// these pixels. The waves fill the body, so that the error is nearly the same everywhere.
TEST(SpotCheck, OfAZoomedPictureIsThatOfItsPart) {
    const auto lattice = volume::Lattice::centred({64, 64, 64}, {1, 1, 1});
    const auto field = fieldOf(lattice, kinds[5].value);
    scene::Scene scene = sceneOf(lattice, 1.1e-3);
    scene.interpolation.isUniform = true;
    const auto engine = prepare::prepareEngine({scene, classify::ShownFields{{field}, {}}}).engine;
    scene::Camera camera = scene.camera;
    camera.pixelMm /= 16.0;
    camera.width = camera.height = 160;
    const scene::Camera checked = prepare::checkedCamera(camera, lattice);
    EXPECT_EQ(checked.pixelMm, 0.25);
    EXPECT_EQ(checked.width, 40);
    const auto stated = prepare::measuredError(*engine, {{field}, {}}, camera, scene.image);
    const double truth = test::relativeL2(
        engine->render(camera, scene.image).samples,
        reference::WideKernel(field.values, field.support).image(camera, scene.image));
    EXPECT_LE(truth, stated.high);
    EXPECT_GT(stated.relative, truth / 3.0);
    EXPECT_LT(stated.relative, 3.0 * truth);
    EXPECT_GE(stated.frequencies, 256); // a sample of them, not all
    EXPECT_LT(stated.frequencies, 4096);
}

// Beside the body a picture is mostly its own error: how much truth there is, it cannot tell.
TEST(SpotCheck, OfAPartBesideTheBodyMayBeAnyNumber) {
    const auto lattice = volume::Lattice::centred({64, 64, 64}, {1, 1, 1});
    const auto field =
        fieldOf(lattice, [](const glm::dvec3 &at) { return glm::length(at) < 0.45 ? 1.0F : 0.0F; });
    scene::Scene scene = sceneOf(lattice, 1.1e-3);
    const auto engine = prepare::prepareEngine({scene, classify::ShownFields{{field}, {}}}).engine;
    scene::Camera camera = scene.camera;
    camera.pixelMm = 0.25;
    camera.width = camera.height = 40;
    const reference::WideKernel exact(field.values, field.support);
    double worst = 0.0;
    for (const double pan : {0.0, 12.0, 16.0, 20.0, 24.0, 30.0}) {
        camera.panMm = {pan, 0.0};
        const auto stated = prepare::measuredError(*engine, {{field}, {}}, camera, scene.image);
        const double truth = test::relativeL2(engine->render(camera, scene.image).samples,
                                              exact.image(camera, scene.image));
        EXPECT_LE(stated.low, truth) << pan;
        EXPECT_LE(truth, stated.high) << pan;
        EXPECT_LT(stated.frequencies, 4096) << pan; // a sample of them, not all
        worst = std::max(worst, truth);
    }
    EXPECT_GT(worst, 1.0);
}

// A packet of waves near the edge of the band has its tails in one direction; beside it, they fold
// back into the picture.
TEST(SpotCheck, ItsUpperLimitCoversTheTailsOfARegularPattern) {
    const auto lattice = volume::Lattice::centred({48, 48, 48}, {1, 1, 1});
    struct View {
        glm::dvec3 turns; // of the wave, per sample
        glm::dquat orientation;
        glm::dvec2 panMm;
    };
    scene::Scene scene = sceneOf(lattice, 0.1);
    scene.camera.width = scene.camera.height = 24;
    for (const auto &[turns, orientation, pan] :
         {View{{0.32, -0.045, 0.283}, {0.0339, 0.3062, -0.8565, -0.4141}, {-25.9, 34.58}},
          View{{0.0, 0.0, 0.475}, {0.8721, 0.2297, 0.4205, -0.0992}, {-21.07, -37.71}},
          View{{0.098, -0.3, -0.309}, {0.2031, 0.2106, 0.6881, 0.664}, {36.59, -22.97}}}) {
        const auto field = fieldOf(lattice, [&](const glm::dvec3 &x) {
            const glm::dvec3 samples = 23.5 * x;
            return float(0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * glm::dot(turns, samples)) *
                                   std::exp(-glm::dot(samples, samples) / 94.0));
        });
        scene.camera.orientation = glm::normalize(orientation);
        scene.camera.panMm = pan;
        const auto engine =
            prepare::prepareEngine(
                {.scene = scene, .fields = classify::ShownFields{{field}, {}}, .pictures = 1})
                .engine;
        const auto stated =
            prepare::measuredError(*engine, {{field}, {}}, scene.camera, scene.image);
        EXPECT_LE(test::relativeL2(engine->render(scene.camera, scene.image).samples,
                                   reference::WideKernel(field.values, field.support)
                                       .image(scene.camera, scene.image)),
                  stated.high)
            << pan.x;
    }
}

// A picture of pixels that are too small to be checked, where every frequency is summed.
TEST(SpotCheck, OfTooSmallPixelsIsThatOfAnyPlaceInThePart) {
    const auto lattice = volume::Lattice::centred({24, 24, 24}, {1, 1, 1});
    const auto field = fieldOf(lattice, kinds.back().value); // the shell
    scene::Scene scene = sceneOf(lattice, 0.1);
    const auto engine = prepare::prepareEngine({scene, classify::ShownFields{{field}, {}}}).engine;
    scene::Camera camera = scene.camera;
    camera.width = camera.height = 12;
    camera.pixelMm = 0.12;
    const reference::WideKernel exact(field.values, field.support);
    for (const double pan : {0.0, 4.0, 8.0}) {
        camera.panMm = {pan, 0.3 * pan};
        const auto stated = prepare::measuredError(*engine, {{field}, {}}, camera, scene.image);
        const double truth = test::relativeL2(engine->render(camera, scene.image).samples,
                                              exact.image(camera, scene.image));
        EXPECT_LE(stated.low, truth) << pan;
        EXPECT_LE(truth, stated.high) << pan;
    }
}

// Without a roll-off, the frequency (.6, .8) of this grid is on the edge of the band.
TEST(SpotCheck, CountsNoFrequencyOnTheEdgeOfTheBand) {
    constexpr int side = 20;
    const auto lattice = volume::Lattice::centred({8, 8, 8}, {1, 1, 1});
    const auto field = fieldOf(lattice, kinds.front().value);
    picture::PeriodPicture period;
    period.camera = sceneOf(lattice, 1.1e-3).camera;
    period.camera.width = period.camera.height = side;
    period.image = {side, side, period.camera.pixelMm, picture::Samples(side * side, 0.0F), 1};
    period.image.samples[side * side / 2 + side / 2] = 1.0F;
    period.width = period.height = period.pictureWidth = period.pictureHeight = side;
    const auto stated = prepare::measuredError(
        [&](const auto &) {
            return classify::ShownFields{{field}, {}};
        },
        shading::shadingScale(lattice), period, {.rollOff = 0.0}, {});
    EXPECT_TRUE(std::isfinite(stated.relative) && std::isfinite(stated.high));
}

TEST(SpotCheck, OfAnEmptyPictureIsZero) {
    const auto lattice = volume::Lattice::centred({12, 12, 12}, {1, 1, 1});
    const auto field = fieldOf(lattice, [](const glm::dvec3 &) { return 0.0F; });
    const error::StatedError stated = Checked(field, sceneOf(lattice, 1.1e-3)).stated();
    EXPECT_EQ(stated.relative, 0.0);
    EXPECT_EQ(stated.high, 0.0);
}

TEST(CheckedPictures, AreTheFirstTheLastAndSixOthers) {
    using error::CheckedPictures;
    for (const std::size_t count : {1, 2, 8, 9, 10, 36, 361}) {
        std::size_t checked = 0;
        for (std::size_t n = 0; n < count; ++n) {
            checked += error::isChecked(CheckedPictures::rest, n, count) ? 1 : 0;
            EXPECT_TRUE(error::isChecked(CheckedPictures::all, n, count));
            EXPECT_FALSE(error::isChecked(CheckedPictures::none, n, count));
        }
        EXPECT_EQ(checked, std::min<std::size_t>(count, 8));
        EXPECT_TRUE(error::isChecked(CheckedPictures::rest, 0, count));
        EXPECT_TRUE(error::isChecked(CheckedPictures::rest, count - 1, count));
    }
}

TEST(ShownPart, EndsWhereACornerIsBesideThePicture) {
    const auto lattice = volume::Lattice::centred({10, 10, 10}, {1, 1, 1});
    scene::Camera camera = scene::defaultCamera(lattice);
    EXPECT_EQ(error::shownOf(lattice.bounds(), lattice, camera), error::Shown::whole);
    camera.panMm.x += 0.5 * camera.width * camera.pixelMm;
    EXPECT_EQ(error::shownOf(lattice.bounds(), lattice, camera), error::Shown::part);
    // The picture ends in the middle of the body.
    EXPECT_NEAR(error::shownShare(lattice.bounds(), lattice, camera), 0.5, 1e-12);
    camera.panMm.x *= 2.0;
    EXPECT_EQ(error::shownShare(lattice.bounds(), lattice, camera), 0.0);
}

} // namespace pellucid
