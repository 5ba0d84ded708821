// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/cpu_engine.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "core/render/frame_inputs.h"
#include "core/render/reasons.h"
#include "core/scene/reasons.h"
#include "core/system/page_memory.h"
#include "core/task/error.h"
#include "core/task/worker_team.h"

namespace pellucid::render {

using Complex = std::complex<float>;
using fourier::stripFloats;
using fourier::stripLanes;

// The state shared by successive frames: threads, buffers, and tables for frames of one size.
struct FrameBuffers {
    FrameBuffers(const plan::FieldOfView &fieldOfView, int threads)
        : team(threads), setup(fieldOfView), scratch(team.slots()) {}

    // Prepares for a frame of a picture of so many rows.
    void fit(const FrameInputs &inputs, int imageRows) {
        const int all = stripsOf(inputs.grid.columns / 2),
                  count = inputs.widthMap ? std::min(all, inputs.widthMap->strips) : all;
        takeTables(inputs.grid, inputs.radial, count, all);
        strips = std::span(tables->strips).first(std::size_t(count));
        const plan::SliceGrid need{std::max(allocated.columns, inputs.grid.columns),
                                   std::max(allocated.rows, inputs.grid.rows)};
        const int images = inputs.mixing.imageCount;
        if (need != allocated || images > allocatedImages)
            allocate(need, std::max(images, allocatedImages));
        fitLines(images, std::size_t(stripsOf(std::min(imageRows, inputs.grid.rows))) *
                             strips.size() * stripLanes * stripFloats);
    }

    // The lines between the two transforms. A picture finer than the voxels has a large grid, of
    // which little is read.
    void fitLines(int images, std::size_t floats) {
        // Views of one zoom differ by less than this in what they read. Much longer lines are
        // freed.
        constexpr std::size_t spare = 8;
        if (lines.size() >= std::size_t(images) && floats <= lineFloats &&
            lineFloats <= spare * floats)
            return;
        lines.clear();
        lineFloats = 0;                               // while memory runs out
        const std::size_t more = floats + floats / 4; // for views that read a little more
        for (int c = 0; c < images; ++c)
            lines.push_back(
                system::allocatePages(more * sizeof(float), task::because::anImageOfThisSize));
        lineFloats = more;
    }

    // `count`: of strips that are needed, of all.
    void takeTables(const plan::SliceGrid &grid, const RadialFactors &factors, int count, int all) {
        const auto fits = [&](const std::unique_ptr<GridTables> &kept) {
            return kept && kept->grid == grid && kept->factors == factors &&
                   int(kept->strips.size()) >= count;
        };
        for (auto &kept : others)
            if (fits(kept))
                std::swap(tables, kept);
        if (fits(tables))
            return;
        // Other views need a few strips more.
        auto made =
            std::make_unique<GridTables>(grid, factors, std::min(all, count + count / 4 + 4));
        // The tables that were used before the current ones are dropped.
        others.back() = std::move(others.front());
        others.front() = std::move(tables);
        tables = std::move(made);
    }

    // Allocates buffers for every grid up to a size.
    void allocate(const plan::SliceGrid &grid, int images) {
        // Set last: if memory runs out half way, the buffers must not look ready.
        allocated = {0, 0};
        allocatedImages = 0;
        const std::size_t stripCount = stripsOf(grid.columns / 2);
        const std::size_t columns = stripCount * stripLanes;
        const std::size_t length = std::size_t(stripsOf(std::max(grid.rows, grid.columns))) *
                                   stripLanes; // rows fill their last group
        const auto floats = [](std::size_t count) {
            auto memory =
                system::allocatePages(count * sizeof(float), task::because::anImageOfThisSize);
            std::fill_n(reinterpret_cast<float *>(memory.get()), count, 0.0F);
            return memory;
        };
        columnPhase = floats(2 * columns);
        rowPhase.resize(std::size_t(grid.rows) / 2 + 1);
        batches =
            system::allocatePages(scratch.size() * (batchesAhead + 1) * sizeof(FrequencyBatch),
                                  task::because::anImageOfThisSize);
        stripMemory.clear();
        for (std::size_t n = 0; n < scratch.size(); ++n) {
            stripMemory.push_back(floats(std::size_t(images + 1) * length * stripFloats));
            auto *const stripBuffer = reinterpret_cast<float *>(stripMemory.back().get());
            for (int c = 0; c < images; ++c)
                scratch[n].strips[std::size_t(c)] =
                    stripBuffer + std::size_t(c) * length * stripFloats;
            scratch[n].spare = stripBuffer + std::size_t(images) * length * stripFloats;
            auto *const first = reinterpret_cast<FrequencyBatch *>(batches.get());
            scratch[n].batches = first + n * (batchesAhead + 1);
            std::uninitialized_default_construct_n(scratch[n].batches, batchesAhead + 1);
        }
        allocated = grid;
        allocatedImages = images;
    }

