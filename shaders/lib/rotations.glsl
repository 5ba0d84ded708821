// SPDX-License-Identifier: GPL-3.0-or-later
// exp(+i 2 pi n / length), a table for each length; Frame holds the tables' offsets.
layout(std430, binding = ROTATIONS) readonly buffer Rotations {
    vec2 rotations[];
};

// Prepares a half-length transform (h points) that yields x[2n] + i x[2n+1] of the real line x with
// the half spectrum X: (X_k + conj X_(h-k)) + i exp(+i 2 pi k / 2h) (X_k - conj X_(h-k)).
vec2 unpackReal(vec2 x, vec2 mirrored, vec2 rotation) {
    vec2 other = conjugate(mirrored);
    return x + other + multiplied(quarterTurned(rotation), x - other);
}
