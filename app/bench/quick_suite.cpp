// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <random>

#include "app/bench/suites.h"
#include "core/fourier/transform.h"
#include "core/phantom/phantom.h"
#include "core/reference/wide_kernel.h"
#include "core/render/cpu_engine.h"

namespace pellucid::bench {

namespace {

using Clock = std::chrono::steady_clock;

double sinceMs(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

glm::dquat randomOrientation(std::mt19937 &random) {
    std::normal_distribution<double> normal;
    return glm::normalize(
        glm::dquat(normal(random), normal(random), normal(random), normal(random)));
}

// White noise in the inscribed sphere: a flat spectrum, the field of the published tables.
classify::DensityField noiseSphere(int n) {
    const auto lattice = volume::Lattice::centred({n, n, n}, {1, 1, 1});
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<float> samples(lattice.size().count(), 0.0F);
    std::size_t at = 0;
    const double middle = 0.5 * (n - 1), radius = 0.5 * n;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i, ++at)
                if (std::hypot(i - middle, j - middle, k - middle) < radius)
                    samples[at] = uniform(random);
    return classify::densityField(
        volume::Volume(lattice, std::move(samples), volume::ValueUnit::none), {0.0, 1.0});
}

classify::DensityField phantomField(phantom::Kind kind, const phantom::Sampling &sampling) {
    const auto volume = phantom::makePhantom(kind, phantom::phantomLattice(kind, sampling));
    return classify::densityField(volume, classify::defaultFieldWindow(volume));
}

double transformMs(const fourier::SpectrumLayout &layout) {
    const volume::GridSize p = layout.padded;
    const int stride = p.i / 2 + 1;
    std::vector<std::complex<float>> data(std::size_t(stride) * p.j * p.k);
    const auto start = Clock::now();
    fourier::forwardTransform3d(data.data(), p, stride, p.j);
    return sinceMs(start);
}

Row measure(const std::string &name, const classify::DensityField &field) {
    render::Scene scene;
    scene.camera = render::defaultCamera(field.values.lattice());
    const auto plan = render::planRender(scene, render::summarise(field));
    const int width = plan.spectrum.width();
    Row row{"quick",
            "default " + name,
            field.values.lattice().size(),
            "cpu",
            plan.spectrum.kernels[0].name(),
            width * width * width,
            double(plan.spectrum.padded.i) / plan.spectrum.box.size().i,
            plan.spectrum.storage == fourier::Storage::binary16 ? "f16" : "f32",
            thisMachine().threads};
    auto start = Clock::now();
    const auto spectrum = std::make_shared<const fourier::Spectrum>(
        fourier::Spectrum::prepare(field.values, plan.spectrum));
    row.prepareMs = sinceMs(start);
    row.fft3dMs = transformMs(plan.spectrum);
    row.bytes = double(plan.bytes);
    row.predictedError = plan.predictedError;

    render::CpuEngine engine(spectrum);
    std::mt19937 random(7);
    std::vector<double> slice, transform, frame;
    constexpr int views = 64;
    for (int view = 0; view < views; ++view) {
        scene.camera.orientation = randomOrientation(random);
        render::FrameTimes times;
        start = Clock::now();
        engine.render(scene.camera, scene.image, &times);
        frame.push_back(sinceMs(start));
        slice.push_back(times.sliceMs);
        transform.push_back(times.transformMs);
    }
    row.sliceMs = median(slice);
    row.transformMs = median(transform);
    row.frameMs = median(frame);

    // The error of the worst of a few views, among them the axes.
    const reference::WideKernel exact(field.values, field.support);
    double worst = 0.0, largest = 0.0, psnr = 1e9;
    const int checked =
        field.values.lattice().size().i > 128 ? 2 : 5; // the reference takes seconds
    for (int view = 0; view < checked; ++view) {
        scene.camera.orientation = view == 0 ? render::viewOrientation(render::StandardView::front)
                                   : view == 1 ? render::viewOrientation(render::StandardView::top)
                                               : randomOrientation(random);
        const auto image = engine.render(scene.camera, scene.image);
        const auto truth = exact.image(scene.camera, scene.image);
        double difference = 0.0, energy = 0.0, peak = 0.0, most = 0.0;
        for (std::size_t n = 0; n < truth.size(); ++n) {
            const double e = image.samples[n] - truth[n];
            difference += e * e;
            energy += truth[n] * truth[n];
            peak = std::max(peak, std::abs(truth[n]));
            most = std::max(most, std::abs(e));
        }
        worst = std::max(worst, std::sqrt(difference / energy));
        largest = std::max(largest, most / peak);
        psnr = std::min(psnr, 10.0 * std::log10(peak * peak * double(truth.size()) / difference));
    }
    row.relativeL2 = worst;
    row.maxError = largest;
    row.psnrDb = psnr;
    return row;
}

} // namespace

std::vector<Row> runQuickSuite() {
    using phantom::Kind;
    const auto cubed = [](int n) { return phantom::Sampling{.size = volume::GridSize{n, n, n}}; };
    return {measure("noise sphere 64", noiseSphere(64)),
            measure("head 64", phantomField(Kind::head, cubed(64))),
            measure("chest cut by the scan 64", phantomField(Kind::chest, cubed(64))),
            measure("tilted head, thick slices",
                    phantomField(Kind::head, {.size = volume::GridSize{128, 128, 28},
                                              .spacingMm = glm::dvec3(1.9, 1.9, 8.0),
                                              .tiltRad = 0.32})),
            measure("noise sphere 128", noiseSphere(128)),
            measure("head 256", phantomField(Kind::head, cubed(256)))};
}

} // namespace pellucid::bench
