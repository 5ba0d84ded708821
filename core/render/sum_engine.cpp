// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/sum_engine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/fourier/transforms/transform.h"
#include "core/render/frame_job.h"
#include "core/render/projection_engine.h"
#include "core/render/reasons.h"
#include "core/scene/reasons.h"
#include "core/task/error.h"

namespace pellucid::render {

namespace {

using Complex = std::complex<float>;

// An even, smooth function of q, tabulated and interpolated by cubics within 1e-7.
class EvenTable {
public:
    EvenTable(double band, const std::function<double(double)> &function) {
        const int last = int(std::ceil(band * perUnit)) + 2;
        for (int n = -1; n <= last; ++n)
            m_values.push_back(function(double(std::abs(n)) / perUnit));
    }
    double operator()(double q) const {
        const double at = std::abs(q) * perUnit;
        const auto n = std::size_t(at);
        const double t = at - double(n);
        const double *const v = m_values.data() + n; // from the sample before
        // Lagrange's cubic through four samples.
        const double a = t + 1.0, b = t, c = t - 1.0, d = t - 2.0;
        return -b * c * d / 6.0 * v[0] + a * c * d / 2.0 * v[1] - a * b * d / 2.0 * v[2] +
               a * b * c / 6.0 * v[3];
    }

private:
    static constexpr double perUnit = 512.0;
    std::vector<double> m_values;
};

// The factor of a frequency along one axis of the lattice: the reconstruction and, along an axis
// whose samples were spread over cells, what undoes that.
class AxisFactor {
public:
    AxisFactor(const scene::ImageDefinition &image, double band, const plan::ShearedAxis *spread)
        : m_image(image), m_table(band, [&](double q) {
              // A band that ends is not smooth.
              const double factor = isTapered() ? 1.0 : scene::reconstructionFactor(image, q);
              return spread == nullptr
                         ? factor
                         : factor / plan::spreadKernel().apodisation(q / spread->cellsPerSample);
          }) {}
    double operator()(double q) const {
        if (!isTapered())
            return m_table(q);
        const double share = scene::rollOffFactor(m_image.rollOff, 2.0 * std::abs(q));
        return share == 0.0 ? 0.0 : share * m_table(q);
    }

private:
    bool isTapered() const { return m_image.reconstruction == scene::Reconstruction::bandLimited; }

    scene::ImageDefinition m_image;
    EvenTable m_table;
};

} // namespace

struct SumEngine::View {
    View(const classify::ShownFields &fields, const volume::VoxelBox &box,
         const scene::Camera &camera, const scene::ImageDefinition &definition,
         const task::Progress &progress)
        : toViewer(camera.axes()[2]), pixelMm(camera.pixelMm), image(definition),
          grid(fields.channels.front().values.lattice(), box, toViewer, pixelMm, image) {
        for (int d = 0; d < 3; ++d) {
            const auto axis = std::find_if(grid.axes.begin(), grid.axes.end(),
                                           [&](const auto &one) { return one.axis == d; });
            factors.emplace_back(image, axis == grid.axes.end() ? grid.alongBand : axis->band,
                                 axis != grid.axes.end() && axis->isSpread ? &*axis : nullptr);
        }
        for (const classify::DensityField &field : fields.channels)
            spectra.emplace_back(field.values, box, grid, progress);
    }
    bool isFor(const scene::Camera &camera, const scene::ImageDefinition &definition) const {
        return camera.axes()[2] == toViewer && camera.pixelMm == pixelMm && definition == image;
    }

    // Whether the spectrum can be read there. Beyond, the picture is zero.
    bool isInBand(const glm::dvec3 &q) const {
        return std::all_of(grid.axes.begin(), grid.axes.end(),
                           [&](const auto &axis) { return std::abs(q[axis.axis]) <= axis.band; });
    }

