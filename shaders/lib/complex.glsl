// SPDX-License-Identifier: GPL-3.0-or-later
vec2 multiplied(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

vec2 conjugate(vec2 a) {
    return vec2(a.x, -a.y);
}

// i a
vec2 quarterTurned(vec2 a) {
    return vec2(-a.y, a.x);
}
