#version 430 core
// SPDX-License-Identifier: GPL-3.0-or-later
// The first step of rows.comp for rows that do not fit shared memory: unpacks half spectra to
// [image][row][number].
#include "lib/bindings.glsl"
#include "lib/frame.glsl"
#include "lib/complex.glsl"
#include "lib/rotations.glsl"

layout(local_size_x = THREADS) in;

layout(std430, binding = SLICE) readonly buffer From {
    vec2 from[];
};
layout(std430, binding = LINES) writeonly buffer To {
    vec2 to[];
};
uniform ivec3 strides; // of the input: image, row, column

vec2 lineAt(int image, int row, int column) {
    vec2 value = from[image * strides.x + row * strides.y + column * strides.z];
    return column == 0 ? vec2(value.x, 0.0) : value;
}

void main() {
    int halfColumns = frame.columns / 2;
    int k = int(gl_GlobalInvocationID.x), row = int(gl_WorkGroupID.y);
    int image = int(gl_WorkGroupID.z);
    if (k >= halfColumns)
        return;
    vec2 mirrored = k == 0 ? vec2(0.0) : lineAt(image, row, halfColumns - k);
    to[(image * frame.periodRows + row) * halfColumns + k] =
        unpackReal(lineAt(image, row, k), mirrored, rotations[frame.unpackRotations + k]);
}
