// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/transform_passes.h"

#include <algorithm>
#include <bit>

#include <epoxy/gl.h>

#include "core/task/error.h"
#include "gpu/reasons.h"

namespace pellucid::gpu {

namespace {

// Longer lines would leave shared memory for only one work group on a core of the card.
constexpr int maxShared = 4096;
constexpr int minRoom = 256;
constexpr std::size_t numberBytes = 2 * sizeof(float);

int groupsOf(int count) {
    return (count + bindings::threads - 1) / bindings::threads;
}

} // namespace

void dispatchGroups(int x, int y, int z) {
    glDispatchCompute(GLuint(x), GLuint(y), GLuint(z));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

TransformPasses::TransformPasses(Device &device)
    : m_device(device),
      m_longest(std::min(maxShared, int(std::bit_floor(unsigned(device.capabilities().sharedBytes /
                                                                (2 * numberBytes)))))) {}

int TransformPasses::roomFor(int length) {
    return std::max(minRoom, int(std::bit_ceil(unsigned(length))));
}

void TransformPasses::fit(const plan::SliceGrid &grid, int images) {
    const std::size_t bytes =
        std::size_t(images) * std::size_t(grid.columns / 2) * std::size_t(grid.rows) * numberBytes;
    if (bytes > m_device.capabilities().storageBytes)
        throw task::Error(
            task::ErrorCode::outOfMemory,
            task::because::sliceExceedsCard(grid.columns, grid.rows, bytes >> 20,
                                            m_device.capabilities().storageBytes >> 20));
    m_slice.fit(bytes);
    m_lines.fit(bytes);
}

void TransformPasses::dispatch(int x, int y, int z) {
    dispatchGroups(x, y, z);
    ++m_dispatches;
}

int TransformPasses::takeDispatches() {
    return std::exchange(m_dispatches, 0);
}

TransformPasses::Lines TransformPasses::sharedLines(const FrameBlock &block) const {
    const int halfColumns = block.columns / 2;
    return {&m_lines, block.periodRows * halfColumns, halfColumns, 1};
}

const Buffer *TransformPasses::runStages(const Buffer *from, int length, int lines, int images,
                                         int table) {
    const Program &program = m_device.program("stage.comp");
    int done = 1;
    for (const int radix : radicesOf(length)) {
        const Buffer *const to = &other(*from);
        glUseProgram(program.id());
        glUniform1i(program.uniform("lineLength"), length);
        glUniform1i(program.uniform("radix"), radix);
        glUniform1i(program.uniform("done"), done);
        glUniform1i(program.uniform("table"), table);
        from->bindStorage(bindings::slice);
        to->bindStorage(bindings::lines);
        dispatch(groupsOf(length / radix), lines, images);
        done *= radix;
        from = to;
    }
    return from;
}

TransformPasses::Lines TransformPasses::transformColumns(const FrameBlock &block, int images) {
    const int halfColumns = block.columns / 2, rows = block.rows;
    if (rows > m_longest) {
        const Buffer *const result =
            runStages(&m_slice, rows, halfColumns, images, block.columnRotations);
        return {result, halfColumns * rows, 1, rows};
    }
    const Program &program =
        m_device.program("columns.comp", {{"FUSED", 0}, {"ROOM", roomFor(rows)}});
    glUseProgram(program.id());
    m_slice.bindStorage(bindings::slice);
    m_lines.bindStorage(bindings::lines);
    dispatch(halfColumns, images, 1);
    return sharedLines(block);
}

void TransformPasses::transformRows(const FrameBlock &block, int images, const Lines &lines,
                                    const PixelTexture &picture) {
    const int halfColumns = block.columns / 2, rows = block.periodRows;
    glBindImageTexture(bindings::picture, picture.id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
    const auto setStrides = [&](const Program &program) {
        glUseProgram(program.id());
        glUniform3i(program.uniform("strides"), lines.image, lines.row, lines.column);
    };
    if (halfColumns <= m_longest) {
        setStrides(m_device.program("rows.comp", {{"ROOM", roomFor(halfColumns)}}));
        lines.buffer->bindStorage(bindings::lines);
        dispatch(rows, images, 1);
    } else {
        setStrides(m_device.program("unpack_real.comp"));
        const Buffer *const to = &other(*lines.buffer);
        lines.buffer->bindStorage(bindings::slice);
        to->bindStorage(bindings::lines);
        dispatch(groupsOf(halfColumns), rows, images);
        const Buffer *const result = runStages(to, halfColumns, rows, images, block.rowRotations);
        glUseProgram(m_device.program("store.comp").id());
        result->bindStorage(bindings::slice);
        dispatch(groupsOf(block.pictureColumns), block.pictureRows, images);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

} // namespace pellucid::gpu
