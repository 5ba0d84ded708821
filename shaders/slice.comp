#version 430 core
// SPDX-License-Identifier: GPL-3.0-or-later
// The slices of all images as [image][column][row], zero outside the disc.
#include "lib/bindings.glsl"
#include "lib/frame.glsl"
#include "lib/complex.glsl"
#include "lib/fixed.glsl"
#include "lib/factors.glsl"
#include "lib/kernel.glsl"
#include "lib/slice.glsl"

layout(local_size_x = 8, local_size_y = 16) in;

layout(std430, binding = SLICE) writeonly buffer Slice {
    vec2 values[];
};

void main() {
    int column = int(gl_GlobalInvocationID.x), n = int(gl_GlobalInvocationID.y);
    int halfColumns = frame.columns / 2, rows = frame.rows;
    if (column >= halfColumns || n >= rows)
        return;
    int row = n < rows / 2 ? n : n - rows;
    vec2 slice[IMAGES];
    if (abs(row) <= discRows[column])
        sliceAt(column, row, slice);
    else
        for (int c = 0; c < IMAGES; ++c)
            slice[c] = vec2(0.0);
    for (int c = 0; c < IMAGES; ++c)
        values[(c * halfColumns + column) * rows + n] = slice[c];
}
