#version 430 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Stores the pixels of rows that do not fit shared memory: [image][row][pair of pixels] to the
// picture.
#include "lib/bindings.glsl"
#include "lib/frame.glsl"

layout(local_size_x = THREADS) in;

layout(std430, binding = SLICE) readonly buffer From {
    vec2 from[];
};
layout(r32f, binding = PICTURE) writeonly uniform image2DArray picture;

void main() {
    int x = int(gl_GlobalInvocationID.x), y = int(gl_WorkGroupID.y), image = int(gl_WorkGroupID.z);
    if (x >= frame.pictureColumns)
        return;
    int n = x % frame.columns, row = y % frame.rows;
    vec2 two = from[(image * frame.periodRows + row) * (frame.columns / 2) + n / 2];
    imageStore(picture, ivec3(x, y, image), vec4(n % 2 == 0 ? two.x : two.y));
}
