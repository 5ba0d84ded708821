#version 430 core
// SPDX-License-Identifier: GPL-3.0-or-later
// One stage of the transforms of lines that do not fit shared memory: [line][number].
#include "lib/bindings.glsl"
#include "lib/complex.glsl"
#include "lib/rotations.glsl"
#include "lib/butterflies.glsl"

layout(local_size_x = THREADS) in;

layout(std430, binding = SLICE) readonly buffer From {
    vec2 from[];
};
layout(std430, binding = LINES) writeonly buffer To {
    vec2 to[];
};
uniform int lineLength, radix;
uniform int done;  // product of the radices of earlier stages
uniform int table; // offset of the rotations of the length

void main() {
    int count = lineLength / radix, n = int(gl_GlobalInvocationID.x);
    if (n >= count)
        return;
    int begin = int(gl_WorkGroupID.z * gl_NumWorkGroups.y + gl_WorkGroupID.y) * lineLength;
    int k = n % done;
    int turn = lineLength / (done * radix);
    vec2 v[8];
    v[0] = from[begin + n];
    for (int q = 1; q < 8; ++q)
        if (q < radix)
            v[q] = multiplied(from[begin + n + q * count], rotations[table + q * k * turn]);
    inverseFew(radix, v);
    int first = begin + (n - k) * radix + k;
    for (int q = 0; q < 8; ++q)
        if (q < radix)
            to[first + q * done] = v[q];
}
