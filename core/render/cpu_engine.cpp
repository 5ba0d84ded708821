// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/cpu_engine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "core/fourier/page_memory.h"
#include "core/render/frame_job.h"
#include "core/task/error.h"
#include "core/task/worker_team.h"

namespace pellucid::render {

namespace {

using Complex = std::complex<float>;
using fourier::stripFloats;
using fourier::stripLanes;

int groupsOf(int rows) {
    return (rows + stripLanes - 1) / stripLanes;
}

// exp(+i 2 pi n turns), n = 0..count-1. Turning step by step in double keeps 1e-13.
std::vector<std::complex<double>> rotations(int count, double turns) {
    std::vector<std::complex<double>> result(count);
    const double angle = 2.0 * std::numbers::pi * (turns - std::floor(turns));
    const double re = std::cos(angle), im = std::sin(angle);
    double x = 1.0, y = 0.0;
    for (auto &r : result) {
        r = {x, y};
        const double next = x * re - y * im;
        y = x * im + y * re;
        x = next;
    }
    return result;
}

// What depends on the slice grid and the roll-off alone, and is kept from frame to frame.
struct GridTables {
    GridTables(const SliceGrid &size, double rollOffShare)
        : grid(size), share(rollOffShare), alongRows(size.rows), halfColumns(size.columns / 2) {
        for (const auto &factor : rotations(size.columns / 2, 1.0 / size.columns))
            untangle.emplace_back(factor);
        const auto radius = [&](int column, int row) {
            return std::hypot(2.0 * column / size.columns, 2.0 * row / size.rows);
        };
        // The Nyquist row and column lie on the edge of the disc, whose roll-off is 0.
        for (int strip = 0; strip < groupsOf(size.columns / 2); ++strip) {
            const int first = strip * stripLanes, last = first + stripLanes - 1;
            StripBounds bounds;
            while (bounds.outerRow + 1 < size.rows / 2 && radius(first, bounds.outerRow + 1) < 1.0)
                ++bounds.outerRow;
            while (bounds.innerRow < bounds.outerRow &&
                   radius(last, bounds.innerRow + 1) <= 1.0 - share)
                ++bounds.innerRow;
            bounds.rollOff = rollOff.size();
            for (int row = bounds.innerRow + 1; row <= bounds.outerRow; ++row)
                for (int column = first; column <= last; ++column)
                    rollOff.push_back(float(rollOffFactor(share, radius(column, row))));
            strips.push_back(bounds);
        }
    }
    SliceGrid grid;
    double share;
    fourier::StripTransform alongRows, halfColumns;
    std::vector<Complex> untangle;
    std::vector<StripBounds> strips;
    std::vector<float> rollOff;
};

} // namespace

// Buffers and tables of the frames of one size.
struct CpuEngine::Workplace {
    explicit Workplace(int threads) : team(threads), scratch(team.slots()) {}

    // A grid is sought, in a fraction of a millisecond, for each new framing only, not for each
    // direction.
    const SliceGrid &gridFor(const Camera &camera, const SliceRoom &around,
                             const volume::Lattice &lattice, const ImageDefinition &image) {
        Camera framing = camera;
        framing.orientation = Camera().orientation;
        if (!framed || framed->camera != framing || framed->image != image)
            framed = Framed{framing, image, sliceGrid(camera, around, lattice, image)};
        return framed->grid;
    }

    // Makes ready for frames of a grid.
    void fit(const SliceGrid &grid, const ImageDefinition &image) {
        for (auto &kept : others)
            if (kept && kept->grid == grid && kept->share == image.rollOff)
                std::swap(tables, kept);
        if (!tables || tables->grid != grid || tables->share != image.rollOff) {
            auto made = std::make_unique<GridTables>(grid, image.rollOff);
            // One that was used before goes.
            others.back() = std::move(others.front());
            others.front() = std::move(tables);
            tables = std::move(made);
        }
        const SliceGrid need{std::max(room.columns, grid.columns), std::max(room.rows, grid.rows)};
        if (need != room)
            allocate(need);
    }

