// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/pkce.h"

#include <algorithm>
#include <array>
#include <span>
#include <system_error>
#include <vector>

#include <openssl/evp.h>
#include <openssl/sha.h>

#include "core/platform/process.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

// RFC 4648, 5, without padding.
std::string base64Url(const unsigned char *bytes, std::size_t count) {
    std::string text((count + 2) / 3 * 4 + 1, '\0'); // and a terminating zero
    text.resize(std::size_t(
        ::EVP_EncodeBlock(reinterpret_cast<unsigned char *>(text.data()), bytes, int(count))));
    std::replace(text.begin(), text.end(), '+', '-');
    std::replace(text.begin(), text.end(), '/', '_');
    std::erase(text, '=');
    return text;
}

} // namespace

std::string randomText(std::size_t bytes) {
    std::vector<unsigned char> random(bytes);
    try {
        platform::fillRandomly(std::as_writable_bytes(std::span(random)));
    } catch (const std::system_error &error) {
        throw task::Error(task::ErrorCode::internal, task::systemReason(error.code()));
    }
    return base64Url(random.data(), random.size());
}

std::string codeChallenge(const std::string &verifier) {
    std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
    ::SHA256(reinterpret_cast<const unsigned char *>(verifier.data()), verifier.size(),
             digest.data());
    return base64Url(digest.data(), digest.size());
}

} // namespace pellucid::archive
