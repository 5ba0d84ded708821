// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "app/bench/suites.h"

namespace pellucid::bench {

namespace {

// Frames and peers in turns, so that a processor whose clock drifts serves all alike.
constexpr int rounds = 8, viewsARound = 8;

struct SizeResult {
    double side, frameMs, raySumMs, shearWarpMs;
};

SizeResult measureSize(const Report &report, const Subject &subject, const std::string &name,
                       int checkedViews) {
    const volume::Lattice &lattice = subject.field.values.lattice();
    const volume::GridSize n = lattice.size();
    const int side = std::max({n.i, n.j, n.k});
    Measurement how;
    how.scene.camera = squareCamera(lattice, side);
    how.views = 1;
    Truth truth(subject, how.scene.camera, checkedViews);
    Row row = measure("scaling", "default " + name, subject, truth, how);

    const auto plan = plan::planRender(how.scene, plan::summarise(subject.field));
    const auto spectrum = std::make_shared<const fourier::Spectrum>(
        fourier::Spectrum::prepare(subject.field.values, plan.spectrum));
    render::CpuEngine engine(spectrum, plan.room), alone(spectrum, plan.room, 1);
    const SpatialVolume inSpace(subject.field.values);
    const double step = lattice.shortestStepMm();
    std::vector<double> frame, slice, transform, aloneFrame, aloneSlice, aloneTransform;
    std::vector<double> cast, castRate, warp;
    const auto views = randomViews(rounds * viewsARound);
    scene::Camera camera = how.scene.camera;
    for (int round = 0; round < rounds; ++round) {
        const auto render = [&](render::CpuEngine &with, std::vector<double> &total,
                                std::vector<double> &sliced, std::vector<double> &transformed) {
            for (int view = -1; view < viewsARound; ++view) { // the first warms the caches
                camera.orientation = views[std::size_t(round * viewsARound + std::max(0, view))];
                picture::FrameTimes times;
                const double start = millisecondsNow();
                with.render(camera, how.scene.image, {}, &times);
                if (view < 0)
                    continue;
                total.push_back(millisecondsNow() - start);
                sliced.push_back(times.sliceMs);
                transformed.push_back(times.transformMs);
            }
        };
        render(engine, frame, slice, transform);
        render(alone, aloneFrame, aloneSlice, aloneTransform);
        camera.orientation = views[std::size_t(round * viewsARound)];
        double start = millisecondsNow();
        const SpatialImage rays = raySum(inSpace, camera, step);
        cast.push_back(millisecondsNow() - start);
        castRate.push_back(1e-3 * double(rays.sampleCount) / cast.back());
        start = millisecondsNow();
        shearWarpSum(inSpace, camera);
        warp.push_back(millisecondsNow() - start);
    }
    row.frameMs = median(frame);
    row.sliceMs = median(slice);
    row.transformMs = median(transform);
    row.raySumMs = median(cast);
    row.raySumMsamplesPerSecond = median(castRate);
    row.shearWarpMs = median(warp);
    double worst = 0.0;
    for (int view = 0; view < truth.views(); ++view)
        worst = std::max(worst, compare(raySum(inSpace, truth.camera(view), step).samples,
                                        truth.image(view, {scene::Reconstruction::linear, 0.05}))
                                    .relativeL2);
    if (truth.views() > 0)
        row.raySumRelativeL2 = worst;
    const double aloneMs = median(aloneFrame);
    row.note =
        fmt::format("{:.0f} times the ray sum, {:.1f} times the shear-warp sum; {:.2f} times "
                    "one thread; prepared in {:.2f} times FFTW's 3D transform",
                    *row.raySumMs / *row.frameMs, *row.shearWarpMs / *row.frameMs,
                    aloneMs / *row.frameMs, *row.prepareMs / *row.fft3dMs);
    report(row);

    Row single = row;
    single.name = name + ", one thread";
    single.threads = 1;
    single.frameMs = aloneMs;
    single.sliceMs = median(aloneSlice);
    single.transformMs = median(aloneTransform);
    single.prepareMs = single.fft3dMs = single.raySumMs = single.raySumMsamplesPerSecond =
        single.raySumRelativeL2 = single.shearWarpMs = std::nullopt;
    single.note.clear();
    report(single);
    return {double(side), *row.frameMs, *row.raySumMs, *row.shearWarpMs};
}

// The least-squares slope of log(time) over log(side).
double exponent(const std::vector<SizeResult> &results, double SizeResult::*time) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const SizeResult &r : results) {
        const double u = std::log(r.side), v = std::log(r.*time);
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    const auto n = double(results.size());
    return (n * xy - x * y) / (n * xx - x * x);
}

} // namespace

void runScalingSuite(const Report &report, const Subject *given) {
    if (given != nullptr) {
        measureSize(report, *given, given->name, 2);
        return;
    }
    std::vector<SizeResult> results;
    for (const int n : {128, 192, 256, 384, 512}) {
        const Subject subject = noiseSphere(n);
        results.push_back(measureSize(report, subject, subject.name, n > 256 ? 1 : 2));
    }
    Row growth{"scaling", "growth from 128 to 512", {512, 512, 512}, "cpu"};
    growth.threads = thisMachine().threads;
    growth.note = fmt::format(
        "time grows with the side to the power {:.2f}; the ray sum's {:.2f}, the shear-warp "
        "sum's {:.2f}",
        exponent(results, &SizeResult::frameMs), exponent(results, &SizeResult::raySumMs),
        exponent(results, &SizeResult::shearWarpMs));
    report(growth);
    for (const int n : {128, 256, 512}) {
        const Subject subject =
            phantomSubject(fmt::format("chest cut by the scan {}", n), phantom::Kind::chest,
                           {.size = volume::GridSize{n, n, n}});
        measureSize(report, subject, subject.name, n > 256 ? 1 : 2);
    }
}

} // namespace pellucid::bench
