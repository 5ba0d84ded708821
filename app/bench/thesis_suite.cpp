// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <complex>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "app/bench/look_rows.h"
#include "app/bench/thesis_figures.h"
#include "core/fourier/transforms/transform.h"
#include "core/task/error.h"
#include "gpu/gpu_engine.h"
#include "gpu/surfaceless_context.h"

namespace pellucid::bench {

namespace {

// The measurements of Cheng 2007 on platform A (Sempron 2800+ 1.6 GHz, Radeon Xpress 200) and
// platform B (Pentium 4 3.0 GHz, Radeon X850 Pro).
struct Times {
    double preparationSeconds = 0.0, framesPerSecond = 0.0; ///< 0: not given
};
struct Published {
    const char *table;
    volume::GridSize size;
    const char *kernel;
    double padding;
    Times b, a;
};

// Cubic convolution of 4 x 4 x 4 cells, as in eq. 21. The thesis used a different filter of as many
// samples, see `catmullRomBlend`.
constexpr const char *cubicName = "4.3 cubic, 4 x 4 x 4 cells";

const std::vector<Published> &publishedTables() {
    static const std::vector<Published> tables{
        {"4.1 no filter", {64, 64, 64}, "nearest", 1.0, {0.25, 100.0}, {0.813, 66.67}},
        {"4.1 no filter", {128, 128, 128}, "nearest", 1.0, {3.359, 66.67}, {8.015, 62.25}},
        {"4.1 no filter", {256, 256, 256}, "nearest", 1.0, {33.297, 32.25}, {104.407, 16.129}},
        {"4.2 trilinear", {64, 64, 64}, "trilinear", 1.0, {0.25, 66.67}, {0.704, 32.25}},
        {"4.2 trilinear", {128, 128, 128}, "trilinear", 1.0, {2.578, 62.5}, {7.656, 21.73}},
        {"4.2 trilinear", {256, 256, 256}, "trilinear", 1.0, {35.688, 21.27}, {111.266, 12.82}},
        {cubicName, {64, 64, 64}, "catmull-rom", 1.0, {0.25, 2.78}, {0.828, 2.67}},
        {cubicName, {128, 128, 128}, "catmull-rom", 1.0, {3.641, 2.66}, {7.485, 2.132}},
        {cubicName, {256, 256, 256}, "catmull-rom", 1.0, {37.984, 2.54}, {100.0, 1.27}},
        {"4.4 doubled domain", {64, 64, 64}, "trilinear", 2.0, {3.708, 66.67}, {7.594, 31.25}},
        {"4.4 doubled domain", {128, 128, 128}, "trilinear", 2.0, {35.031, 31.25}, {101.0, 12.82}}};
    return tables;
}

std::string timesText(const Times &times) {
    return fmt::format("{}{:.3g} frames/s",
                       times.preparationSeconds > 0.0
                           ? fmt::format("prepared in {:.3g} s, ", times.preparationSeconds)
                           : "",
                       times.framesPerSecond);
}

std::string publishedText(const Times &b, const Times &a) {
    std::string text = "published: B " + timesText(b);
    if (a.framesPerSecond > 0.0)
        text += "; A " + timesText(a);
    return text;
}

Subject headOf(const volume::GridSize &size) {
    return phantomSubject("head", phantom::Kind::head, {.size = size});
}

// Table 4.6: six basis volumes, a slice of each in every frame; and the same look with the default
// settings.
void measureTransferFunction(const Report &report, int n, const Times &b, const Times &a) {
    LookSubject subject(n);
    classify::Look look;
    look.transferFunction.weights = {0.0, 0.5, 2.0, 1.0, 0.5, 2.0};
    const std::string published = publishedText(b, a);
    reportLook(report, "thesis", "default six points", subject, look, published);
    subject.scene.interpolation.kernel = fourier::kernelFromName("trilinear");
    subject.scene.interpolation.padding = 1.0;
    reportLook(report, "thesis", "4.6 six points", subject, look, published);
}

int viewsOfTruth(const volume::GridSize &size) {
    return size.i > 256 ? 1 : size.i > 128 ? 2 : 4;
}

// Renders the same head at the default quality, and compares with the ray sum.
void reportDefault(const Report &report, const Subject &head, Truth &truth) {
    Measurement how{.transform = false, .peers = true};
    how.scene.camera =
        squareCamera(head.field.values.lattice(), head.field.values.lattice().size().i);
    report(measure("thesis", "default, the same head", head, truth, how));
}

// Table 4.5: frames per second on platform B with either transform.
struct PublishedTransforms {
    volume::GridSize size;
    double fftw, card;
};
constexpr std::array publishedTransforms{PublishedTransforms{{128, 128, 128}, 62.5, 21.132},
                                         PublishedTransforms{{256, 256, 256}, 21.276, 21.132},
                                         PublishedTransforms{{512, 512, 256}, 8.0, 16.129}};

// Median time of a transform on one thread. `fill` prepares the input, which the transform
// overwrites.
double transformMs(const std::function<void()> &fill, const std::function<void()> &transform) {
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    std::vector<double> times;
    for (int run = 0; run < 64; ++run) {
        fill();
        const double start = millisecondsNow();
        transform();
        times.push_back(millisecondsNow() - start);
    }
    return median(times);
}

// FFTW's inverse transform of an image in the frame's single precision, with a measured plan.
double fftwTransformMs(int n) {
    std::vector<std::complex<float>> half(std::size_t(n) * (n / 2 + 1));
    std::vector<float> image(std::size_t(n) * n);
    const fourier::InverseTransform2d<float> transform(n, n, fourier::Planning::measure);
    return transformMs([&] { std::fill(half.begin(), half.end(), 1.0F); },
                       [&] { transform.run(half.data(), image.data()); });
}

// The graphics card; null with a reason if there is none or only a software renderer.
struct Card {
    std::shared_ptr<gpu::FramePasses> passes;
    std::string reason;
};
Card findCard() {
    try {
        return {std::make_shared<gpu::FramePasses>(std::make_shared<gpu::Device>(
                    std::make_unique<gpu::SurfacelessContext>(false))),
                {}};
    } catch (const task::Error &error) {
        return {nullptr, error.reason().english()};
    }
}

// A frame of three images computes its slices in a separate pass, so that the rest is their
// transforms. In a grey frame, the first half of the transform is part of the slice's pass.
double cardTransformMs(const Card &card, const scene::Scene &scene,
                       const std::shared_ptr<const fourier::Spectrum> &spectrum,
                       const plan::FieldOfView &fieldOfView) {
    render::CpuEngine engine(
        {{spectrum, spectrum, spectrum}, {}, shading::shadingScale(spectrum->lattice())},
        fieldOfView);
    engine.setChannelWeights({{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
    const auto onCard = gpu::copyToCard(card.passes, engine);
    std::vector<double> times;
    scene::Camera camera = scene.camera;
    for (const glm::dquat &orientation : randomViews(64)) {
        camera.orientation = orientation;
        gpu::CardTimes frame;
        onCard->renderOnCard(camera, scene.image, {}, &frame);
        times.push_back(frame.transformMs / 3.0);
    }
    return median(times);
}

Row cardRow(const Card &card, const Row &ours, const Measurement &how, const Subject &head) {
    Row row = ours;
    row.name = "4.5 FFT on the card";
    for (auto *figure : {&row.bytes, &row.prepareMs, &row.sliceMs, &row.transformMs, &row.frameMs,
                         &row.relativeL2, &row.maxError, &row.psnrDb})
        figure->reset();
    if (!card.passes) {
        row.note = "no card: " + card.reason;
        return row;
    }
    row.engine = "gpu, " + card.passes->device().capabilities().renderer;
    const auto plan = plan::planRender(how.scene, field::summarise(head.field));
    const auto spectrum = std::make_shared<const fourier::Spectrum>(
        fourier::Spectrum::prepare(head.field.values, plan.spectrum));
    row.transformMs = cardTransformMs(card, how.scene, spectrum, *how.fieldOfView);
    row.note = "by the card's clock, a third of three images'; whole frames: --suite gpu";
    return row;
}

// Table 4.5: either transform after the same slice.
void measureTransforms(const Report &report, const PublishedTransforms &published,
                       const Card &card) {
    const int n = published.size.i;
    const Subject cropped = headInCube(published.size), head = whole(cropped);
    Measurement how = thesisMeasurement(head, "trilinear");
    how.threads = 1;
    Truth truth(head, how.scene.camera, 1);
    Row ours = measure("thesis", "4.5 ours", head, truth, how);
    ours.predictedError.reset();
    Row fftw = ours;
    fftw.name = "4.5 FFTW";
    fftw.transformMs = fftwTransformMs(n);
    fftw.frameMs = *ours.sliceMs + *fftw.transformMs;
    fftw.note = fmt::format("FFTW's inverse of {} x {} after our slice, one thread, measured plan; "
                            "published: B {:.3g} frames/s",
                            n, n, published.fftw);
    report(fftw);
    ours.note = fmt::format("our {} x {}, one thread: {:.1f} times as fast as FFTW's", n, n,
                            *fftw.transformMs / *ours.transformMs);
    report(ours);
    Row onCard = cardRow(card, ours, how, head);
    onCard.note += fmt::format("; published: B {:.3g} frames/s", published.card);
    report(onCard);
    if (n > 256) // the other sizes are already reported
        reportDefault(report, cropped, truth);
}

} // namespace

void runThesisSuite(const Report &report) {
    int largest = 0;
    for (const Published &published : publishedTables()) {
        const Subject head = headOf(published.size);
        Measurement how;
        how.scene.camera = squareCamera(head.field.values.lattice(), published.size.i);
        how.transform = false;
        Truth truth(head, how.scene.camera, viewsOfTruth(published.size));
        how.scene.interpolation.kernel = fourier::kernelFromName(published.kernel);
        how.scene.interpolation.padding = published.padding;
        how.scene.interpolation.storage = fourier::Storage::float32;
        Row row = measure("thesis", published.table, head, truth, how);
        row.note = publishedText(published.b, published.a);
        report(row);
        if (published.size.i > largest) { // once per size
            reportDefault(report, head, truth);
            largest = published.size.i;
        }
    }
    for (const int n : {64, 256})
        measureFigures(report, n);
    const Card card = findCard();
    for (const PublishedTransforms &published : publishedTransforms)
        measureTransforms(report, published, card);
    measureTransferFunction(report, 64, {1.172, 9.174}, {4.234, 7.09});
    measureTransferFunction(report, 128, {26.375, 8.0}, {44.485, 7.09});
    // The preparation time of B is a copying error in the source, see REFERENCES.md.
    measureTransferFunction(report, 256, {37.984, 0.57}, {640.016, 0.39});
}

} // namespace pellucid::bench