    // Sets the phases of columns and rows.
    void setPhases(const FrameInputs &inputs) {
        const int columns = int(strips.size()) * stripLanes;
        float *const columnValues = columnPhases();
        const auto turnU = rotations(columns, inputs.geometry.turnsPerColumn);
        for (int n = 0; n < columns; ++n) {
            columnValues[n] = float(turnU[n].real());
            columnValues[columns + n] = float(turnU[n].imag());
        }
        const auto turnV = rotations(inputs.grid.rows / 2 + 1, inputs.geometry.turnsPerRow);
        const double unit = inputs.unit();
        for (std::size_t n = 0; n < turnV.size(); ++n)
            rowPhase[n] = Complex(unit * turnV[n]);
    }

    float *columnPhases() const { return reinterpret_cast<float *>(columnPhase.get()); }

    task::WorkerTeam team;
    FrameSetup setup;
    std::vector<FrameScratch> scratch;
    // Draft and full frames alternate while the user drags: their tables are kept, and one more.
    std::unique_ptr<GridTables> tables;
    std::array<std::unique_ptr<GridTables>, 2> others;
    plan::SliceGrid allocated{0, 0};
    int allocatedImages = 0;
    std::size_t lineFloats = 0; ///< of each image
    std::shared_ptr<std::byte[]> columnPhase, batches;
    std::vector<std::shared_ptr<std::byte[]>> lines, stripMemory;
    std::span<const StripBounds> strips; ///< of the tables, as many as the frame reads
    std::vector<Complex> rowPhase;
};

namespace {

// The threads' job, on buffers that are ready for it.
FrameJob jobFor(const FrameInputs &inputs, const fourier::Spectrum &spectrum,
                const scene::ImageDefinition &image, FrameBuffers &buffers,
                picture::ProjectionImage &result) {
    const GridTables &tables = *buffers.tables;
    FrameJob job = readingJob(inputs, spectrum, image);
    job.imageColumns = result.width;
    job.imageRows = result.height;
    job.pictureChannels = result.channels;
    job.widthMap = inputs.widthMap ? &*inputs.widthMap : nullptr;
    job.strips = buffers.strips.data();
    job.stripCount = int(buffers.strips.size());
    job.rollOff = tables.rollOff.data();
    job.columnPhase = buffers.columnPhases();
    job.rowPhase = buffers.rowPhase.data();
    job.alongRows = &tables.alongRows;
    job.halfColumns = &tables.halfColumns;
    job.unpackReal = tables.unpackReal.data();
    for (std::size_t c = 0; c < std::size_t(job.imageCount); ++c)
        job.lines[c] = reinterpret_cast<float *>(buffers.lines[c].get());
    job.imageColors = inputs.imageColors();
    job.samples = result.samples.data();
    return job;
}

// Runs the phases of a frame one after the other, and records when each part ran.
class FrameRun {
public:
    FrameRun(const FrameJob &job, std::vector<FrameScratch> &scratch)
        : m_job(job), m_scratch(scratch) {
        for (FrameScratch &slot : m_scratch)
            slot.sliceSeconds = slot.stripSeconds = 0.0;
    }

    void runOn(task::WorkerTeam &team) {
        using Phase = task::WorkerTeam::Phase;
        const std::array<Phase, 3> phases{
            Phase{m_job.stripCount, runPart<&FrameRun::sliceStripOf>, this},
            Phase{1, runPart<&FrameRun::noteRowsStart>, this},
            Phase{stripsOf(std::min(m_job.imageRows, m_job.rows)), runPart<&FrameRun::finishRowsOf>,
                  this}};
        team.run(phases);
    }

    // The times of a frame that began at `start` and has just ended. Strips are transformed as soon
    // as they are interpolated, so their wall time is divided in proportion to the threads' own
    // times.
    picture::FrameTimes timesSince(double start) const {
        const double end = frameClockSeconds();
        double slice = 0.0, strips = 0.0;
        for (const FrameScratch &slot : m_scratch) {
            slice += slot.sliceSeconds;
            strips += slot.stripSeconds;
        }
        const double wall = m_rowsStart - start;
        const double sliced = strips > 0.0 ? wall * slice / strips : wall;
        return {1e3 * sliced, 1e3 * (end - start - sliced)};
    }

private:
    template <void (FrameRun::*work)(int part, int slot)>
    static void runPart(void *run, int part, int slot) {
        (static_cast<FrameRun *>(run)->*work)(part, slot);
    }

