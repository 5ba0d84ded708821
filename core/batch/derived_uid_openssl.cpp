// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/batch/derived_uid.h"

#include <array>
#include <vector>

#include <openssl/sha.h>

namespace pellucid::batch {

std::string derivedUid(const std::string &of) {
    constexpr std::size_t bytes = 16;
    std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
    SHA256(reinterpret_cast<const unsigned char *>(of.data()), of.size(), digest.data());
    digest[6] = static_cast<unsigned char>(0x80U | (digest[6] & 0x0fU)); // the version
    digest[8] = static_cast<unsigned char>(0x80U | (digest[8] & 0x3fU)); // the variant
    std::vector<int> decimal{0};                                         // the last digit first
    for (std::size_t n = 0; n < bytes; ++n) {
        int carry = digest[n];
        for (int &place : decimal) {
            carry += 256 * place;
            place = carry % 10;
            carry /= 10;
        }
        for (; carry > 0; carry /= 10)
            decimal.push_back(carry % 10);
    }
    std::string uid = "2.25.";
    for (auto place = decimal.rbegin(); place != decimal.rend(); ++place)
        uid += char('0' + *place);
    return uid;
}

} // namespace pellucid::batch
