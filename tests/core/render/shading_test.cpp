// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <random>

#include <glm/geometric.hpp>

#include "core/phantom/phantom.h"
#include "core/prepare/prepared_engine.h"
#include "core/reference/shaded_field.h"
#include "core/reference/wide_kernel.h"
#include "core/shading/gradient_magnitude.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using scene::StandardView;
using shading::CueKind;
using shading::DepthCue;
using shading::Light;
using shading::Shading;

volume::Volume headVolume() {
    const auto lattice =
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{72, 70, 40},
                                                      .spacingMm = glm::dvec3(3.2, 3.3, 6.0),
                                                      .tiltRad = 0.3});
    return phantom::makePhantom(phantom::Kind::head, lattice);
}

classify::DensityField headField() {
    const volume::Volume volume = headVolume();
    return classify::densityField(volume, classify::defaultFieldWindow(volume));
}

struct Named {
    const char *name;
    Shading shading;
};

std::ostream &operator<<(std::ostream &out, const Named &named) {
    return out << named.name;
}

// An oblique view, one from the front, and one along an axis, where the aliases are in phase.
std::vector<glm::dquat> someViews() {
    std::mt19937 random(5);
    return {test::randomOrientation(random), scene::viewOrientation(StandardView::front),
            scene::viewOrientation(StandardView::left)};
}

// A scene of a field, its engine, and the truth of every view.
struct Subject {
    classify::ShownFields fields;
    scene::Scene scene;
    prepare::PreparedEngine prepared;

    Subject(classify::ShownFields shown, const Shading &shading, double tolerance = 1.1e-3,
            const scene::Interpolation &interpolation = {})
        : fields(std::move(shown)),
          scene({.camera = scene::defaultCamera(fields.channels.front().values.lattice()),
                 .shading = shading,
                 .tolerance = tolerance,
                 .interpolation = interpolation}),
          prepared(prepare::prepareEngine({scene, fields})) {}
    Subject(classify::DensityField field, const Shading &shading, double tolerance = 1.1e-3,
            const scene::Interpolation &interpolation = {})
        : Subject(classify::ShownFields{{std::move(field)}, {}}, shading, tolerance,
                  interpolation) {}

    shading::ShadingScale scale() const {
        return shading::shadingScale(fields.channels.front().values.lattice());
    }
    picture::ProjectionImage image(const glm::dquat &view) {
        scene.camera.orientation = view;
        return prepared.engine->render(scene.camera, scene.image, scene.shading);
    }
    // Of one channel of the look and of the lights.
    std::vector<double> truth(const glm::dquat &view, std::size_t channel = 0) {
        scene.camera.orientation = view;
        // Light shades the fields of red, green and blue.
        const classify::ShownFields shaded = classify::inPrimaries(fields);
        const auto &field = shaded.channels[std::min(channel, shaded.channels.size() - 1)];
        return exactImage(reference::shadedField(field, scene.shading, scene.camera.axes(),
                                                 int(channel), scale()));
    }
    std::vector<double> exactImage(const classify::DensityField &field) const {
        return reference::WideKernel(field.values, field.support).image(scene.camera, scene.image);
    }
    double worstError() {
        double worst = 0.0;
        for (const glm::dquat &view : someViews())
            worst = std::max(worst, test::relativeL2(image(view).samples, truth(view)));
        return worst;
    }
};

std::vector<float> channelOf(const picture::ProjectionImage &image, std::size_t channel) {
    std::vector<float> samples;
    for (std::size_t n = channel; n < image.samples.size(); n += std::size_t(image.channels))
        samples.push_back(image.samples[n]);
    return samples;
}

const DepthCue linear{CueKind::linear, 1.0}, sine{CueKind::sine, 1.0};
const Light across{{1, 0, 0}}, along{{0, 0, 1}}, oblique{{1, 1, 0.7}};

// What is asked for: the tolerance, cue and light included, is kept, and the prediction is no less
// than the error. At the default quality and a tenth of it.
class ShadedImage : public testing::TestWithParam<Named> {};

