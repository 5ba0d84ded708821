// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/frame_block.h"
#include "gpu/texture.h"

namespace pellucid::gpu {

/// The unnormalised complex-to-real inverse 2D transform, exp(+i 2 pi ...), as compute passes: one
/// for all columns and one for all rows if a line fits the shared memory of a work group, else a
/// pass for each stage. *Requires*: used on the device's thread with the frame's block and tables
/// bound.
class TransformPasses {
public:
    explicit TransformPasses(Device &device);

    /// Allocates buffers for the half spectra of `images` images. *Throws* Error{outOfMemory}.
    void fit(const plan::SliceGrid &grid, int images);
    /// Half spectra as [image][column][row], columns/2 columns: the Nyquist column is zero.
    const Buffer &slice() const { return m_slice; }
    /// The transformed columns.
    const Buffer &lines() const { return m_lines; }
    /// The longest line that a work group transforms in its shared memory.
    int longestShared() const { return m_longest; }
    /// The value of the macro ROOM for lines of a length.
    static int roomFor(int length);

    /// Where the transformed columns are.
    struct Lines {
        const Buffer *buffer;
        int image, row, column; ///< strides
    };
    /// The layout in which a work group stores a column that it transformed in shared memory.
    Lines sharedLines(const FrameBlock &block) const;
    /// Transforms the columns of the slice.
    Lines transformColumns(const FrameBlock &block, int images);
    /// Transforms the rows and stores the picture's pixels.
    void transformRows(const FrameBlock &block, int images, const Lines &lines,
                       const PixelTexture &picture);
    /// Returns the number of dispatches since the last call.
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

/// Dispatches work groups; later dispatches see their writes to storage buffers.
void dispatchGroups(int x, int y, int z);

} // namespace pellucid::gpu
