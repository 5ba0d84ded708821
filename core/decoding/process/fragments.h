// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

class DcmDataset;

namespace pellucid::decoding::process {

using Bytes = std::span<const std::byte>;

/// The compressed pixels of a data set by frame. A frame is one fragment, or several if the offset
/// table or the start of a frame shows where it begins. An element of defined length is one
/// fragment.
class CompressedFrames {
public:
    /// *Throws* Error{unusable} if there are no frames, or not as many as declared. *Requires*: the
    /// data set outlives this object. `startsFrame`: whether a fragment starts a frame.
    CompressedFrames(DcmDataset &dataset, std::size_t frames,
                     const std::function<bool(Bytes)> &startsFrame);

    std::size_t count() const { return m_starts.size() - 1; }
    /// The frame's data, joined if it has several fragments.
    std::vector<std::byte> frame(std::size_t n) const;

private:
    std::vector<Bytes> m_fragments;
    std::vector<std::size_t> m_starts; ///< first fragment of each frame, and the end
};

/// Whether a fragment starts a JPEG, JPEG-LS, JPEG 2000 or JPEG XL codestream or file.
bool beginsCodestream(Bytes fragment);

} // namespace pellucid::decoding::process