TEST_P(ShadedImage, IsWithinTheTolerance) {
    for (const double tolerance : {1.1e-3, 1e-4}) {
        Subject subject(headField(), GetParam().shading, tolerance);
        const double error = subject.worstError();
        EXPECT_LE(subject.prepared.plan.predictedError, tolerance);
        EXPECT_LE(error, subject.prepared.plan.predictedError);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Shadings, ShadedImage,
    testing::Values(Named{"linear", {.cue = linear}},
                    Named{"half_linear", {.cue = {CueKind::linear, 0.5}}},
                    Named{"sine", {.cue = sine}},
                    Named{"middle_slab", {.cue = {CueKind::curve, 1.0, {0.0, 2.0, 0.0}}}},
                    Named{"curve", {.cue = {CueKind::curve, 0.8, {0.1, 0.4, 0.2, 2.0, 1.0}}}},
                    Named{"curve_without_slope", {.cue = {CueKind::curve, 1.0, {0.5, 0.5}}}},
                    Named{"light_across", {.ambient = 0.3, .lights = {across}}},
                    Named{"light_along", {.ambient = 0.3, .lights = {along}}},
                    Named{"light_alone", {.ambient = 0.0, .lights = {oblique}}},
                    Named{"linear_and_light", {.cue = linear, .ambient = 0.3, .lights = {oblique}}},
                    Named{"sine_and_light",
                          {.cue = sine, .ambient = 0.3, .lights = {oblique, along}}}),
    [](const auto &test) { return std::string(test.param.name); });

// The figures that the width fixes: with four taps what the default keeps, with five 3e-4.
TEST(Shading, FiveTapsLeaveAThirdOfAThousandth) {
    const scene::Interpolation five{
        .kernel = fourier::KernelChoice{fourier::KernelFamily::leastAliasing, 5}};
    for (const DepthCue &cue : {linear, sine}) {
        Subject subject(headField(), {.cue = cue}, 3e-4, five);
        EXPECT_LE(subject.worstError(), 3e-4);
    }
}

// The cue is taken before the differences; without the term that mends it the picture is that of
// the cued field's gradient. The light along the view is the worst case.
TEST(Shading, TheCorrectionOfCueAndLightMatters) {
    for (const Light &light : {across, oblique, along}) {
        Subject subject(headField(), {.cue = linear, .ambient = 0.0, .lights = {light}});
        const glm::dquat view = someViews().front();
        const auto truth = subject.truth(view);
        EXPECT_LE(test::relativeL2(subject.image(view).samples, truth), 1.1e-3);

        const Shading cueOnly{.cue = linear};
        const auto scale = subject.scale();
        const auto axes = subject.scene.camera.axes();
        const auto cued = shading::grown(
            reference::shadedField(subject.fields.channels.front(), cueOnly, axes, 0, scale));
        const auto length = reference::shadedField(
            subject.fields.channels.front(),
            {.cue = linear, .ambient = 0.0, .lights = {{light.direction}, {-light.direction}}},
            axes, 0, scale); // twice half of |g|
        const auto half = subject.exactImage(length);
        std::vector<float> slope;
        const volume::GridSize size = cued.values.lattice().size();
        const glm::dvec3 toLight = axes * glm::normalize(light.direction);
        for (int k = 0; k < size.k; ++k)
            for (int j = 0; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i)
                    slope.push_back(
                        float(-0.5 * glm::dot(toLight, shading::gradientAt(cued.values, {i, j, k},
                                                                           scale.stepMm))));
        const auto gradient = subject.exactImage(classify::fieldOf(cued.values, std::move(slope)));
        std::vector<double> uncorrected;
        for (std::size_t n = 0; n < half.size(); ++n)
            uncorrected.push_back(0.5 * half[n] + gradient[n]);
        const double without = test::relativeL2(uncorrected, truth);
        if (light == across)
            EXPECT_LT(without, 2e-4); // W.L is 0: the axes' cosines differ a little
        else
            EXPECT_GT(without, 5e-3);
    }
}

// Invariants: a cue from behind undoes the cue, mirrored; lights from opposite sides leave no
// gradient; what is off costs and changes nothing. Each picture is within its tolerance of the
// exact ones, of which the invariants hold.
TEST(Shading, CuesFromBothSidesAddUpToTwiceThePlainImage) {
    for (const DepthCue &cue : {linear, sine}) {
        Subject subject(headField(), {.cue = cue}, 1e-4);
        const auto front = subject.image(scene::viewOrientation(StandardView::front));
        const auto back = subject.image(scene::viewOrientation(StandardView::back));
        subject.scene.shading = {};
        const auto plain = subject.image(scene::viewOrientation(StandardView::front));
        std::vector<double> sum(front.samples.size()), twice(front.samples.size());
        for (int row = 0; row < front.height; ++row)
            for (int column = 0; column < front.width; ++column) {
                const auto at = std::size_t(row) * front.width + column;
                sum[at] =
                    double(front.samples[at]) +
                    double(back.samples[std::size_t(row) * front.width + front.width - 1 - column]);
                twice[at] = 2.0 * double(plain.samples[at]);
            }
        EXPECT_LT(test::relativeL2(sum, twice), 1e-4);
    }
}

TEST(Shading, OppositeLightsLeaveNoGradient) {
    const Light opposite{-oblique.direction};
    Subject subject(headField(), {.ambient = 0.5, .lights = {oblique, opposite}});
    // The widths depend on the lights.
    dynamic_cast<render::CpuEngine &>(*subject.prepared.engine).setWidths(nullptr);
    const glm::dquat view = someViews().front();
    const auto both = subject.image(view).samples;
    // Any other pair gives the same.
    subject.scene.shading.lights = {across, {-across.direction}};
    EXPECT_LT(test::relativeL2(subject.image(view).samples, both), 1e-6);
    // And it is A f + |g|.
    subject.scene.shading.lights = {oblique};
    const auto first = subject.image(view).samples;
    subject.scene.shading.lights = {opposite};
    const auto second = subject.image(view).samples;
    subject.scene.shading = {};
    const auto plain = subject.image(view).samples;
    std::vector<double> sum;
    for (std::size_t n = 0; n < both.size(); ++n)
        sum.push_back(double(first[n]) + double(second[n]) - 0.5 * double(plain[n]));
    EXPECT_LT(test::relativeL2(sum, both), 1e-6);
}

TEST(Shading, DisabledShadingChangesAndPreparesNothing) {
    Subject plain(headField(), {});
    const auto expected = plain.image(someViews().front()).samples;
    Light dark = across;
    dark.strength = 0.0;
    Subject off(headField(), {.cue = {CueKind::linear, 0.0, {1.0, 1.0, 1.0}}, .lights = {dark}});
    EXPECT_FALSE(off.prepared.canBeLit);
    EXPECT_EQ(off.prepared.bytes, plain.prepared.bytes);
    EXPECT_EQ(off.image(someViews().front()).samples, expected);
    Subject lit(headField(), {.lights = {across}});
    EXPECT_TRUE(lit.prepared.canBeLit);
    const auto out = prepare::withoutLight(lit.prepared);
    EXPECT_EQ(2 * out.bytes, lit.prepared.bytes);
    EXPECT_FALSE(out.canBeLit);
    EXPECT_EQ(out.engine->render(plain.scene.camera, {}, {}).samples,
              lit.prepared.engine->render(plain.scene.camera, {}, {}).samples);
}

// A light of the patient's frame shines from where a light of the viewer's frame does that turns
// with the view.
TEST(Shading, LightsFollowTheViewerOrThePatient) {
    Subject subject(headField(), {.lights = {oblique}});
    for (const glm::dquat &view : someViews()) {
        subject.scene.shading.lights = {oblique};
        const auto expected = subject.image(view).samples;
        Light fixed = oblique;
        fixed.frame = shading::LightFrame::patient;
        fixed.direction = glm::mat3_cast(view) * glm::normalize(oblique.direction);
        subject.scene.shading.lights = {fixed};
        EXPECT_LT(test::relativeL2(subject.image(view).samples, expected), 1e-6);
    }
}

// Color: of light on a grey field, of light on one color, of light on a look of three channels.
TEST(Shading, ColoredLightsShineOnColoredTissue) {
    const Shading colored{
        .cue = linear,
        .ambient = 0.4,
        .lights = {{{1, 0, 0}, {1.0, 0.2, 0.0}, 0.8}, {{-0.5, 0.866, 0.3}, {0.0, 0.4, 1.0}}}};
    const volume::Volume head = headVolume();
    const classify::FieldWindow window = classify::defaultFieldWindow(head);
    classify::Look one, mixed;
    one.classes = {{.name = "bone", .low = 300, .high = 3000, .softness = 100}};
    one.classes[0].color = {1.0, 0.5, 0.25};
    mixed.classes = {one.classes[0], {.name = "soft", .low = -50, .high = 150, .softness = 50}};
    mixed.classes[1].color = {0.2, 0.6, 1.0};
    for (const classify::Look &look : {classify::Look{}, one, mixed}) {
        Subject subject(classify::shownFields(head, window, look, nullptr), colored);
        const auto image = subject.image(someViews().front());
        ASSERT_EQ(image.channels, 3);
        const classify::Color &c = subject.fields.colors.front();
        const std::array<double, 3> tissue = subject.fields.channels.size() == 1
                                                 ? std::array{c.red, c.green, c.blue}
                                                 : std::array{1.0, 1.0, 1.0};
        for (std::size_t channel = 0; channel < 3; ++channel) {
            auto truth = subject.truth(someViews().front(), channel);
            for (double &t : truth)
                t *= tissue[channel];
            EXPECT_LE(test::relativeL2(channelOf(image, channel), truth), 1.1e-3);
        }
    }
    // Colors that add up to white are colors still: the picture's shape does not hang on chance.
    Subject white(headField(),
                  {.lights = {{{1, 0, 0}, {1.0, 0.0, 0.0}}, {{1, 0, 0}, {0.0, 1.0, 1.0}}}});
    const auto whiteImage = white.image(someViews().front());
    ASSERT_EQ(whiteImage.channels, 3);
    EXPECT_EQ(channelOf(whiteImage, 0), channelOf(whiteImage, 2));
    // Grey light leaves a grey field grey.
    Subject grey(headField(), {.lights = {across}});
    EXPECT_EQ(grey.image(someViews().front()).channels, 1);
}

// The thesis makes both by linear combinations of volumes prepared in space, with V and L as
// weights: eq. 29 with D = P/R and tau = 2, and eq. 31 with tau = 1, N = -g/|g|, and |g| in place
// of f (its figure's f is a surface).
TEST(Shading, EqualsTheSpatialFormsOfTheThesis) {
    const classify::DensityField field = headField();
    Subject cued(field, {.cue = linear}), lit(field, {.ambient = 0.0, .lights = {oblique}});
    const glm::dquat view = someViews().front();
    const auto cuedImage = cued.image(view).samples, litImage = lit.image(view).samples;
    const glm::dvec3 toViewer = cued.scene.camera.axes()[2];
    const glm::dvec3 toLight = lit.scene.camera.axes() * glm::normalize(oblique.direction);

    const classify::DensityField larger = shading::grown(field);
    const volume::Lattice &lattice = larger.values.lattice();
    const volume::GridSize size = lattice.size();
    const auto scale = cued.scale();
    // f (tau/2 + tau/2 D_x), .., |g| (tau/2 + tau/2 N_x), .., and the unweighted volumes.
    std::array<std::vector<float>, 4> ofDepth, ofNormal;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const volume::VoxelIndex n{i, j, k};
                const double f = larger.values.value(n);
                const glm::dvec3 depth =
                    (lattice.patient(n).mm - lattice.center().mm) / scale.radiusMm;
                const glm::dvec3 g = shading::gradientAt(larger.values, n, scale.stepMm);
                for (int axis = 0; axis < 3; ++axis) {
                    ofDepth[std::size_t(axis)].push_back(float(f * (1.0 + depth[axis])));
                    ofNormal[std::size_t(axis)].push_back(
                        float(0.5 * glm::length(g) - 0.5 * g[axis]));
                }
                ofDepth[3].push_back(float(f));
                ofNormal[3].push_back(float(glm::length(g)));
            }
    const auto combined = [&](std::array<std::vector<float>, 4> &volumes,
                              const glm::dvec3 &direction, double half) {
        std::vector<double> sum;
        for (std::size_t v = 0; v < volumes.size(); ++v) {
            const auto image =
                cued.exactImage(classify::fieldOf(larger.values, std::move(volumes[v])));
            const double weight = v < 3 ? direction[glm::length_t(v)]
                                        : half * (1.0 - direction.x - direction.y - direction.z);
            sum.resize(image.size());
            for (std::size_t n = 0; n < image.size(); ++n)
                sum[n] += weight * image[n];
        }
        return sum;
    };
    EXPECT_LE(test::relativeL2(cuedImage, combined(ofDepth, toViewer, 1.0)), 1.1e-3);
    EXPECT_LE(test::relativeL2(litImage, combined(ofNormal, toLight, 0.5)), 1.1e-3);
}

