// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/detail_loss.h"

#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>

#include "core/classify/coarse_field.h"
#include "core/classify/layers.h"
#include "core/phantom/phantom.h"
#include "core/prepare/prepared_engine.h"
#include "core/reference/shaded_field.h"
#include "core/reference/wide_kernel.h"
#include "tests/support/fields.h"

namespace pellucid {
namespace {

using classify::DensityField;
using render::ChannelWeights;

constexpr classify::FieldWindow window{-900.0, 2000.0};
constexpr ChannelWeights grey{1.0, 1.0, 1.0};
// A wide roll-off has short tails, so exact pictures are cheap; the loss of detail is the same.
constexpr scene::ImageDefinition fading{scene::Reconstruction::cubic, 0.5};

volume::Volume phantomOf(phantom::Kind kind, const volume::GridSize &size, double tiltDeg) {
    return phantom::makePhantom(
        kind, phantom::phantomLattice(kind, {.size = size, .tiltRad = glm::radians(tiltDeg)}));
}

double relativeL2(const std::vector<double> &image, const std::vector<double> &truth) {
    double error = 0.0, energy = 0.0;
    for (std::size_t n = 0; n < truth.size(); ++n) {
        error += (image[n] - truth[n]) * (image[n] - truth[n]);
        energy += truth[n] * truth[n];
    }
    return std::sqrt(error / energy);
}

accuracy::AxisProjections projectionsOf(const std::vector<DensityField> &fields) {
    accuracy::AxisProjections projections;
    for (const DensityField &field : fields)
        projections.add(field);
    return projections;
}

// The views that decide: along the axes of the patient, between them, and two at random.
std::vector<glm::dquat> someViews() {
    using scene::StandardView;
    using scene::viewOrientation;
    return {viewOrientation(StandardView::front, {}),
            viewOrientation(StandardView::left, {}),
            viewOrientation(StandardView::top, {}),
            viewOrientation(StandardView::front, {45, 0, 0}),
            viewOrientation(StandardView::front, {33, 21, 9}),
            viewOrientation(StandardView::left, {-17, 52, 70})};
}

struct Case {
    const char *name;
    phantom::Kind kind;
    volume::GridSize size;
    double tiltDeg;
    bool isCut = false; ///< to the inner half of each side, so that the body meets every face
};

class DetailLoss : public testing::TestWithParam<Case> {};

// The stated loss is at least the worst measured in some views, and at most three times that: the
// margin for views is 1.25, and pixels as large as the samples leave out detail that the samples
// have, which makes a factor of three for edges.
TEST_P(DetailLoss, BoundsWhatCoarsePicturesMeasure) {
    const Case &p = GetParam();
    const volume::Volume whole = phantomOf(p.kind, p.size, p.tiltDeg),
                         fine = p.isCut ? whole.cropped({{p.size.i / 4, p.size.j / 4, p.size.k / 4},
                                                         {3 * p.size.i / 4, 3 * p.size.j / 4,
                                                          3 * p.size.k / 4}})
                                        : whole,
                         coarse = classify::coarseVolume(fine, 22);
    const DensityField fineField = classify::densityField(fine, window),
                       coarseField = classify::densityField(coarse, window);
    const accuracy::DetailLoss loss(projectionsOf({fineField}), projectionsOf({coarseField}), 1,
                                    fine.lattice().shortestStepMm());
    const double predicted = loss.relativeError(std::vector{grey}, {});
    const reference::WideKernel exact(fineField.values, fineField.support),
        shown(coarseField.values, coarseField.support);
    scene::Camera camera = scene::defaultCamera(fine.lattice());
    double worst = 0.0;
    for (const glm::dquat &view : someViews()) {
        camera.orientation = view;
        worst =
            std::max(worst, relativeL2(shown.image(camera, fading), exact.image(camera, fading)));
    }
    EXPECT_GE(predicted, worst);
    EXPECT_LE(predicted, 3.0 * worst);
    EXPECT_GT(worst, 1e-3); // there was something to lose
}

INSTANTIATE_TEST_SUITE_P(Subjects, DetailLoss,
                         testing::Values(Case{"head", phantom::Kind::head, {64, 64, 48}, 0.0},
                                         Case{"tilted", phantom::Kind::head, {64, 64, 20}, 20.0},
                                         Case{"metal", phantom::Kind::metal, {54, 54, 54}, 0.0},
                                         Case{"bars", phantom::Kind::bars, {60, 44, 48}, 0.0},
                                         Case{"cut", phantom::Kind::head, {90, 90, 94}, 0.0, true}),
                         [](const auto &tested) { return std::string(tested.param.name); });

// The inner products of two layers give what their sum loses, whatever its weights.
TEST(DetailLossOfLayers, FollowsTheWeights) {
    const volume::Volume fine = phantomOf(phantom::Kind::head, {96, 96, 72}, 0.0),
                         coarse = classify::coarseVolume(fine, 22);
    classify::Look look;
    look.transferFunction.weights = {0.0, 2.0, 0.5, 1.0};
    const auto layers = classify::mixtureOf(look).layers;
    std::vector<DensityField> fineLayers, coarseLayers;
    for (std::size_t n = 1; n < 3; ++n) {
        fineLayers.push_back(classify::layerField(fine, window, layers[n], nullptr));
        coarseLayers.push_back(classify::layerField(coarse, window, layers[n], nullptr));
    }
    const accuracy::DetailLoss ofLayers(projectionsOf(fineLayers), projectionsOf(coarseLayers), 2,
                                        1.0);
    const auto sumOf = [](const std::vector<DensityField> &fields, double a, double b) {
        std::vector<float> samples;
        const auto size = fields[0].values.lattice().size();
        for (int k = 0; k < size.k; ++k)
            for (int j = 0; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i)
                    samples.push_back(float(a * fields[0].values.value({i, j, k}) +
                                            b * fields[1].values.value({i, j, k})));
        return classify::fieldOf(fields[0].values, std::move(samples));
    };
    for (const auto &[a, b] : {std::pair{1.0, 0.0}, std::pair{0.3, 1.7}, std::pair{1.0, -0.5}}) {
        const accuracy::DetailLoss ofSum(projectionsOf({sumOf(fineLayers, a, b)}),
                                         projectionsOf({sumOf(coarseLayers, a, b)}), 1, 1.0);
        const double expected = ofSum.relativeError(std::vector{grey}, {}),
                     found = ofLayers.relativeError(
                         std::vector<ChannelWeights>{{a, a, a}, {b, b, b}}, {});
        EXPECT_GT(expected, 0.0);
        // Samples of the sum are rounded to float.
        EXPECT_NEAR(found, expected, 1e-5 * expected) << a << ' ' << b;
    }
}

// Light brings out edges, so more is lost than in the plain picture.
TEST(DetailLossUnderLight, BoundsWhatCoarsePicturesMeasure) {
    const volume::Volume fine = phantomOf(phantom::Kind::head, {56, 56, 40}, 0.0),
                         coarse = classify::coarseVolume(fine, 22);
    shading::Shading shading;
    shading.ambient = 0.2;
    shading.lights.push_back({{-1.0, 1.0, 0.5}});
    const shading::ShadingScale scale = shading::shadingScale(fine.lattice());
    const auto shadedOf = [&](const volume::Volume &volume) {
        return prepare::shadedFields({{classify::densityField(volume, window)}, {}}, shading,
                                     scale);
    };
    const auto fineFields = shadedOf(fine), coarseFields = shadedOf(coarse);
    const accuracy::DetailLoss loss(
        projectionsOf({fineFields.fields[0], fineFields.gradients[0]}),
        projectionsOf({coarseFields.fields[0], coarseFields.gradients[0]}), 1, scale.stepMm);
    const double predicted = loss.relativeError(std::vector{grey}, shading);
    EXPECT_GT(predicted, loss.relativeError(std::vector{grey}, {}));
    scene::Camera camera = scene::defaultCamera(fine.lattice());
    double worst = 0.0;
    for (const glm::dquat &view : someViews()) {
        camera.orientation = view;
        const auto picture = [&](const volume::Volume &volume) {
            const DensityField shaded = reference::shadedField(
                classify::densityField(volume, window), shading, camera.axes(), 0, scale);
            return reference::WideKernel(shaded.values, shaded.support).image(camera, fading);
        };
        worst = std::max(worst, relativeL2(picture(coarse), picture(fine)));
    }
    EXPECT_GE(predicted, worst);
    EXPECT_LE(predicted, 3.0 * worst);
}

// A coarse picture says nothing before its loss is known, and then never less than the loss.
TEST(DetailLossOfEngine, CountsInTheErrorOfThePicture) {
    const volume::Volume fine = phantomOf(phantom::Kind::head, {64, 64, 64}, 0.0),
                         coarse = classify::coarseVolume(fine, 22);
    const DensityField fineField = classify::densityField(fine, window),
                       coarseField = classify::densityField(coarse, window);
    scene::Scene scene;
    scene.camera = scene::defaultCamera(fine.lattice());
    auto prepared = prepare::prepareEngine(scene, classify::ShownFields{{coarseField}, {}}, {});
    const auto picture = prepared.engine->render(scene.camera, scene.image);
    const auto predicted = [&] {
        return prepare::errorOf(prepared, picture, scene.camera, scene.image, {});
    };
    const auto alone = predicted();
    ASSERT_TRUE(alone);
    EXPECT_LE(*alone, scene.tolerance);
    prepared.isCoarse = true;
    EXPECT_FALSE(predicted());
    const auto loss = std::make_shared<const accuracy::DetailLoss>(
        projectionsOf({fineField}), projectionsOf({coarseField}), 1, 1.0);
    prepared.detailLoss = loss;
    ASSERT_TRUE(predicted());
    const auto truth =
        reference::WideKernel(fineField.values, fineField.support).image(scene.camera, scene.image);
    EXPECT_GE(*predicted(), relativeL2({picture.samples.begin(), picture.samples.end()}, truth));
    EXPECT_GT(*predicted(), 10.0 * *alone);
}

// A part of a picture may lose more than the whole, and a cue may bring out the part of the body
// that loses most.
TEST(DetailLossOfParts, BoundsWhatPartsAndCuesMeasure) {
    const volume::Volume fine = phantomOf(phantom::Kind::head, {56, 56, 40}, 0.0),
                         coarse = classify::coarseVolume(fine, 22);
    const DensityField fineField = classify::densityField(fine, window),
                       coarseField = classify::densityField(coarse, window);
    const shading::ShadingScale scale = shading::shadingScale(fine.lattice());
    const accuracy::DetailLoss loss(projectionsOf({fineField}), projectionsOf({coarseField}), 1,
                                    scale.stepMm);
    struct Part {
        double share;
        glm::dvec2 off; // relative to half the whole
    };
    double largest = 0.0;
    for (const shading::CueKind kind :
         {shading::CueKind::none, shading::CueKind::linear, shading::CueKind::curve})
        for (const Part &part : {Part{1.0, {0, 0}}, Part{0.25, {0, 0}}, Part{0.2, {0.5, 0.4}},
                                 Part{0.3, {-0.1, 0.6}}, Part{0.1, {0.0, -0.5}}})
            for (const glm::dquat &view : {someViews()[0], someViews()[3], someViews()[5]}) {
                scene::Camera camera = scene::defaultCamera(fine.lattice());
                camera.orientation = view;
                const double halfMm = 0.5 * camera.width * camera.pixelMm;
                camera.panMm = halfMm * part.off;
                camera.width = camera.height = int(part.share * camera.width);
                shading::Shading shading;
                shading.cue = {kind, 1.0, {0.1, 0.3, 1.6}};
                const auto picture = [&](const DensityField &field) {
                    const DensityField shaded =
                        reference::shadedField(field, shading, camera.axes(), 0, scale);
                    return reference::WideKernel(shaded.values, shaded.support)
                        .image(camera, fading);
                };
                const std::vector<double> shown = picture(coarseField), truth = picture(fineField);
                const picture::ProjectionImage image{
                    camera.width, camera.height, camera.pixelMm, {shown.begin(), shown.end()}, 1};
                const double measured = relativeL2(shown, truth);
                EXPECT_GE(loss.relativeError(image, std::vector{grey}, shading), measured)
                    << int(kind) << ' ' << part.share;
                if (part.share == 1.0) // for other parts the bound may be far above
                    EXPECT_GE(loss.relativeError(std::vector{grey}, shading), measured);
                largest = std::max(largest, measured);
            }
    // Some part loses more than the whole is charged with.
    EXPECT_GT(largest, loss.relativeError(std::vector{grey}, {}));
}

} // namespace
} // namespace pellucid
