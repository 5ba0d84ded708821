// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/cpu_engine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/render/frame_geometry.h"
#include "core/render/frame_mixing.h"
#include "core/system/page_memory.h"
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
    GridTables(const plan::SliceGrid &size, double rollOffShare)
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
                    rollOff.push_back(float(scene::rollOffFactor(share, radius(column, row))));
            strips.push_back(bounds);
        }
    }
    plan::SliceGrid grid;
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

    // Makes ready for frames of a grid.
    void fit(const plan::SliceGrid &grid, int channels, const scene::ImageDefinition &image) {
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
        const plan::SliceGrid need{std::max(room.columns, grid.columns),
                                   std::max(room.rows, grid.rows)};
        if (need != room || channels > channelRoom)
            allocate(need, std::max(channels, channelRoom));
    }

    // Buffers for every grid up to a size.
    void allocate(const plan::SliceGrid &grid, int channels) {
        // Set last: if memory runs out half way, nothing here may look ready.
        room = {0, 0};
        channelRoom = 0;
        const std::size_t stripCount = groupsOf(grid.columns / 2);
        const std::size_t columns = stripCount * stripLanes;
        const std::size_t length = std::size_t(groupsOf(std::max(grid.rows, grid.columns))) *
                                   stripLanes; // rows fill their last group
        const auto floats = [](std::size_t count) {
            auto memory =
                system::allocatePages(count * sizeof(float), task::because::anImageOfThisSize);
            std::fill_n(reinterpret_cast<float *>(memory.get()), count, 0.0F);
            return memory;
        };
        lines.clear();
        for (int c = 0; c < channels; ++c)
            lines.push_back(floats(groupsOf(grid.rows) * columns * stripFloats));
        columnPhase = floats(2 * columns);
        rowPhase.resize(std::size_t(grid.rows) / 2 + 1);
        batches =
            system::allocatePages(scratch.size() * (batchesAhead + 1) * sizeof(FrequencyBatch),
                                  task::because::anImageOfThisSize);
        strips.clear();
        for (std::size_t n = 0; n < scratch.size(); ++n) {
            strips.push_back(floats(std::size_t(channels + 1) * length * stripFloats));
            auto *const ofStrips = reinterpret_cast<float *>(strips.back().get());
            for (int c = 0; c < channels; ++c)
                scratch[n].strips[std::size_t(c)] =
                    ofStrips + std::size_t(c) * length * stripFloats;
            scratch[n].beside = ofStrips + std::size_t(channels) * length * stripFloats;
            auto *const first = reinterpret_cast<FrequencyBatch *>(batches.get());
            scratch[n].batches = first + n * (batchesAhead + 1);
            std::uninitialized_default_construct_n(scratch[n].batches, batchesAhead + 1);
        }
        room = grid;
        channelRoom = channels;
    }

    // Made for the first frame with a linear cue, in milliseconds.
    const MomentKernels &kernelsFor(const fourier::SpectrumLayout &layout) {
        if (!moments)
            moments.emplace(momentKernels(layout));
        return *moments;
    }

    task::WorkerTeam team;
    std::vector<FrameScratch> scratch;
    FramedGrid framed;
    std::optional<MomentKernels> moments;
    // A draft and a full frame take turns while the hand moves: their tables are kept, and a third.
    std::unique_ptr<GridTables> tables;
    std::array<std::unique_ptr<GridTables>, 2> others;
    plan::SliceGrid room{0, 0}; ///< what the buffers hold
    int channelRoom = 0;
    std::shared_ptr<std::byte[]> columnPhase, batches;
    std::vector<std::shared_ptr<std::byte[]>> lines, strips;
    std::array<std::vector<float>, FrameJob::mostChannels> planes; ///< of pictures with colours
    std::vector<Complex> rowPhase;
};

namespace {

struct Frame {
    FrameJob job;
    FrameScratch *scratch;
    ChannelShares color; ///< of a single image
    float *image;        ///< height x width x 3, if there are colours
};

// 16 rows of the planes as pixels of red, green and blue.
void joinChannels(const Frame &frame, int group) {
    const FrameJob &job = frame.job;
    const std::size_t first = std::size_t(group) * stripLanes * job.imageColumns;
    const std::size_t last =
        std::min(std::size_t(group + 1) * stripLanes, std::size_t(job.imageRows)) *
        job.imageColumns;
    const std::array<float, 3> color{float(frame.color[0]), float(frame.color[1]),
                                     float(frame.color[2])};
    const auto plane = [&](std::size_t c) { return job.samples[job.channels > 1 ? c : 0] + first; };
    joinPlanes({plane(0), plane(1), plane(2)}, color, last - first, frame.image + 3 * first);
}

} // namespace

bool areGrey(std::span<const ChannelShares> shares) {
    return std::all_of(shares.begin(), shares.end(), [](const ChannelShares &share) {
        return share[0] == share[1] && share[1] == share[2];
    });
}

CpuEngine::CpuEngine(std::shared_ptr<const fourier::Spectrum> spectrum,
                     const std::optional<plan::SliceRoom> &room, int threads)
    : CpuEngine({{spectrum}, {}, shading::shadingScale(spectrum->lattice())},
                room ? *room : plan::roomOfBox(spectrum->lattice(), spectrum->layout().box),
                threads) {}

CpuEngine::CpuEngine(EngineSpectra spectra, const plan::SliceRoom &room, int threads)
    : m_spectra(std::move(spectra)), m_shares(m_spectra.fields.size(), {1.0, 1.0, 1.0}),
      m_workplace(std::make_unique<Workplace>(threads)), m_room(room) {}

CpuEngine::~CpuEngine() = default;

