// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

namespace pellucid::fourier {

/// IEEE 754 binary16 to float, exact, subnormals included; for finite values.
inline float fromBinary16(std::uint16_t half) {
    // The exponent's bias differs by 112; multiplying rather than adding handles subnormals too.
    const float magnitude = std::bit_cast<float>(std::uint32_t(half & 0x7fffU) << 13) * 0x1p112F;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(magnitude) |
                                std::uint32_t(half & 0x8000U) << 16);
}

/// Float to binary16, to nearest even, subnormals included; for |value| <= 65504.
inline std::uint16_t toBinary16(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000U, magnitude = bits & 0x7fffffffU;
    if (magnitude < 0x38800000U) {
        // Below 2^-14: adding 2^-1 * 2^0 aligns the result's last bit, 2^-24, with the sum's.
        const float shifted = std::bit_cast<float>(magnitude) + 0.5F;
        return std::uint16_t(sign | (std::bit_cast<std::uint32_t>(shifted) - 0x3f000000U));
    }
    const std::uint32_t rounded = magnitude + 0xfffU + (magnitude >> 13 & 1U);
    return std::uint16_t(sign | (rounded - 0x38000000U) >> 13);
}

} // namespace pellucid::fourier
