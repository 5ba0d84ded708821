// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/entry_files.h"

#include <map>

#include "core/dicom/copies.h"

namespace pellucid::dicom {

std::vector<EntryFile> filesOf(const VolumeEntry &entry) {
    std::vector<EntryFile> files;
    std::map<std::filesystem::path, std::size_t> known;
    for (std::size_t n = 0; n < entry.frames.size(); ++n) {
        const std::filesystem::path &path = entry.frames[n].path;
        const auto [it, isNew] = known.try_emplace(path, files.size());
        if (isNew)
            files.push_back({path, {}});
        files[it->second].frames.push_back(n);
    }
    return files;
}

bool stillContains(const FrameReference &expected, const decoding::InstanceHeader &found) {
    return expected.frame < int(found.frames.size()) &&
           expected.digest == digestOf(found.sopInstanceUid, found.frameOfReferenceUid,
                                       found.modality, found.frames[std::size_t(expected.frame)]);
}

} // namespace pellucid::dicom
