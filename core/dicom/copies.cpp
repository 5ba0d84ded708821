// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/copies.h"

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/dicom/reasons.h"

namespace pellucid::dicom {

namespace because = task::because;

std::size_t digestOf(const std::string &sopInstanceUid, const std::string &frameOfReferenceUid,
                     const std::string &modality, const FrameHeader &frame) {
    std::string all = sopInstanceUid + '\n' + frameOfReferenceUid + '\n' + modality;
    const auto add = [&](const auto &values) {
        all += values ? '+' : '-';
        if (values)
            all.append(reinterpret_cast<const char *>(&*values), sizeof(*values));
    };
    add(frame.positionMm);
    add(frame.rowAxis);
    add(frame.columnAxis);
    add(frame.spacingMm);
    return std::hash<std::string>()(all);
}

std::size_t digestOf(const PlacedFrame &frame) {
    return digestOf(frame.sopInstanceUid, frame.frameOfReferenceUid, frame.modality, frame.header);
}

void dropCopies(std::vector<PlacedFrame> &frames, std::vector<Skipped> &skipped) {
    using Instance = std::pair<std::string, int>;
    using Image = std::tuple<int, int, int, int, std::size_t>;
    std::map<Instance, std::map<Image, std::filesystem::path>> seen;
    std::set<std::filesystem::path> reported;
    std::erase_if(frames, [&](const PlacedFrame &frame) {
        if (frame.sopInstanceUid.empty())
            return false;
        const Image image(frame.framesOfFile, frame.rows, frame.columns, frame.instanceNumber,
                          digestOf(frame));
        const auto [it, isNew] = seen[{frame.sopInstanceUid, frame.reference.frame}].try_emplace(
            image, frame.reference.path);
        if (isNew)
            return false;
        if (reported.insert(frame.reference.path).second)
            skipped.push_back(
                {frame.reference.path, because::hasInstanceUidOf(it->second.filename().string())});
        return true;
    });
    for (PlacedFrame &frame : frames)
        if (!frame.sopInstanceUid.empty())
            frame.sharesUid = seen[{frame.sopInstanceUid, frame.reference.frame}].size() > 1;
}

} // namespace pellucid::dicom