    // Buffers for every grid up to a size.
    void allocate(const SliceGrid &grid) {
        // Set last: if memory runs out half way, nothing here may look ready.
        room = {0, 0};
        const std::size_t stripCount = groupsOf(grid.columns / 2);
        const std::size_t columns = stripCount * stripLanes;
        const std::size_t length = std::size_t(groupsOf(std::max(grid.rows, grid.columns))) *
                                   stripLanes; // rows fill their last group
        const auto floats = [](std::size_t count) {
            auto memory = fourier::allocatePages(count * sizeof(float), "an image of this size");
            std::fill_n(reinterpret_cast<float *>(memory.get()), count, 0.0F);
            return memory;
        };
        lines = floats(groupsOf(grid.rows) * columns * stripFloats);
        columnPhase = floats(2 * columns);
        rowPhase.resize(std::size_t(grid.rows) / 2 + 1);
        batches = fourier::allocatePages(
            scratch.size() * (batchesAhead + 1) * sizeof(FrequencyBatch), "an image of this size");
        strips.clear();
        for (std::size_t n = 0; n < scratch.size(); ++n) {
            strips.push_back(floats(2 * length * stripFloats));
            scratch[n].strips = reinterpret_cast<float *>(strips.back().get());
            scratch[n].beside = scratch[n].strips + length * stripFloats;
            auto *const first = reinterpret_cast<FrequencyBatch *>(batches.get());
            scratch[n].batches = first + n * (batchesAhead + 1);
            std::uninitialized_default_construct_n(scratch[n].batches, batchesAhead + 1);
        }
        room = grid;
    }

    struct Framed {
        Camera camera; // but its orientation
        ImageDefinition image;
        SliceGrid grid;
    };

