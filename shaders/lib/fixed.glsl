// SPDX-License-Identifier: GPL-3.0-or-later
// Four 64-bit numbers in two's complement: products with small integers are exact, and turns of a
// phase wrap modulo one.
const float perWhole = 2.3283064365386963e-10; // 2^-32

struct Fixed {
    uvec4 low, high;
};

Fixed plus(Fixed a, Fixed b) {
    uvec4 carry;
    uvec4 low = uaddCarry(a.low, b.low, carry);
    return Fixed(low, a.high + b.high + carry);
}

Fixed times(Fixed a, uint n) {
    uvec4 low, high;
    umulExtended(a.low, uvec4(n), high, low);
    return Fixed(low, a.high * n + high);
}

// The integer parts of 24.40 bits.
ivec3 wholeOf(Fixed a) {
    return ivec3(a.high.xyz) >> 8;
}

vec3 partOf(Fixed a) {
    return vec3((a.high.xyz << 24) | (a.low.xyz >> 8)) * perWhole;
}

// 0.64 bits as -1/2 to 1/2.
float turnsOf(Fixed a) {
    return float(int(a.high.w)) * perWhole;
}
