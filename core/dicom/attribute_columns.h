// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/decoding/client/attribute.h"
#include "core/decoding/client/dimensions.h"
#include "core/dicom/stack_geometry.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// An attribute's values in the frames of a stack.
class Column {
public:
    using Label = std::function<task::Reason(const std::string &value)>;
    /// `isKnown`: one of `decoding::dimensions`.
    Column(decoding::ValueKind kind, Label label, std::size_t frames, bool isKnown = false);

    void set(std::size_t frame, const std::string &value);

    /// Equal values have equal identifiers; 0: the frame does not state the attribute.
    std::uint32_t idOf(std::size_t frame) const { return m_ids[frame]; }
    /// Nothing for a value that is no number, or no time. *Units* of times: s.
    std::optional<double> numberOf(std::uint32_t id) const { return m_numbers[id]; }
    bool mayDrift() const;
    bool isKnown() const { return m_isKnown; }
    bool isConstant() const;
    task::Reason labelOf(std::uint32_t id) const { return m_label(m_values[id]); }

private:
    decoding::ValueKind m_kind;
    Label m_label;
    bool m_isKnown;
    std::vector<std::uint32_t> m_ids;
    std::unordered_map<std::string, std::uint32_t> m_known;
    std::vector<std::string> m_values; ///< by id
    std::vector<std::optional<double>> m_numbers;
};

/// Lists all attributes of a file. *Throws* task::Error.
using ReadAttributes = std::function<decoding::AttributeList(const std::filesystem::path &)>;

/// The attributes of `decoding::dimensions` that differ between frames, the most telling first;
/// then the file, of files of several frames.
std::vector<Column> headerColumns(const std::vector<PlacedFrame> &frames);

/// All other attributes that differ between frames and are not a place in space or the number of an
/// image: those of the standard first, then those that describe pixels, UIDs, and private ones. The
/// files are read again. Empty if one cannot be read. *Throws* Cancelled.
std::vector<Column> otherColumns(const std::vector<PlacedFrame> &frames, const ReadAttributes &read,
                                 const task::Progress &progress);

} // namespace pellucid::dicom