    task::WorkerTeam team;
    std::vector<FrameScratch> scratch;
    std::optional<Framed> framed;
    // A draft and a full frame take turns while the hand moves: their tables are kept, and a third.
    std::unique_ptr<GridTables> tables;
    std::array<std::unique_ptr<GridTables>, 2> others;
    SliceGrid room{0, 0}; ///< what the buffers hold
    std::shared_ptr<std::byte[]> lines, columnPhase, batches;
    std::vector<std::shared_ptr<std::byte[]>> strips;
    std::vector<Complex> rowPhase;
};

namespace {

struct Frame {
    FrameJob job;
    FrameScratch *scratch;
};

} // namespace

CpuEngine::CpuEngine(std::shared_ptr<const fourier::Spectrum> spectrum,
                     const std::optional<SliceRoom> &room, int threads)
    : m_spectrum(std::move(spectrum)), m_workplace(std::make_unique<Workplace>(threads)),
      m_room(room ? *room : roomOfBox(m_spectrum->lattice(), m_spectrum->layout().box)) {}
CpuEngine::~CpuEngine() = default;

std::string CpuEngine::description() const {
    const int threads = m_workplace->team.threads();
    return fmt::format("CPU engine, {}, {} thread{}", instructionSet(), threads,
                       threads == 1 ? "" : "s");
}

ProjectionImage CpuEngine::render(const Camera &camera, const ImageDefinition &image,
                                  FrameTimes *times) {
    const double start = frameClockSeconds();
    const fourier::SpectrumLayout &layout = m_spectrum->layout();
    const volume::Lattice &lattice = m_spectrum->lattice();
    const SliceGrid grid = m_workplace->gridFor(camera, m_room, lattice, image);
    ProjectionImage result{camera.width, camera.height, camera.pixelMm, {}};
    try {
        m_workplace->fit(grid, image);
        result.samples.resize(std::size_t(camera.width) * camera.height);
    } catch (const std::bad_alloc &) {
        throw task::Error(task::ErrorCode::outOfMemory,
                          "not enough memory for an image of this size");
    }
    Workplace &place = *m_workplace;
    const GridTables &tables = *place.tables;

    const glm::dmat3 axes = camera.axes();
    const double du = 1.0 / (grid.columns * camera.pixelMm);
    const double dv = 1.0 / (grid.rows * camera.pixelMm);
    Frame frame{{}, place.scratch.data()};
    FrameJob &job = frame.job;
    job.spectrum = m_spectrum.get();
    job.image = image;
    job.columns = grid.columns;
    job.rows = grid.rows;
    job.imageColumns = camera.width;
    job.imageRows = camera.height;
    for (int d = 0; d < 3; ++d) {
        // Image rows run downward, against V.
        job.cellsPerColumn[d] = layout.padded[d] * glm::dot(lattice.step(d), axes[0]) * du;
        job.cellsPerRow[d] = -layout.padded[d] * glm::dot(lattice.step(d), axes[1]) * dv;
        job.wraps = job.wraps || lattice.spacingMm(d) > camera.pixelMm * (1.0 + 1e-9);
    }
    job.strips = tables.strips.data();
    job.stripCount = int(tables.strips.size());
    job.rollOff = tables.rollOff.data();
    // exp(+i 2 pi s.(c - x_wrap)) and the position of the first pixel, split into u and v.
    const glm::dvec3 shift = lattice.center().mm - m_spectrum->wrapPoint().mm;
    const double firstU = camera.panMm.x - 0.5 * (camera.width - 1) * camera.pixelMm;
    const double firstV = camera.panMm.y + 0.5 * (camera.height - 1) * camera.pixelMm;
    const int columns = job.stripCount * stripLanes;
    auto *const columnPhase = reinterpret_cast<float *>(place.columnPhase.get());
    const auto turnU = rotations(columns, du * (glm::dot(axes[0], shift) + firstU));
    for (int n = 0; n < columns; ++n) {
        columnPhase[n] = float(turnU[n].real());
        columnPhase[columns + n] = float(turnU[n].imag());
    }
    const auto turnV = rotations(grid.rows / 2 + 1, -dv * (glm::dot(axes[1], shift) + firstV));
    const double unit = du * dv * m_spectrum->unit();
    for (std::size_t n = 0; n < turnV.size(); ++n)
        place.rowPhase[n] = Complex(unit * turnV[n]);
    job.columnPhase = columnPhase;
    job.rowPhase = place.rowPhase.data();
    job.alongRows = &tables.alongRows;
    job.halfColumns = &tables.halfColumns;
    job.untangle = tables.untangle.data();
    job.lines = reinterpret_cast<float *>(place.lines.get());
    job.samples = result.samples.data();
    job.zeroFrequency = m_spectrum->mass() * du * dv;
    for (FrameScratch &scratch : place.scratch)
        scratch.sliceSeconds = scratch.stripSeconds = 0.0;

    double rowsStart = 0.0;
    struct Context {
        Frame &frame;
        double &rowsStart;
    } context{frame, rowsStart};
    using task::WorkerTeam;
    const WorkerTeam::Phase slicing{job.stripCount,
                                    [](void *c, int part, int slot) {
                                        Frame &f = static_cast<Context *>(c)->frame;
                                        sliceStrip(f.job, part, f.scratch[slot]);
                                    },
                                    &context};
    const WorkerTeam::Phase between{
        1, [](void *c, int, int) { static_cast<Context *>(c)->rowsStart = frameClockSeconds(); },
        &context};
    const WorkerTeam::Phase finishing{groupsOf(std::min(camera.height, grid.rows)),
                                      [](void *c, int part, int slot) {
                                          Frame &f = static_cast<Context *>(c)->frame;
                                          finishRows(f.job, part, f.scratch[slot]);
                                      },
                                      &context};
    const std::array<WorkerTeam::Phase, 3> phases{slicing, between, finishing};
    place.team.run(phases);

    if (times != nullptr) {
        // Strips are transformed as soon as they are interpolated: the wall time of the strips is
        // shared out as the threads' own times are.
        const double end = frameClockSeconds();
        double slice = 0.0, strips = 0.0;
        for (const FrameScratch &scratch : place.scratch) {
            slice += scratch.sliceSeconds;
            strips += scratch.stripSeconds;
        }
        const double wall = rowsStart - start;
        const double sliced = strips > 0.0 ? wall * slice / strips : wall;
        *times = {1e3 * sliced, 1e3 * (end - start - sliced)};
    }
    return result;
}

} // namespace pellucid::render