    void sliceStripOf(int part, int slot) { sliceStrip(m_job, part, m_scratch[std::size_t(slot)]); }
    void noteRowsStart(int, int) { m_rowsStart = frameClockSeconds(); }
    void finishRowsOf(int part, int slot) { finishRows(m_job, part, m_scratch[std::size_t(slot)]); }

    const FrameJob &m_job;
    std::vector<FrameScratch> &m_scratch;
    double m_rowsStart = 0.0;
};

void runOn(task::WorkerTeam &team, int count, const std::function<void(int)> &work) {
    const task::WorkerTeam::Phase phase{
        count,
        [](void *context, int part, int) {
            (*static_cast<const std::function<void(int)> *>(context))(part);
        },
        const_cast<std::function<void(int)> *>(&work)};
    team.run({&phase, 1});
}

} // namespace

CpuEngine::CpuEngine(std::shared_ptr<const fourier::Spectrum> spectrum,
                     const std::optional<plan::FieldOfView> &fieldOfView, int threads)
    : CpuEngine({{spectrum}, {}, shading::shadingScale(spectrum->lattice())},
                fieldOfView ? *fieldOfView
                            : plan::fieldOfViewOf(spectrum->lattice(), spectrum->layout().box),
                threads) {}

CpuEngine::CpuEngine(EngineSpectra spectra, const plan::FieldOfView &fieldOfView, int threads)
    : m_parts{std::move(spectra), {}, fieldOfView},
      m_buffers(std::make_unique<FrameBuffers>(fieldOfView, threads)) {
    m_parts.channelWeights.assign(fieldCount(), {1.0, 1.0, 1.0});
}

CpuEngine::~CpuEngine() = default;

void CpuEngine::setWidths(std::shared_ptr<const widths::AdaptiveWidths> widths) {
    m_parts.adaptive = widths;
    m_buffers->setup.setWidths(std::move(widths));
}

void CpuEngine::setChannelWeights(std::vector<ChannelWeights> channelWeights) {
    m_parts.channelWeights = std::move(channelWeights);
}

std::size_t CpuEngine::bytes() const {
    const EngineSpectra &spectra = m_parts.spectra;
    return (spectra.fields.size() + spectra.gradients.size()) * spectra.fields.front()->bytes();
}

task::Reason CpuEngine::description() const {
    const int threads = m_buffers->team.threads();
    const std::string set = instructionSet();
    return threads == 1 ? task::because::cpuEngineOfOneThread(set, threads)
                        : task::because::cpuEngine(set, threads);
}

scene::Camera CpuEngine::periodOf(const scene::Camera &camera,
                                  const scene::ImageDefinition &image) {
    return m_buffers->setup.periodOf(m_parts.spectra, camera, image);
}

picture::ProjectionImage CpuEngine::render(const scene::Camera &camera,
                                           const scene::ImageDefinition &image,
                                           const shading::Shading &shading,
                                           picture::FrameTimes *times) {
    const double start = frameClockSeconds();
    FrameBuffers &buffers = *m_buffers;
    const FrameInputs inputs = task::orOutOfMemory(task::because::noMemoryForAnImage, [&] {
        return buffers.setup.inputsFor(m_parts.spectra, m_parts.channelWeights, camera, image,
                                       shading,
                                       [&](int count, const std::function<void(int)> &work) {
                                           runOn(buffers.team, count, work);
                                       });
    });
    picture::ProjectionImage result{
        camera.width, camera.height, camera.pixelMm, {}, inputs.pictureChannels()};
    task::orOutOfMemory(task::because::noMemoryForAnImage, [&] {
        if (!inputs.isEmpty())
            buffers.fit(inputs, camera.height);
        result.samples.resize(std::size_t(camera.width) * camera.height *
                              std::size_t(result.channels));
    });
    if (inputs.isEmpty()) {
        std::fill(result.samples.begin(), result.samples.end(), 0.0F);
        if (times != nullptr)
            *times = {};
        return result;
    }
    buffers.setPhases(inputs);
    const FrameJob job = jobFor(inputs, *m_parts.spectra.fields.front(), image, buffers, result);
    FrameRun run(job, buffers.scratch);
    run.runOn(buffers.team);
    if (times != nullptr) {
        *times = run.timesSince(start);
        times->widthShares = inputs.widthShares(m_parts.spectra.fields.front()->layout());
    }
    return result;
}

} // namespace pellucid::render