void CpuEngine::setShares(std::vector<ChannelShares> shares) {
    m_shares = std::move(shares);
}

std::size_t CpuEngine::bytes() const {
    return (m_spectra.fields.size() + m_spectra.gradients.size()) *
           m_spectra.fields.front()->bytes();
}

task::Reason CpuEngine::description() const {
    const int threads = m_workplace->team.threads();
    const std::string set = instructionSet();
    return threads == 1 ? task::because::cpuEngineOfOneThread(set, threads)
                        : task::because::cpuEngine(set, threads);
}

picture::ProjectionImage CpuEngine::render(const scene::Camera &camera,
                                           const scene::ImageDefinition &image,
                                           const shading::Shading &shading,
                                           picture::FrameTimes *times) {
    const double start = frameClockSeconds();
    const fourier::Spectrum &spectrum = *m_spectra.fields.front();
    const fourier::SpectrumLayout &layout = spectrum.layout();
    const volume::Lattice &lattice = spectrum.lattice();
    const glm::dmat3 axes = camera.axes();
    shading::Shading shone = shading;
    if (!takesLight())
        shone.lights.clear();
    const shading::SliceShading sliceShading = shading::sliceShading(shone, axes, m_spectra.scale);
    const Mixing mixing(m_spectra, m_shares, sliceShading, shone.isGrey());
    const plan::SliceGrid grid = m_workplace->framed.gridFor(camera, m_room, lattice, image);
    const std::size_t pixels = std::size_t(camera.width) * camera.height;
    picture::ProjectionImage result{
        camera.width, camera.height, camera.pixelMm, {}, mixing.grey ? 1 : 3};
    task::orOutOfMemory(task::because::noMemoryForAnImage, [&] {
        m_workplace->fit(grid, mixing.channels, image);
        result.samples.resize(pixels * std::size_t(result.channels));
        for (int c = 0; c < mixing.channels && !mixing.grey; ++c)
            m_workplace->planes[std::size_t(c)].resize(pixels);
    });
    if (mixing.sources.empty()) { // nothing is shown
        if (times != nullptr)
            *times = {};
        return result;
    }
    Workplace &place = *m_workplace;
    const GridTables &tables = *place.tables;

    const FrameGeometry geometry(camera, grid, spectrum);
    Frame frame{{},
                place.scratch.data(),
                mixing.channels == 1 ? mixing.color : ChannelShares{1.0, 1.0, 1.0},
                result.samples.data()};
    FrameJob &job = frame.job;
    job.layout = &layout;
    job.cellLayout = &spectrum.cellLayout();
    job.sources = mixing.sources.data();
    job.sourceCount = int(mixing.sources.size());
    job.channels = mixing.channels;
    job.sums = mixing.sums;
    job.image = image;
    job.columns = grid.columns;
    job.rows = grid.rows;
    job.imageColumns = camera.width;
    job.imageRows = camera.height;
    job.cellsPerColumn = geometry.cellsPerColumn;
    job.cellsPerRow = geometry.cellsPerRow;
    job.edgeSlack = geometry.edgeSlack;
    job.wraps = geometry.wraps;
    job.strips = tables.strips.data();
    job.stripCount = int(tables.strips.size());
    job.rollOff = tables.rollOff.data();
    FrameShading frameShades = frameShading(sliceShading, mixing, spectrum, geometry.toWrap,
                                            axes[2], m_spectra.scale.stepMm);
    if (frameShades.cued)
        frameShades.kernels = &place.kernelsFor(layout);
    if (!sliceShading.isPlain())
        job.shading = &frameShades;
    const int columns = job.stripCount * stripLanes;
    auto *const columnPhase = reinterpret_cast<float *>(place.columnPhase.get());
    const auto turnU = rotations(columns, geometry.turnsPerColumn);
    for (int n = 0; n < columns; ++n) {
        columnPhase[n] = float(turnU[n].real());
        columnPhase[columns + n] = float(turnU[n].imag());
    }
    const auto turnV = rotations(grid.rows / 2 + 1, geometry.turnsPerRow);
    // A single grey image has its share at once.
    const double unit = geometry.cellArea * mixing.unit * (mixing.grey ? mixing.color[0] : 1.0);
    for (std::size_t n = 0; n < turnV.size(); ++n)
        place.rowPhase[n] = Complex(unit * turnV[n]);
    job.columnPhase = columnPhase;
    job.rowPhase = place.rowPhase.data();
    job.alongRows = &tables.alongRows;
    job.halfColumns = &tables.halfColumns;
    job.untangle = tables.untangle.data();
    for (std::size_t c = 0; c < std::size_t(job.channels); ++c) {
        job.lines[c] = reinterpret_cast<float *>(place.lines[c].get());
        job.samples[c] = mixing.grey ? result.samples.data() : place.planes[c].data();
    }
    job.zero = zeroSums(mixing, frameShades, layout);
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
    const WorkerTeam::Phase finishing{job.channels * groupsOf(std::min(camera.height, grid.rows)),
                                      [](void *c, int part, int slot) {
                                          Frame &f = static_cast<Context *>(c)->frame;
                                          finishRows(f.job, part % f.job.channels,
                                                     part / f.job.channels, f.scratch[slot]);
                                      },
                                      &context};
    const WorkerTeam::Phase joining{
        groupsOf(camera.height),
        [](void *c, int part, int) { joinChannels(static_cast<Context *>(c)->frame, part); },
        &context};
    const std::array<WorkerTeam::Phase, 4> phases{slicing, between, finishing, joining};
    place.team.run(std::span(phases).first(mixing.grey ? 3 : 4));

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
