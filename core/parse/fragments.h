// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

class DcmDataset;

namespace pellucid::parse {

using Bytes = std::span<const std::byte>;

/// The compressed pixels of a data set, frame by frame: one fragment a frame, or several of which
/// the offset table or how a frame begins tells the first. One of another length than undefined is
/// one fragment.
class CompressedFrames {
public:
    /// *Throws* Error{unusable} if there are none, or other than announced. The data set must
    /// outlive this. `begins`: whether a fragment begins a frame.
    CompressedFrames(DcmDataset &dataset, std::size_t frames,
                     const std::function<bool(Bytes)> &begins);

    std::size_t count() const { return m_starts.size() - 1; }
    /// Joined where it is of several fragments.
    std::vector<std::byte> frame(std::size_t n) const;

private:
    std::vector<Bytes> m_fragments;
    std::vector<std::size_t> m_starts; ///< of each frame, and the end
};

/// Whether a fragment begins a codestream of JPEG, JPEG-LS, JPEG 2000 or JPEG XL, or a file of it.
bool beginsCodestream(Bytes fragment);

} // namespace pellucid::parse
