// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/thesis_figures.h"

#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/reference/wide_kernel.h"

namespace pellucid::bench {

namespace {

// The field of view of the thesis: the slice of a square image has as many samples as the image,
// and so as a spectrum without padding. The engine's own slice is finer, so that no copy of the
// projection reaches the image; its samples are between the cells even in a view along an axis.
plan::FieldOfView fieldOfViewOfImage(const scene::Camera &camera, const volume::Lattice &lattice) {
    field::EnergySpread spread = field::evenSpread(lattice, lattice.bounds());
    // A quarter of a pixel less, so that rounding does not add one.
    spread.radiusMm = (0.5 * camera.width - 0.25) * camera.pixelMm -
                      scene::reconstructionReach({}) * lattice.longestStepMm();
    plan::FieldOfView fieldOfView{{std::make_shared<const field::EnergySpread>(spread)}, 1e9};
    assert(plan::sliceGrid(camera, fieldOfView, lattice, {}) ==
           (plan::SliceGrid{camera.width, camera.height}));
    return fieldOfView;
}

// The thesis's cubic filter: at each frequency, the Catmull-Rom value half way between trilinear
// samples one and two cells to either side. Shifting by whole cells multiplies the field by a
// factor of period 1, so that the filter equals the trilinear filter of the field times the factor.
// *Units*: x in padded periods. *Source*: Cheng 2007, 4.2.2, figure 4.6.
double catmullRomBlend(double x) {
    return 9.0 / 8.0 * std::cos(2.0 * std::numbers::pi * x) -
           1.0 / 8.0 * std::cos(4.0 * std::numbers::pi * x);
}

// A field times a factor for each axis. *Units*: the factor's x in padded periods from the wrap
// voxel, which is the middle one. *Requires*: the whole lattice is transformed.
Subject weighted(const Subject &subject, const fourier::SpectrumLayout &layout,
                 const std::function<double(const fourier::Kernel &, double x)> &factor) {
    const volume::GridSize size = layout.box.size();
    std::array<std::vector<double>, 3> weights;
    for (int d = 0; d < 3; ++d)
        for (int n = 0; n < size[d]; ++n)
            weights[d].push_back(
                factor(layout.kernels[d], double(n - size[d] / 2) / layout.padded[d]));
    std::vector<float> samples;
    samples.reserve(size.count());
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                samples.push_back(float(subject.field.values.value({i, j, k}) * weights[0][i] *
                                        weights[1][j] * weights[2][k]));
    Subject result{subject.name, classify::fieldOf(subject.field.values, std::move(samples))};
    result.field.support = subject.field.support;
    return result;
}

// The settings behind a figure of the thesis, and what its caption claims.
struct Figure {
    const char *name, *kernel;
    bool premultiplied, blended, alongAxes;
    const char *claim;
};
constexpr std::array figures{
    Figure{"figure 4.2, no filter", "nearest", false, false, false,
           "published: ghosts, at the higher resolution too"},
    Figure{"figure 4.3, no filter, along axes", "nearest", false, false, true,
           "published: no ghosts in views at multiples of 90 degrees"},
    Figure{"figure 4.4, trilinear", "trilinear", false, false, false,
           "published: far fewer ghosts, but bright in the middle and darker outward"},
    Figure{"figure 4.5, trilinear", "trilinear", true, false, false,
           "published: 4.4 compensated by 1/sinc^2"},
    Figure{"figure 4.7, cubic of trilinear", "trilinear", false, true, false,
           "published: hardly any ghosts, but very dark outward; compensated, as in 4.8, the blend "
           "cancels and leaves 4.5"},
    Figure{"as 4.7, cubic of cells", "catmull-rom", false, false, false,
           "eq. 21 on the cells themselves"},
    Figure{"as 4.8, cubic of cells", "catmull-rom", true, false, false,
           "eq. 21 on the cells themselves"}};

// The head of the figures, with its exact images from several views.
struct HeadAndTruth {
    Subject head;
    Truth truth;
    HeadAndTruth(const volume::GridSize &size, const std::vector<glm::dquat> &views)
        : head(whole(headInCube(size))),
          truth(head, squareCamera(head.field.values.lattice(), size.i), views) {}
};

// The engine sets frequency 0 to the field's exact DC. The thesis's filters read the cell instead,
// which adds this level to every pixel.
double levelOf(const fourier::Spectrum &spectrum, const scene::Camera &camera) {
    const double sideMm = camera.width * camera.pixelMm; // the period's: the grid is the image's
    return (spectrum.value(0, 0, 0).real() - spectrum.dc()) / (sideMm * sideMm);
}

double norm(const std::vector<double> &values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value * value;
    return std::sqrt(sum);
}

// The errors of an image, relative to the exact one: darkening by the kernel, ghosts, and a
// constant level, which a window hides. The exact image of the darkened field separates the first
// two.
struct Parts {
    double darkening = 0.0, ghosts = 0.0, level = 0.0;
};
Parts partsOf(std::span<const float> image, double level, const std::vector<double> &darkened,
              const std::vector<double> &truth) {
    std::vector<double> missing, ghosts;
    for (std::size_t n = 0; n < truth.size(); ++n) {
        missing.push_back(truth[n] - darkened[n]);
        ghosts.push_back(double(image[n]) - level - darkened[n]);
    }
    const double whole = norm(truth);
    return {norm(missing) / whole, norm(ghosts) / whole,
            std::abs(level) * std::sqrt(double(truth.size())) / whole};
}

// The head darkened by a figure's filter. The engine divides a field by the kernel's transform;
// multiplying the field by it first undoes that, which gives a filter without premultiplication.
Subject darkenedHead(const Figure &figure, const Subject &head,
                     const fourier::SpectrumLayout &layout) {
    return weighted(head, layout, [&](const fourier::Kernel &kernel, double x) {
        return (figure.premultiplied ? 1.0 : kernel.apodisation(x)) *
               (figure.blended ? catmullRomBlend(x) : 1.0);
    });
}

void measureFigure(const Report &report, const Figure &figure, HeadAndTruth &subject) {
    const Measurement how = thesisMeasurement(subject.head, figure.kernel);
    const auto plan = plan::planRender(how.scene, field::summarise(subject.head.field));
    const Subject darkened = darkenedHead(figure, subject.head, plan.spectrum);
    const volume::Field &field = darkened.field.values;
    Row row = plannedRow("thesis", figure.name, field.lattice().size(), plan, how.scene, 0);
    render::CpuEngine engine(
        std::make_shared<const fourier::Spectrum>(fourier::Spectrum::prepare(field, plan.spectrum)),
        how.fieldOfView);
    fillTimes(row, engine, how.scene, how.views);
    const reference::WideKernel reference(field, darkened.field.support);
    ImageError worst;
    Parts parts;
    for (int view = 0; view < subject.truth.views(); ++view) {
        const scene::Camera &camera = subject.truth.camera(view);
        const std::vector<double> &truth = subject.truth.image(view, how.scene.image);
        auto image = engine.render(camera, how.scene.image).samples;
        const double level = levelOf(*engine.spectra().fields.front(), camera);
        for (float &sample : image)
            sample += float(level);
        const ImageError error = compare(image, truth);
        if (error.relativeL2 <= worst.relativeL2)
            continue;
        worst = error;
        parts = partsOf(image, level, reference.image(camera, how.scene.image), truth);
    }
    fillError(row, worst);
    // The plan's prediction is for neither this field nor this grid.
    row.predictedError.reset();
    row.note = figure.premultiplied ? "premultiplied; " : "not premultiplied; ";
    // Slices through the cells themselves have ghosts that exactly equal the darkening.
    if (!figure.alongAxes)
        row.note += fmt::format("darkening {:.2e}, ghosts {:.2e}, level {:.2e}; ", parts.darkening,
                                parts.ghosts, parts.level);
    row.note += figure.claim;
    report(row);
}

} // namespace

Subject headInCube(const volume::GridSize &size) {
    constexpr double sideMm = 243.2;
    const glm::dvec3 spacingMm(sideMm / size.i, sideMm / size.j, sideMm / size.k);
    return phantomSubject("head", phantom::Kind::head, {.size = size, .spacingMm = spacingMm});
}

Subject whole(Subject subject) {
    subject.field.support = subject.field.values.lattice().bounds();
    return subject;
}

Measurement thesisMeasurement(const Subject &head, const char *kernel) {
    const volume::Lattice &lattice = head.field.values.lattice();
    Measurement how;
    how.scene.camera = squareCamera(lattice, lattice.size().i);
    how.scene.interpolation = {fourier::kernelFromName(kernel), 1.0, fourier::Storage::float32};
    how.fieldOfView = fieldOfViewOfImage(how.scene.camera, lattice);
    how.transform = false;
    return how;
}

void measureFigures(const Report &report, int n) {
    using scene::StandardView;
    HeadAndTruth general({n, n, n}, randomViews(2, 11)),
        alongAxes({n, n, n}, {scene::viewOrientation(StandardView::front),
                              scene::viewOrientation(StandardView::top)});
    for (const Figure &figure : figures)
        measureFigure(report, figure, figure.alongAxes ? alongAxes : general);
}

} // namespace pellucid::bench
