// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "core/decoding/client/decoder.h"

namespace pellucid::dicom {

/// Files that were decoded before their volume is known, held in memory. Thread-safe.
class DecodedFiles {
public:
    /// Copies a decoded file, unless memory is short: then it is decoded again when it is needed.
    void keep(const std::filesystem::path &path, const decoding::DecodedFile &file);
    /// As `Decoder::header` reads it; none if the file is not kept.
    std::optional<decoding::InstanceHeader> header(const std::filesystem::path &path) const;
    /// Its samples are valid until `clear`.
    std::optional<decoding::DecodedFile> find(const std::filesystem::path &path) const;
    void clear();

private:
    struct Kept {
        decoding::InstanceHeader header;
        std::vector<std::uint16_t> samples;
    };
    mutable std::mutex m_mutex;
    std::map<std::filesystem::path, Kept> m_files;
};

} // namespace pellucid::dicom
