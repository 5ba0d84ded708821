// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/frame_block.h"
#include "gpu/texture.h"

namespace pellucid::gpu {

/// The complex-to-real inverse 2D transform, exp(+i 2 pi ...), unnormalised, as compute passes: one
/// for all columns and one for all rows while lines fit the shared memory of a work group, a pass
/// for each stage beyond. Used on the device's thread, where the frame's block and tables are
/// bound.
class TransformPasses {
public:
    explicit TransformPasses(Device &device);

    /// Makes room for the half spectra of images. *Throws* Error{outOfMemory}.
    void fit(const plan::SliceGrid &grid, int images);
    /// Half spectra as [image][column][row]: columns/2 of them, the Nyquist column is zero.
    const Buffer &slice() const { return m_slice; }
    /// Of transformed columns.
    const Buffer &lines() const { return m_lines; }
    /// The longest line that a work group transforms in its shared memory.
    int longestShared() const { return m_longest; }
    /// The macro ROOM for lines of a length.
    static int roomFor(int length);

    /// Where lines lie after the transform along rows' direction.
    struct Lines {
        const Buffer *buffer;
        int image, row, column; ///< strides
    };
    /// As a work group that has transformed its column in shared memory stores them.
    Lines sharedLines(const FrameBlock &block) const;
    /// Transforms the columns of the slice.
    Lines transformColumns(const FrameBlock &block, int images);
    /// Transforms the rows and stores the picture's pixels.
    void transformRows(const FrameBlock &block, int images, const Lines &lines,
                       const PixelTexture &picture);
    /// Dispatches since the last call.
    int takeDispatches();

private:
    const Buffer &other(const Buffer &buffer) const {
        return &buffer == &m_slice ? m_lines : m_slice;
    }
    const Buffer *runStages(const Buffer *from, int length, int lines, int images, int table);
    void dispatch(int x, int y, int z);

    Device &m_device;
    Buffer m_slice, m_lines;
    int m_longest, m_dispatches = 0;
};

/// Runs a compute program's work groups; what they write is seen by those after them.
void dispatchGroups(int x, int y, int z);

} // namespace pellucid::gpu
