// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/frame_passes.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include <epoxy/gl.h>

#include "core/task/error.h"
#include "gpu/buffer.h"
#include "gpu/reasons.h"
#include "gpu/transform_passes.h"

namespace pellucid::gpu {

namespace {

// One that is shown, one that waits to be shown, one being rendered, and one still being read.
constexpr std::size_t maxTargets = 4;
constexpr std::size_t maxTables = 3;
constexpr GLuint64 maxWaitNs = 10'000'000'000;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

struct CardTables {
    explicit CardTables(const plan::SliceGrid &of) : grid(of), tables(of) {
        rotations.upload(tables.rotations.data(),
                         tables.rotations.size() * sizeof(tables.rotations[0]));
        discRows.upload(tables.discRows.data(),
                        tables.discRows.size() * sizeof(tables.discRows[0]));
    }
    plan::SliceGrid grid;
    GridTables tables;
    Buffer rotations, discRows;
};

Defines sliceDefines(const FrameCommand &c) {
    return {{"WIDTH", c.width},
            {"EVEN_TERMS", c.evenTerms},
            {"MOMENT_TERMS", c.momentTerms},
            {"FIELD_PAGES", c.fieldPages},
            {"PAGES", int(c.pages.size())},
            {"SLABS", c.slabs},
            {"SUMS", c.sums},
            {"IMAGES", c.layers},
            {"SHADED", c.shaded ? 1 : 0},
            {"CUED", c.cued ? 1 : 0},
            {"LIT", c.lit ? 1 : 0}};
}

void bindPages(const FrameCommand &command) {
    for (std::size_t n = 0; n < command.pages.size(); ++n) {
        glActiveTexture(GLenum(GL_TEXTURE0 + bindings::firstSpectrum + n));
        glBindTexture(GL_TEXTURE_3D, command.pages[n]);
    }
    glActiveTexture(GL_TEXTURE0);
}

} // namespace

struct CardPicture::Target {
    ~Target() { remove(drawn.exchange(nullptr)); }
    static void remove(void *sync) {
        if (sync != nullptr)
            glDeleteSync(static_cast<GLsync>(sync));
    }
    PixelTexture texture;
    /// GLsync of the context that last drew the picture.
    std::atomic<void *> drawn = nullptr;
};

// Used on the device's thread.
struct FramePasses::Resources {
    explicit Resources(Device &device) : transform(device) {
        for (QueryName &query : stamps)
            query = makeQuery();
    }

    const CardTables &tablesFor(const plan::SliceGrid &grid) {
        const auto known = std::find_if(tables.begin(), tables.end(),
                                        [&](const auto &t) { return t->grid == grid; });
        if (known != tables.end()) {
            std::rotate(tables.begin(), known, known + 1);
        } else {
            // Draft and full frames alternate while the user drags.
            tables.insert(tables.begin(), std::make_unique<CardTables>(grid));
            tables.resize(std::min(tables.size(), maxTables));
        }
        return *tables.front();
    }

    // The widths change with the view.
    void bindTileWidths(const std::vector<std::int32_t> &ofFrame) {
        if (ofFrame != shownWidths || shownWidths.empty()) {
            shownWidths = ofFrame;
            shownWidths.resize(std::max<std::size_t>(1, shownWidths.size()));
            tileWidths.upload(shownWidths.data(), shownWidths.size() * sizeof(shownWidths[0]));
        }
        tileWidths.bindStorage(bindings::tileWidths);
    }

    double stampMs(std::size_t from, std::size_t to) const {
        GLuint64 begin = 0, end = 0;
        glGetQueryObjectui64v(stamps[from].name(), GL_QUERY_RESULT, &begin);
        glGetQueryObjectui64v(stamps[to].name(), GL_QUERY_RESULT, &end);
        return end > begin ? 1e-6 * double(end - begin) : 0.0;
    }

    TransformPasses transform;
    Buffer block, tileWidths;
    std::vector<std::int32_t> shownWidths; ///< in `tileWidths`
    std::vector<std::unique_ptr<CardTables>> tables;
    std::array<QueryName, 3> stamps;
};

void CardPicture::markDrawn() const {
    Target::remove(m_target->drawn.exchange(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)));
    glFlush(); // else other contexts may never see the fence signalled
}

picture::ProjectionImage CardPicture::download() const {
    picture::Samples planes;
    m_passes->device().run([&] { planes = m_texture->download(); });
    picture::ProjectionImage image{m_width, m_height, m_pixelMm, {}, m_channels};
    if (m_channels == 1) {
        image.samples = std::move(planes);
        return image;
    }
    const std::size_t pixels = std::size_t(m_width) * std::size_t(m_height);
    image.samples.resize(3 * pixels);
    for (std::size_t n = 0; n < pixels; ++n)
        for (std::size_t c = 0; c < 3; ++c) {
            float sum = 0.0F;
            for (std::size_t layer = 0; layer < std::size_t(m_layers); ++layer)
                sum += m_colors[layer][c] * planes[layer * pixels + n];
            image.samples[3 * n + c] = sum;
        }
    return image;
}

FramePasses::FramePasses(std::shared_ptr<Device> device) : m_device(std::move(device)) {
    m_device->run([&] {
        m_resources = OnDevice<Resources>(new Resources(*m_device),
                                          DeleteOnDevice<Resources>{m_device.get()});
    });
}

