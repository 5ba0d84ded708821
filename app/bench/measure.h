// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "app/bench/report.h"
#include "app/bench/spatial_peers.h"
#include "app/bench/subjects.h"
#include "core/plan/render_plan.h"
#include "core/reference/wide_kernel.h"
#include "core/render/cpu_engine.h"

namespace pellucid::bench {

double millisecondsNow();
double median(std::vector<double> values);
/// The views of every suite: a sequence of random rotations.
std::vector<glm::dquat> randomViews(int count, unsigned seed = 7);

/// The error of an image against the exact one. `maximum`: relative to the largest exact value.
struct ImageError {
    double relativeL2 = 0.0, maximum = 0.0, psnrDb = 0.0;
};
ImageError compare(std::span<const float> image, const std::vector<double> &truth);

/// The exact images of one field in the views at which errors are measured: two along axes and a
/// few random ones. Computed on first use.
class Truth {
public:
    /// `views` views: random ones, but the second is the front and the third the top.
    Truth(const Subject &subject, const scene::Camera &camera, int views);
    /// The given views.
    Truth(const Subject &subject, const scene::Camera &camera,
          const std::vector<glm::dquat> &orientations);

    int views() const { return int(m_cameras.size()); }
    const scene::Camera &camera(int view) const { return m_cameras[std::size_t(view)]; }
    const std::vector<double> &image(int view, const scene::ImageDefinition &definition);
    /// The times of the two spatial methods for this subject, and the ray sum's error against the
    /// exact `linear` image, measured on first use. The error is the worst over general views:
    /// along an axis, the trilinear field has kinks in every plane of samples, which the pixels'
    /// band limit removes from the exact image but not from a ray sum.
    struct Peers {
        double raySumMs = 0.0, raySumMsamplesPerSecond = 0.0, raySumRelativeL2 = 0.0,
               shearWarpMs = 0.0;
    };
    const Peers &peers();

private:
    const Subject &m_subject;
    std::vector<scene::Camera> m_cameras;
    std::optional<Peers> m_peers;
    std::unique_ptr<reference::WideKernel> m_reference;
    std::map<std::pair<int, int>, std::vector<double>> m_images;
    double m_rollOff = -1.0;
};

/// The settings of a measurement.
struct Measurement {
    scene::Scene scene; ///< all views share its camera except for the orientation
    /// Replaces the plan's, which keeps copies of the projection out of the image.
    std::optional<plan::FieldOfView> fieldOfView = std::nullopt;
    int views = 64;
    int threads = 0;       ///< 0: all
    bool transform = true; ///< also time FFTW's own transform of the padded size
    bool peers = false;    ///< add the figures of the spatial methods to the row
};

/// Plans, prepares and times one case. The error is the worst over the views of `truth`.
Row measure(const std::string &suite, const std::string &name, const Subject &subject, Truth &truth,
            const Measurement &how);

/// A row with the figures of a plan. It has a tolerance only if the interpolation is not fixed;
/// otherwise the plan need not keep it.
Row plannedRow(const std::string &suite, const std::string &name, const volume::GridSize &size,
               const plan::RenderPlan &plan, const scene::Scene &scene, int threads);
/// Fills in the median times of an engine's frames from random views. `before`, if given, runs
/// before each frame, for example to time a different engine alternately.
void fillTimes(Row &row, render::ProjectionEngine &engine, const scene::Scene &scene, int views,
               const std::function<void(const scene::Camera &)> &before = {});
void fillError(Row &row, const ImageError &error);

/// Times an engine's frames, alternating with frames of a plain engine (same camera, no cue or
/// light), so that both see the same clock rate and caches. Returns the median time of the plain
/// frames.
double fillTimesInTurns(Row &row, render::ProjectionEngine &engine, render::ProjectionEngine &plain,
                        const scene::Scene &scene, int views);
/// The row's frame time relative to the plain frame, as a note.
std::string ratioText(const Row &row, double plainMs);

/// A camera for side x side pixels, each as large as the lattice's shortest step.
scene::Camera squareCamera(const volume::Lattice &lattice, int side);

} // namespace pellucid::bench
