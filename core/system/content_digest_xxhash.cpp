// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/content_digest.h"

#include <fmt/format.h>
#include <xxhash.h>

namespace pellucid::system {

std::string contentDigest(std::span<const std::byte> bytes) {
    const XXH128_hash_t digest = XXH3_128bits(bytes.data(), bytes.size());
    return fmt::format("{:016x}{:016x}", digest.high64, digest.low64);
}

} // namespace pellucid::system
