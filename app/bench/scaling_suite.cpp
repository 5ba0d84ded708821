// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "app/bench/suites.h"
#include "core/prepare/prepared_engine.h"

namespace pellucid::bench {

namespace {

// Engine and spatial methods alternate, so that a drifting clock affects all alike.
constexpr int rounds = 8, viewsPerRound = 8;

struct SizeResult {
    double side, frameMs, raySumMs, shearWarpMs;
};

// The times of an engine's frames.
struct FrameSamples {
    std::vector<double> frameMs, sliceMs, transformMs;

    void addRound(render::CpuEngine &engine, const scene::Scene &scene,
                  std::span<const glm::dquat> views) {
        scene::Camera camera = scene.camera;
        for (int view = -1; view < int(views.size()); ++view) { // the first warms the caches
            camera.orientation = views[std::size_t(std::max(0, view))];
            picture::FrameTimes times;
            const double start = millisecondsNow();
            engine.render(camera, scene.image, {}, &times);
            if (view < 0)
                continue;
            frameMs.push_back(millisecondsNow() - start);
            sliceMs.push_back(times.sliceMs);
            transformMs.push_back(times.transformMs);
        }
    }

    void fill(Row &row) const {
        row.frameMs = median(frameMs);
        row.sliceMs = median(sliceMs);
        row.transformMs = median(transformMs);
    }
};

// The times of the peers in space.
struct PeerSamples {
    std::vector<double> castMs, castRate, warpMs;

    void addRound(const SpatialVolume &volume, const scene::Camera &camera, double stepMm) {
        double start = millisecondsNow();
        const SpatialImage rays = raySum(volume, camera, stepMm);
        castMs.push_back(millisecondsNow() - start);
        castRate.push_back(1e-3 * double(rays.sampleCount) / castMs.back());
        start = millisecondsNow();
        shearWarpSum(volume, camera);
        warpMs.push_back(millisecondsNow() - start);
    }

    void fill(Row &row) const {
        row.raySumMs = median(castMs);
        row.raySumMsamplesPerSecond = median(castRate);
        row.shearWarpMs = median(warpMs);
    }
};

// The worst of the ray sum's images.
double raySumError(const SpatialVolume &volume, Truth &truth, double stepMm) {
    double worst = 0.0;
    for (int view = 0; view < truth.views(); ++view)
        worst = std::max(worst, compare(raySum(volume, truth.camera(view), stepMm).samples,
                                        truth.image(view, {scene::Reconstruction::linear, 0.05}))
                                    .relativeL2);
    return worst;
}

// The engines of a plan and of the plan with one width of kernel, each with threads of its own.
struct Engines {
    Engines(const Subject &subject, const scene::Scene &scene) {
        const field::Summary summary = field::summarise(subject.field);
        auto plan = plan::planRender(scene, summary);
        plan::adaptWidths(plan, scene, {&summary, 1});
        const auto spectrum = std::make_shared<const fourier::Spectrum>(
            fourier::Spectrum::prepare(subject.field.values, plan.spectrum));
        const auto widths = prepare::adaptiveWidths({{spectrum}, {}, {}}, plan);
        allThreads = std::make_unique<render::CpuEngine>(spectrum, plan.fieldOfView);
        oneThread = std::make_unique<render::CpuEngine>(spectrum, plan.fieldOfView, 1);
        allThreads->setWidths(widths);
        oneThread->setWidths(widths);
        scene::Scene asked = scene;
        asked.interpolation.isUniform = true;
        const auto single = plan::planRender(asked, summary);
        oneKernel = std::make_unique<render::CpuEngine>(
            std::make_shared<const fourier::Spectrum>(
                fourier::Spectrum::prepare(subject.field.values, single.spectrum)),
            single.fieldOfView);
    }

    std::unique_ptr<render::CpuEngine> allThreads, oneThread, oneKernel;
};

// The row of one thread beside that of all.
Row rowOfOneThread(const Row &row, const std::string &name, const FrameSamples &frames) {
    Row single = row;
    single.name = name + ", one thread";
    single.threads = 1;
    frames.fill(single);
    single.prepareMs = single.fft3dMs = single.raySumMs = single.raySumMsamplesPerSecond =
        single.raySumRelativeL2 = single.shearWarpMs = std::nullopt;
    single.note.clear();
    return single;
}

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

    const Engines engines(subject, how.scene);
    const SpatialVolume inSpace(subject.field.values);
    const double step = lattice.shortestStepMm();
    const auto views = randomViews(rounds * viewsPerRound);
    FrameSamples allThreads, oneThread, oneKernel;
    PeerSamples peers;
    for (int round = 0; round < rounds; ++round) {
        const auto ofRound = std::span(views).subspan(std::size_t(round * viewsPerRound),
                                                      std::size_t(viewsPerRound));
        allThreads.addRound(*engines.allThreads, how.scene, ofRound);
        oneKernel.addRound(*engines.oneKernel, how.scene, ofRound);
        oneThread.addRound(*engines.oneThread, how.scene, ofRound);
        scene::Camera camera = how.scene.camera;
        camera.orientation = ofRound.front();
        peers.addRound(inSpace, camera, step);
    }
    allThreads.fill(row);
    peers.fill(row);
    if (truth.views() > 0)
        row.raySumRelativeL2 = raySumError(inSpace, truth, step);
    const Row single = rowOfOneThread(row, name, oneThread);
    row.note =
        fmt::format("{:.2f} times as fast as with one kernel, {:.0f} times as fast as the ray sum, "
                    "{:.1f} times as fast as the shear-warp sum, {:.2f} times as fast as one "
                    "thread; preparation took {:.2f} times as long as FFTW's 3D transform",
                    median(oneKernel.frameMs) / *row.frameMs, *row.raySumMs / *row.frameMs,
                    *row.shearWarpMs / *row.frameMs, *single.frameMs / *row.frameMs,
                    *row.prepareMs / *row.fft3dMs);
    report(row);
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