    glm::dvec3 toViewer;
    double pixelMm;
    scene::ImageDefinition image;
    plan::ShearedGrid grid;
    std::vector<AxisFactor> factors;   ///< by axis of the lattice
    std::vector<ViewSpectrum> spectra; ///< of each channel
};

SumEngine::SumEngine(classify::ShownFields fields, const plan::RenderPlan &plan,
                     const task::Progress &progress)
    : m_fields(std::move(fields)), m_box(plan.spectrum.box), m_fieldOfView(plan.fieldOfView),
      m_progress(progress) {}

SumEngine::~SumEngine() = default;

task::Reason SumEngine::description() const {
    return task::because::sumsAlongTheView(instructionSet());
}

scene::Camera SumEngine::periodOf(const scene::Camera &camera,
                                  const scene::ImageDefinition &image) {
    return m_framed.periodOf(camera, m_fieldOfView, lattice(), image);
}

const SumEngine::View &SumEngine::viewFor(const scene::Camera &camera,
                                          const scene::ImageDefinition &image) {
    if (!m_view || !m_view->isFor(camera, image)) {
        m_view.reset();
        m_view = std::make_unique<View>(m_fields, m_box, camera, image, m_progress);
    }
    return *m_view;
}

picture::ProjectionImage SumEngine::render(const scene::Camera &camera,
                                           const scene::ImageDefinition &image,
                                           [[maybe_unused]] const shading::Shading &shading,
                                           picture::FrameTimes *times) {
    const double start = frameClockSeconds();
    assert(shading.isPlain());
    return task::orOutOfMemory(task::because::noMemoryForAnImage, [&] {
        const plan::SliceGrid grid = m_framed.gridFor(camera, m_fieldOfView, lattice(), image);
        const View &view = viewFor(camera, image);
        const double sliced = frameClockSeconds();
        std::vector<std::vector<float>> planes;
        for (std::size_t n = 0; n < m_fields.channels.size(); ++n)
            planes.push_back(plane(view, n, camera, grid));
        const std::vector<ChannelWeights> weights = channelWeightsOf(m_fields);
        picture::ProjectionImage result{
            camera.width, camera.height, camera.pixelMm, {}, areGrey(weights) ? 1 : 3};
        const auto channels = std::size_t(result.channels);
        result.samples.resize(std::size_t(camera.width) * camera.height * channels);
        tbb::parallel_for(0, camera.height, [&](int r) {
            float *to = result.samples.data() + std::size_t(r) * camera.width * channels;
            for (int c = 0; c < camera.width; ++c, to += channels) {
                const std::size_t at =
                    std::size_t(r % grid.rows) * grid.columns + std::size_t(c % grid.columns);
                for (std::size_t channel = 0; channel < channels; ++channel) {
                    to[channel] = 0.0F;
                    for (std::size_t n = 0; n < planes.size(); ++n)
                        to[channel] += float(weights[n][channel]) * planes[n][at];
                }
            }
        });
        if (times != nullptr)
            *times = {1e3 * (sliced - start), 1e3 * (frameClockSeconds() - sliced), {}};
        return result;
    });
}

std::vector<float> SumEngine::plane(const View &view, std::size_t channel,
                                    const scene::Camera &camera,
                                    const plan::SliceGrid &grid) const {
    const int columns = grid.columns, rows = grid.rows, half = columns / 2;
    const double du = 1.0 / (columns * camera.pixelMm), dv = 1.0 / (rows * camera.pixelMm);
    const double limit = 0.5 / camera.pixelMm;
    const glm::dmat3 axes = camera.axes();
    glm::dvec3 perU, perV; // cycles per sample, by axis
    for (int d = 0; d < 3; ++d) {
        perU[d] = du * glm::dot(lattice().step(d), axes[0]);
        perV[d] = dv * glm::dot(lattice().step(d), axes[1]);
    }
    // The first pixel, and the cell that frequencies see at position 0.
    double turnsPerColumn = du * (camera.panMm.x - 0.5 * (camera.width - 1) * camera.pixelMm),
           turnsPerRow = dv * (camera.panMm.y + 0.5 * (camera.height - 1) * camera.pixelMm);
    for (const plan::ShearedAxis &axis : view.grid.axes) {
        turnsPerColumn -= perU[axis.axis] * axis.middlePosition();
        turnsPerRow -= perV[axis.axis] * axis.middlePosition();
    }
    const auto turnU = rotations(half, turnsPerColumn), turnV = rotations(rows / 2, turnsPerRow);
    const RadialFactors radial(view.image, camera.pixelMm);
    const double unit = du * dv * lattice().cellVolumeMm3();
    const ViewSpectrum &spectrum = view.spectra[channel];
    std::vector<Complex> slice(std::size_t(rows) * std::size_t(half + 1));
    tbb::parallel_for(1 - rows / 2, rows / 2, [&](int kv) {
        Complex *const to = slice.data() + std::size_t((rows - kv) % rows) * std::size_t(half + 1);
        const double sv = kv * dv;
        const auto isRead = [&](int ku) {
            return std::hypot(ku * du, sv) < limit &&
                   view.isInBand(double(kv) * perV + double(ku) * perU);
        };
        // In a convex band, the frequencies that are read are neighbours.
        int from = 0, end = half;
        while (from < end && !isRead(from))
            ++from;
        while (from < end && !isRead(end - 1))
            --end;
        const glm::dvec3 first = double(kv) * perV;
        spectrum.read({first + double(from) * perU, perU, end - from}, to + from);
        const std::complex<double> turn =
            unit * (kv < 0 ? std::conj(turnV[std::size_t(-kv)]) : turnV[std::size_t(kv)]);
        for (int ku = from; ku < end; ++ku) {
            const glm::dvec3 q = first + double(ku) * perU;
            const double factor = radial.at(std::hypot(ku * du, sv) / limit) *
                                  view.factors[0](q[0]) * view.factors[1](q[1]) *
                                  view.factors[2](q[2]);
            to[ku] *= Complex(factor * turn * turnU[std::size_t(ku)]);
        }
    });
    const fourier::InverseTransform2d<float> inverse(rows, columns);
    std::vector<float> result(std::size_t(rows) * std::size_t(columns));
    inverse.run(slice.data(), result.data());
    return result;
}

} // namespace pellucid::render
