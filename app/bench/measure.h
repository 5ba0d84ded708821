// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
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

/// How far an image is from the truth.
struct ImageError {
    double relativeL2 = 0.0, maximum = 0.0, psnrDb = 0.0; ///< maximum: over the truth's largest
};
ImageError compare(const std::vector<float> &image, const std::vector<double> &truth);

/// The exact images of one field from the views that errors are taken at: along two axes, and a
/// few random ones. Made when first asked for.
class Truth {
public:
    /// General views, the first among them, and from two on the front, from three on the top.
    Truth(const Subject &subject, const scene::Camera &camera, int views);
    /// Views in given directions.
    Truth(const Subject &subject, const scene::Camera &camera,
          const std::vector<glm::dquat> &orientations);

    int views() const { return int(m_cameras.size()); }
    const scene::Camera &camera(int view) const { return m_cameras[std::size_t(view)]; }
    const std::vector<double> &image(int view, const scene::ImageDefinition &definition);
    /// What the two peers in space take for this subject, and the ray sum's error against the
    /// `linear` truth; measured when first asked for. The error is the worst of the general views:
    /// along an axis the trilinear field has kinks in every sample's plane, which the pixel's band
    /// limit takes out of the truth and no ray sum can.
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

/// What is rendered, and how often.
struct Measurement {
    scene::Scene scene; ///< its camera is what all views share but the orientation
    /// In place of the plan's, which keeps copies of the projection out of the image.
    std::optional<plan::FieldOfView> fieldOfView = std::nullopt;
    int views = 64;
    int threads = 0;       ///< 0: all
    bool transform = true; ///< time FFTW's own transform of the padded size too
    bool peers = false;    ///< put the spatial peers' figures for the subject into the row
};

/// Plans, prepares and times one case; the error is the worst of the truth's views.
Row measure(const std::string &suite, const std::string &name, const Subject &subject, Truth &truth,
            const Measurement &how);

/// A row with what a plan says; a tolerance only where nothing of the interpolation is fixed, since
/// else nothing is promised.
Row plannedRow(const std::string &suite, const std::string &name, const volume::GridSize &size,
               const plan::RenderPlan &plan, const scene::Scene &scene, int threads);
/// The medians of an engine's frames from random views, into the row. Before each comes `before`,
/// if there is one: a frame of something else to be timed in turns.
void fillTimes(Row &row, render::ProjectionEngine &engine, const scene::Scene &scene, int views,
               const std::function<void(const scene::Camera &)> &before = {});
void fillError(Row &row, const ImageError &error);

/// Times the frames of an engine in turns with those of a plain one of the same camera, without cue
/// and light: what both take depends on the clock and the caches of the moment. The times of the
/// plain frames, median.
double fillTimesInTurns(Row &row, render::ProjectionEngine &engine, render::ProjectionEngine &plain,
                        const scene::Scene &scene, int views);
/// How many times the plain frame that is.
std::string ratioText(const Row &row, double plainMs);

/// The camera of an image of side x side pixels of the shortest step, for any lattice.
scene::Camera squareCamera(const volume::Lattice &lattice, int side);

} // namespace pellucid::bench
