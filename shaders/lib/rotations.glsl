// SPDX-License-Identifier: GPL-3.0-or-later
// exp(+i 2 pi n / length), n = 0 .. length - 1: a table for each length; where each begins is a
// member of Frame.
layout(std430, binding = ROTATIONS) readonly buffer Rotations {
    vec2 rotations[];
};

// The half-length transform of the result is x[2n] + i x[2n+1] of a real line whose half spectrum
// is X: (X_k + conj X_(h-k)) + i exp(+i 2 pi k / 2h) (X_k - conj X_(h-k)).
vec2 unpackReal(vec2 x, vec2 mirrored, vec2 rotation) {
    vec2 other = conjugate(mirrored);
    return x + other + multiplied(quarterTurned(rotation), x - other);
}
