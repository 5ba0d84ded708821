// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/decoded_files.h"

#include <utility>

#include "core/system/memory.h"

namespace pellucid::dicom {

namespace {

// The volume and its projection are still to come: each takes as much as the files, or more.
constexpr std::size_t leastFreeBytes = std::size_t(1) << 30;

} // namespace

void DecodedFiles::keep(const std::filesystem::path &path, const decoding::DecodedFile &file) {
    if (system::availableMemoryBytes() < leastFreeBytes + 4 * file.samples.size_bytes())
        return;
    Kept kept{file.header, {}};
    // Read each sample once: the decoder may still change it.
    kept.samples.resize(file.samples.size());
    const volatile std::uint16_t *in = file.samples.data();
    for (std::size_t n = 0; n < kept.samples.size(); ++n)
        kept.samples[n] = in[n];
    const std::lock_guard lock(m_mutex);
    m_files.insert_or_assign(path, std::move(kept));
}

std::optional<decoding::InstanceHeader>
DecodedFiles::header(const std::filesystem::path &path) const {
    const std::lock_guard lock(m_mutex);
    const auto at = m_files.find(path);
    if (at == m_files.end())
        return std::nullopt;
    decoding::InstanceHeader header = at->second.header;
    // Known only after decoding; loading adds them.
    header.hasDamagedPixels = false;
    header.oddities &= ~std::uint32_t(decoding::otherPrecision);
    return header;
}

std::optional<decoding::DecodedFile> DecodedFiles::find(const std::filesystem::path &path) const {
    const std::lock_guard lock(m_mutex);
    const auto at = m_files.find(path);
    if (at == m_files.end())
        return std::nullopt;
    return decoding::DecodedFile{at->second.header, at->second.samples, std::nullopt};
}

void DecodedFiles::clear() {
    const std::lock_guard lock(m_mutex);
    m_files.clear();
}

} // namespace pellucid::dicom
