#version 430 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms a column of the slice and stores the picture's rows: [image][row][column]. With FUSED
// a work group computes the column of the slice itself, which saves a pass and a round trip through
// memory; otherwise it reads [image][column][row].
#include "lib/bindings.glsl"
#include "lib/frame.glsl"
#include "lib/complex.glsl"
#include "lib/rotations.glsl"
#include "lib/butterflies.glsl"
#include "lib/transform.glsl"
#if FUSED
#include "lib/fixed.glsl"
#include "lib/factors.glsl"
#include "lib/kernel.glsl"
#include "lib/slice.glsl"
#else
layout(std430, binding = SLICE) readonly buffer Slice {
    vec2 values[];
};
#endif

layout(local_size_x = THREADS) in;

layout(std430, binding = LINES) writeonly buffer Lines {
    vec2 lines[];
};

void main() {
    int column = int(gl_WorkGroupID.x), image = int(gl_WorkGroupID.y);
    int thread = int(gl_LocalInvocationIndex);
    int halfColumns = frame.columns / 2, rows = frame.rows;
#if FUSED
    int last = discRows[column];
    for (int n = last + 1 + thread; n < rows - last; n += THREADS)
        line[n] = vec2(0.0);
    for (int n = thread; n <= 2 * last; n += THREADS) {
        int row = n - last;
        vec2 slice[IMAGES];
        sliceAt(column, row, slice);
        line[row < 0 ? row + rows : row] = slice[0];
    }
#else
    for (int n = thread; n < rows; n += THREADS)
        line[n] = values[(image * halfColumns + column) * rows + n];
#endif
    int result = transformLine(rows, 0, frame.columnRotations);
    for (int n = thread; n < frame.periodRows; n += THREADS)
        lines[(image * frame.periodRows + n) * halfColumns + column] = line[result + n];
}
