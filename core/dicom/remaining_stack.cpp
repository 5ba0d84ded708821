// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/remaining_stack.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/reasons.h"
#include "core/dicom/group_series.h"
#include "core/dicom/reasons.h"
#include "core/dicom/value_warnings.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

class RemainingFiles {
public:
    RemainingFiles(const VolumeEntry &entry, const std::vector<EntryFile> &files,
                   const std::vector<std::optional<task::Reason>> &failures,
                   const task::Progress &progress)
        : m_entry(entry) {
        for (std::size_t n = 0; n < files.size(); ++n)
            if (failures[n])
                m_skipped.push_back({files[n].path, *failures[n]});
            else
                keep(files[n], progress);
    }

    bool empty() const { return m_files.empty(); }
    const std::vector<Skipped> &skipped() const { return m_skipped; }

    VolumeEntry regrouped() const {
        std::vector<Skipped> ignored;
        const std::vector<VolumeEntry> volumes =
            groupSeries(m_files, ignored, {}, Slices::remaining);
        const VolumeEntry &found = largest(volumes);
        if (volumes.size() != 1 && (!found.placed || found.geometry.lattice.size().k < 2))
            throw Error(ErrorCode::unusable, because::othersMakeNoVolume(m_skipped.front().reason),
                        m_skipped.front().path);
        VolumeEntry rest = m_entry;
        rest.frames = found.frames;
        for (FrameReference &frame : rest.frames)
            frame = m_original.at(frame.path).at(std::size_t(frame.frame));
        rest.geometry = found.geometry;
        rest.placed = found.placed;
        rest.notes.placed = rest.placed;
        rest.notes.filled = found.notes.filled;
        updateWarnings(found, rest);
        return rest;
    }

private:
    void keep(const EntryFile &meant, const task::Progress &progress) {
        SeriesFile file{meant.path, decoding::Decoder::shared().header(meant.path, progress)};
        if (!std::all_of(meant.frames.begin(), meant.frames.end(), [&](std::size_t frame) {
                return stillContains(m_entry.frames[frame], file.header);
            })) {
            m_skipped.push_back({meant.path, because::changedWhileRead});
            return;
        }
        std::vector<FrameHeader> kept;
        for (const std::size_t n : meant.frames) {
            const FrameReference &frame = m_entry.frames[n];
            kept.push_back(file.header.frames[std::size_t(frame.frame)]);
            m_original[meant.path].push_back(frame);
        }
        file.header.frames = std::move(kept);
        // All slices together were one volume, so the rest must not be split by this attribute.
        file.header.frameOfReferenceUid.clear();
        m_files.push_back(std::move(file));
    }

    // Several adjacent missing slices leave runs, or the whole with holes, if that was requested.
    const VolumeEntry &largest(const std::vector<VolumeEntry> &volumes) const {
        const auto rank = [&](const VolumeEntry &e) {
            return std::tuple(e.placed, e.fillsHoles == m_entry.fillsHoles, e.frames.size());
        };
        return *std::max_element(
            volumes.begin(), volumes.end(),
            [&](const VolumeEntry &a, const VolumeEntry &b) { return rank(a) < rank(b); });
    }

    // Warnings about the complete stack no longer apply.
    void updateWarnings(const VolumeEntry &found, VolumeEntry &rest) const {
        std::vector<task::Reason> &warnings = rest.notes.warnings;
        std::erase_if(warnings,
                      [](const task::Reason &w) { return isStackWarning(w) || isValueWarning(w); });
        std::vector<const InstanceHeader *> headers;
        for (const SeriesFile &file : m_files)
            headers.push_back(&file.header);
        for (const task::Reason &warning : warningsOfValues(headers))
            warnings.push_back(warning);
        for (const Skipped &s : m_skipped)
            warnings.push_back(because::without(s.path.filename().string(), s.reason));
        for (const task::Reason &warning : found.notes.warnings)
            if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
                warnings.push_back(warning);
        if (!rest.placed)
            warnings.push_back(because::imagesOnly(*found.notPlacedReason));
    }

    const VolumeEntry &m_entry;
    std::vector<SeriesFile> m_files;
    std::vector<Skipped> m_skipped;
    /// Grouping sees only the frames of this volume, renumbered; this maps them back.
    std::map<std::filesystem::path, std::vector<FrameReference>> m_original;
};

} // namespace

RemainingStack remainingStack(const VolumeEntry &entry, const std::vector<EntryFile> &files,
                              const std::vector<std::optional<task::Reason>> &failures,
                              ErrorCode noneLeft, const task::Progress &progress) {
    const RemainingFiles remaining(entry, files, failures, progress);
    if (remaining.empty())
        throw Error(noneLeft, remaining.skipped().front().reason, remaining.skipped().front().path);
    return {remaining.regrouped(), remaining.skipped()};
}

} // namespace pellucid::dicom
