#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/mixture.glsl"

uniform int factor; // pixels of the picture a side

out float brightness;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * factor;
    ivec2 last = textureSize(projection, 0).xy - 1;
    float sum = 0.0;
    for (int row = 0; row < factor; ++row)
        for (int column = 0; column < factor; ++column) {
            ivec2 at = min(first + ivec2(column, row), last);
            vec3 value = vec3(0.0);
            for (int layer = 0; layer < layers; ++layer)
                value += colors[layer] * texelFetch(projection, ivec3(at, layer), 0).rgb;
            sum += max(value.r, max(value.g, value.b));
        }
    brightness = sum / float(factor * factor);
}
