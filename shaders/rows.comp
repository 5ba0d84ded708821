#version 430 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms a row of the half spectrum to real pixels and stores those of the picture. A picture
// larger than the period repeats the empty part of the period.
#include "lib/bindings.glsl"
#include "lib/frame.glsl"
#include "lib/complex.glsl"
#include "lib/rotations.glsl"
#include "lib/butterflies.glsl"
#include "lib/transform.glsl"

layout(local_size_x = THREADS) in;

layout(std430, binding = LINES) readonly buffer Lines {
    vec2 lines[];
};
layout(r32f, binding = PICTURE) writeonly uniform image2DArray picture;
uniform ivec3 strides; // of the lines: image, row, column

vec2 lineAt(int image, int row, int column) {
    vec2 value = lines[image * strides.x + row * strides.y + column * strides.z];
    // The mean is real; its imaginary part is rounding.
    return column == 0 ? vec2(value.x, 0.0) : value;
}

void main() {
    int row = int(gl_WorkGroupID.x), image = int(gl_WorkGroupID.y);
    int thread = int(gl_LocalInvocationIndex);
    int columns = frame.columns, halfColumns = columns / 2;
    for (int k = thread; k < halfColumns; k += THREADS) {
        // The Nyquist column is outside the disc.
        vec2 mirrored = k == 0 ? vec2(0.0) : lineAt(image, row, halfColumns - k);
        line[k] = unpackReal(lineAt(image, row, k), mirrored, rotations[frame.unpackRotations + k]);
    }
    int result = transformLine(halfColumns, 1, frame.rowRotations);
    for (int x = thread; x < frame.pictureColumns; x += THREADS) {
        int n = x % columns;
        vec2 two = line[result + n / 2];
        float pixel = n % 2 == 0 ? two.x : two.y;
        for (int y = row; y < frame.pictureRows; y += frame.rows)
            imageStore(picture, ivec3(x, y, image), vec4(pixel));
    }
}