// A field that fills its lattice to the faces has its strongest gradients beyond them; and one of a
// single sample, off the centre.
TEST(Shading, HardFieldsKeepTheTolerance) {
    const Shading everything{.cue = linear, .ambient = 0.2, .lights = {oblique}};
    const auto thick = test::tiltedLattice({24, 22, 6}, {0.9, 1.0, 5.0}, 25.0);
    Subject full(test::noiseField(thick), everything);
    EXPECT_LE(full.worstError(), 1.1e-3);
    Subject flat(test::noiseField(volume::Lattice::centred({32, 30, 1}, {1, 1, 4})), everything);
    EXPECT_LE(flat.worstError(), 1.1e-3);
    std::vector<float> one(11 * 9 * 7, 0.0F);
    one[(5 * 9 + 2) * 11 + 8] = 1.0F;
    const volume::Volume point(volume::Lattice::centred({11, 9, 7}, {1, 1.5, 2}), one,
                               volume::ValueUnit::none);
    Subject voxel(classify::fieldOf(point, one), everything);
    EXPECT_LE(voxel.worstError(), 1.1e-3);
    std::vector<float> nothing(8 * 8 * 8, 0.0F);
    const volume::Volume empty(volume::Lattice::centred({8, 8, 8}, {1, 1, 1}), nothing,
                               volume::ValueUnit::none);
    Subject dark(classify::fieldOf(empty, nothing), everything);
    for (const float sample : dark.image(someViews().front()).samples)
        EXPECT_EQ(sample, 0.0F);
}

// What is reduced to fit the memory keeps the brightness: the scale is the volume's own.
TEST(Shading, AReducedVolumeIsShadedAlike) {
    Subject subject(headField(), {.cue = linear, .ambient = 0.2, .lights = {oblique}});
    const scene::Scene &scene = subject.scene;
    const std::size_t light = prepare::bytesForLight(scene.shading, {72, 70, 40}, 1),
                      budget = subject.prepared.plan.bytes / 3 + light;
    const auto reduced = prepare::prepareEngine({scene, subject.fields, {budget}});
    ASSERT_LT(reduced.bytes, subject.prepared.bytes / 2);
    const auto fine = subject.image(someViews().front()).samples;
    const auto coarse = reduced.engine->render(scene.camera, scene.image, scene.shading).samples;
    // Means of two samples an axis lose edges; twice the scale would be an error of one.
    EXPECT_LT(test::relativeL2(coarse, fine), 0.3);
}

} // namespace
} // namespace pellucid
