#version 430 core
// SPDX-License-Identifier: GPL-3.0-or-later
// The spatial renderer that pellucid-bench compares with: parallel rays through the pixel centres,
// one trilinear sample a step, and only their sum.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler3D field; // zero beyond its border
layout(r32f, binding = 0) writeonly uniform image2DArray picture;
// Texture coordinates: the first pixel, and the steps to the next pixel and sample.
uniform vec3 corner, perColumn, perRow, perStep;
uniform ivec2 size;
uniform float stepLength;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size)))
        return;
    vec3 origin = corner + float(pixel.x) * perColumn + float(pixel.y) * perRow;
    // The filter reaches zero half a voxel beyond the samples.
    vec3 margin = 0.5 / vec3(textureSize(field, 0));
    vec3 slope = mix(perStep, vec3(1e-20), lessThan(abs(perStep), vec3(1e-20)));
    vec3 a = (-margin - origin) / slope, b = (1.0 + margin - origin) / slope;
    // No ray has more steps than this, in or out of the volume.
    vec3 near = clamp(min(a, b), -1e6, 1e6), far = clamp(max(a, b), -1e6, 1e6);
    int first = int(ceil(max(near.x, max(near.y, near.z))));
    int last = int(floor(min(far.x, min(far.y, far.z))));
    float sum = 0.0;
    for (int n = first; n <= last; ++n)
        sum += textureLod(field, origin + float(n) * perStep, 0.0).r;
    imageStore(picture, ivec3(pixel, 0), vec4(stepLength * sum));
}