FramePasses::~FramePasses() = default;

std::shared_ptr<CardPicture> FramePasses::pictureFor(const scene::Camera &camera, int layers) {
    auto picture = std::make_shared<CardPicture>();
    const auto isFree = [](const auto &target) { return target.use_count() == 1; };
    const auto free = std::find_if(m_targets.begin(), m_targets.end(), isFree);
    if (free != m_targets.end()) {
        picture->m_target = *free;
        std::rotate(m_targets.begin(), free, free + 1);
        // The most recently used is last.
        std::rotate(m_targets.begin(), m_targets.begin() + 1, m_targets.end());
    } else {
        // Deleted on the device's thread, whichever thread releases it.
        picture->m_target = std::shared_ptr<CardPicture::Target>(
            new CardPicture::Target, [device = m_device](CardPicture::Target *target) {
                device->post([target] { delete target; });
            });
        if (m_targets.size() < maxTargets)
            m_targets.push_back(picture->m_target);
    }
    CardPicture::Target &target = *picture->m_target;
    if (auto *const sync = static_cast<GLsync>(target.drawn.exchange(nullptr))) {
        glWaitSync(sync, 0, GL_TIMEOUT_IGNORED);
        glDeleteSync(sync);
    }
    const int largest = m_device->capabilities().largest2dTexture;
    if (std::max(camera.width, camera.height) > largest)
        throw task::Error(task::ErrorCode::outOfMemory, task::because::imageExceedsTextures(
                                                            camera.width, camera.height, largest));
    target.texture.reserve(camera.width, camera.height, layers);
    picture->m_passes = shared_from_this();
    picture->m_texture = &target.texture;
    picture->m_width = camera.width;
    picture->m_height = camera.height;
    picture->m_pixelMm = camera.pixelMm;
    picture->m_layers = layers;
    return picture;
}

std::shared_ptr<const CardPicture> FramePasses::empty(const scene::Camera &camera, int channels) {
    std::shared_ptr<CardPicture> picture;
    m_device->run([&] {
        picture = pictureFor(camera, 1);
        picture->m_target->texture.clear();
        glFinish();
    });
    picture->m_channels = channels;
    return picture;
}

std::shared_ptr<const CardPicture> FramePasses::render(FrameCommand &&command, CardTimes *times) {
    std::shared_ptr<CardPicture> picture;
    m_device->run([&] {
        const double start = now();
        Resources &resources = *m_resources;
        TransformPasses &transform = resources.transform;
        transform.fit(command.grid, command.layers);
        const CardTables &tables = resources.tablesFor(command.grid);
        picture = pictureFor(command.camera, command.layers);
        FrameBlock &block = command.block;
        setTransforms(block, command.grid, command.camera.width, command.camera.height,
                      tables.tables);
        resources.block.upload(&block, sizeof(block));
        resources.block.bindUniform(bindings::frameBlock);
        tables.rotations.bindStorage(bindings::rotations);
        tables.discRows.bindStorage(bindings::discRows);
        resources.bindTileWidths(command.tileWidths);
        bindPages(command);

        glQueryCounter(resources.stamps[0].name(), GL_TIMESTAMP);
        const int halfColumns = command.grid.columns / 2, rows = command.grid.rows;
        Defines defines = sliceDefines(command);
        // Several images share their taps, so slice.comp computes their slices together.
        const bool isFused = command.layers == 1 && rows <= transform.longestShared();
        TransformPasses::Lines lines = transform.sharedLines(block);
        int dispatches = 1;
        if (isFused) {
            defines.insert(defines.end(), {{"FUSED", 1}, {"ROOM", TransformPasses::roomFor(rows)}});
            glUseProgram(m_device->program("columns.comp", defines).id());
            transform.lines().bindStorage(bindings::lines);
            dispatchGroups(halfColumns, 1, 1);
        } else {
            glUseProgram(m_device->program("slice.comp", defines).id());
            transform.slice().bindStorage(bindings::slice);
            dispatchGroups((halfColumns + 7) / 8, (rows + 15) / 16, 1);
        }
        glQueryCounter(resources.stamps[1].name(), GL_TIMESTAMP);
        if (!isFused)
            lines = transform.transformColumns(block, command.layers);
        transform.transformRows(block, command.layers, lines, picture->m_target->texture);
        glQueryCounter(resources.stamps[2].name(), GL_TIMESTAMP);
        dispatches += transform.takeDispatches();
        const double submitted = now();
        // Wait here, so that a context that draws the picture need not; the processor is idle
        // anyway.
        const GLsync done = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        const GLenum waited = glClientWaitSync(done, GL_SYNC_FLUSH_COMMANDS_BIT, maxWaitNs);
        glDeleteSync(done);
        checkErrors("a frame");
        if (waited != GL_ALREADY_SIGNALED && waited != GL_CONDITION_SATISFIED)
            throw task::Error(task::ErrorCode::noSuchDevice, task::because::cardDoesNotAnswer);
        if (times != nullptr)
            *times = {resources.stampMs(0, 1), resources.stampMs(1, 2), 1e3 * (submitted - start),
                      dispatches};
    });
    picture->m_channels = command.channels;
    picture->m_colors = command.colors;
    return picture;
}

} // namespace pellucid::gpu
