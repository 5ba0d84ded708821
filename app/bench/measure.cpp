// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "core/fourier/transforms/transform.h"
#include "core/prepare/prepared_engine.h"

namespace pellucid::bench {

double millisecondsNow() {
    return std::chrono::duration<double, std::milli>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

std::vector<glm::dquat> randomViews(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<glm::dquat> views;
    for (int n = 0; n < count; ++n) {
        const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
        views.push_back(glm::normalize(glm::dquat(w, x, y, z)));
    }
    return views;
}

ImageError compare(std::span<const float> image, const std::vector<double> &truth) {
    double difference = 0.0, energy = 0.0, peak = 0.0, maximum = 0.0;
    for (std::size_t n = 0; n < truth.size(); ++n) {
        const double e = double(image[n]) - truth[n];
        difference += e * e;
        energy += truth[n] * truth[n];
        peak = std::max(peak, std::abs(truth[n]));
        maximum = std::max(maximum, std::abs(e));
    }
    if (energy == 0.0) // an empty field: any nonzero pixel is wrong
        return {std::sqrt(difference), maximum, 0.0};
    const double psnr = difference > 0.0
                            ? 10.0 * std::log10(peak * peak * double(truth.size()) / difference)
                            : 999.0;
    return {std::sqrt(difference / energy), maximum / peak, psnr};
}

scene::Camera squareCamera(const volume::Lattice &lattice, int side) {
    scene::Camera camera = scene::defaultCamera(lattice);
    camera.width = camera.height = side;
    return camera;
}

Truth::Truth(const Subject &subject, const scene::Camera &camera, int views) : m_subject(subject) {
    const auto random = randomViews(views, 11);
    for (int view = 0; view < views; ++view) {
        m_cameras.push_back(camera);
        m_cameras.back().orientation =
            view == 1   ? scene::viewOrientation(scene::StandardView::front)
            : view == 2 ? scene::viewOrientation(scene::StandardView::top)
                        : random[std::size_t(view)];
    }
}

Truth::Truth(const Subject &subject, const scene::Camera &camera,
             const std::vector<glm::dquat> &orientations)
    : m_subject(subject), m_cameras(orientations.size(), camera) {
    for (std::size_t n = 0; n < orientations.size(); ++n)
        m_cameras[n].orientation = orientations[n];
}

const std::vector<double> &Truth::image(int view, const scene::ImageDefinition &definition) {
    if (!m_reference)
        m_reference = std::make_unique<reference::WideKernel>(m_subject.field.values,
                                                              m_subject.field.support);
    if (definition.rollOff != m_rollOff)
        m_images.clear();
    m_rollOff = definition.rollOff;
    auto &slot = m_images[{view, int(definition.reconstruction)}];
    if (slot.empty())
        slot = m_reference->image(camera(view), definition);
    return slot;
}

namespace {

bool looksAlongAnAxis(const scene::Camera &camera, const volume::Lattice &lattice) {
    for (int d = 0; d < 3; ++d)
        if (std::abs(glm::dot(camera.axes()[2], glm::normalize(lattice.step(d)))) > 1.0 - 1e-9)
            return true;
    return false;
}

} // namespace

const Truth::Peers &Truth::peers() {
    if (m_peers)
        return *m_peers;
    const SpatialVolume volume(m_subject.field.values);
    const double step = m_subject.field.values.lattice().shortestStepMm();
    Peers peers;
    std::vector<double> cast, rate, warp;
    for (int n = 0; n < views(); ++n) {
        double start = millisecondsNow();
        const SpatialImage rays = raySum(volume, camera(n), step);
        cast.push_back(millisecondsNow() - start);
        rate.push_back(1e-3 * double(rays.sampleCount) / cast.back());
        start = millisecondsNow();
        shearWarpSum(volume, camera(n));
        warp.push_back(millisecondsNow() - start);
        if (looksAlongAnAxis(camera(n), m_subject.field.values.lattice()))
            continue;
        peers.raySumRelativeL2 = std::max(
            peers.raySumRelativeL2,
            compare(rays.samples, image(n, {scene::Reconstruction::linear, 0.05})).relativeL2);
    }
    peers.raySumMs = median(cast);
    peers.raySumMsamplesPerSecond = median(rate);
    peers.shearWarpMs = median(warp);
    return m_peers.emplace(peers);
}

namespace {

// FFTW's own in-place transform of the padded size; planning is not timed.
double transformMs(const fourier::SpectrumLayout &layout) {
    const volume::GridSize p = layout.padded;
    const int stride = p.i / 2 + 1;
    std::vector<std::complex<float>> data(std::size_t(stride) * p.j * p.k);
    const fourier::ForwardTransform3d transform(data.data(), p, stride, p.j);
    for (std::size_t n = 0; n < data.size(); ++n)
        data[n] = {float(n % 7), float(n % 5)};
    const double start = millisecondsNow();
    transform.run();
    return millisecondsNow() - start;
}

} // namespace

Row plannedRow(const std::string &suite, const std::string &name, const volume::GridSize &size,
               const plan::RenderPlan &plan, const scene::Scene &scene, int threads) {
    const int width = plan.spectrum.width();
    Row row{suite,
            name,
            size,
            "cpu",
            plan.spectrum.kernels[0].name(),
            width * width * width,
            double(plan.spectrum.padded.i) / plan.spectrum.box.size().i,
            fourier::storageName(plan.spectrum.storage),
            threads > 0 ? threads : thisMachine().threads};
    row.predictedError = plan.predictedError;
    if (scene.interpolation.isPlanned())
        row.tolerance = scene.tolerance;
    return row;
}

void fillTimes(Row &row, render::ProjectionEngine &engine, const scene::Scene &scene, int views,
               const std::function<void(const scene::Camera &)> &before) {
    scene::Camera camera = scene.camera;
    std::vector<double> slice, transform, frame;
    for (const glm::dquat &orientation : randomViews(views)) {
        camera.orientation = orientation;
        if (before)
            before(camera);
        picture::FrameTimes times;
        const double start = millisecondsNow();
        engine.render(camera, scene.image, scene.shading, &times);
        frame.push_back(millisecondsNow() - start);
        slice.push_back(times.sliceMs);
        transform.push_back(times.transformMs);
    }
    row.sliceMs = median(slice);
    row.transformMs = median(transform);
    row.frameMs = median(frame);
}

double fillTimesInTurns(Row &row, render::ProjectionEngine &engine, render::ProjectionEngine &plain,
                        const scene::Scene &scene, int views) {
    std::vector<double> plainMs;
    fillTimes(row, engine, scene, views, [&](const scene::Camera &camera) {
        const double start = millisecondsNow();
        plain.render(camera, scene.image);
        plainMs.push_back(millisecondsNow() - start);
    });
    return median(plainMs);
}

std::string ratioText(const Row &row, double plainMs) {
    return fmt::format("{:.2f} times the plain frame of {:.2f} ms, alternating",
                       *row.frameMs / plainMs, plainMs);
}

void fillError(Row &row, const ImageError &error) {
    row.relativeL2 = error.relativeL2;
    row.maxError = error.maximum;
    row.psnrDb = error.psnrDb;
}

Row measure(const std::string &suite, const std::string &name, const Subject &subject, Truth &truth,
            const Measurement &how) {
    const classify::DensityField &field = subject.field;
    const field::Summary summary = field::summarise(field);
    auto plan = plan::planRender(how.scene, summary);
    if (!how.fieldOfView)
        plan::adaptWidths(plan, how.scene, {&summary, 1});
    Row row = plannedRow(suite, name, field.values.lattice().size(), plan, how.scene, how.threads);
    const double start = millisecondsNow();
    const auto spectrum = std::make_shared<const fourier::Spectrum>(
        fourier::Spectrum::prepare(field.values, plan.spectrum));
    auto widths = prepare::adaptiveWidths({{spectrum}, {}, {}}, plan);
    row.prepareMs = millisecondsNow() - start;
    if (how.transform)
        row.fft3dMs = transformMs(plan.spectrum);
    row.bytes = double(spectrum->bytes());
    render::CpuEngine engine(spectrum, how.fieldOfView.value_or(plan.fieldOfView), how.threads);
    engine.setWidths(std::move(widths));
    fillTimes(row, engine, how.scene, how.views);

    ImageError worst{0.0, 0.0, 1e9};
    for (int view = 0; view < truth.views(); ++view) {
        const auto image = engine.render(truth.camera(view), how.scene.image, how.scene.shading);
        const ImageError error = compare(image.samples, truth.image(view, how.scene.image));
        worst = {std::max(worst.relativeL2, error.relativeL2),
                 std::max(worst.maximum, error.maximum), std::min(worst.psnrDb, error.psnrDb)};
    }
    if (truth.views() > 0) {
        fillError(row, worst);
        if (how.peers) {
            const Truth::Peers &peers = truth.peers();
            row.raySumMs = peers.raySumMs;
            row.raySumMsamplesPerSecond = peers.raySumMsamplesPerSecond;
            row.raySumRelativeL2 = peers.raySumRelativeL2;
            row.shearWarpMs = peers.shearWarpMs;
        }
    }
    return row;
}

} // namespace pellucid::bench
