#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/contrast.glsl"

uniform sampler2D finer; // brightness, or weighted values and shares
uniform bool isFinest;
uniform vec2 air;

out vec2 sums;

void main() {
    ivec2 first = 2 * ivec2(gl_FragCoord.xy) - 1;
    ivec2 last = textureSize(finer, 0) - 1;
    sums = vec2(0.0);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
            vec2 value = texelFetch(finer, clamp(first + ivec2(column, row), ivec2(0), last), 0).rg;
            if (isFinest) {
                float share = bodyShare(value.r, air);
                value = vec2(value.r * share, share);
            }
            sums += binomial[row] * binomial[column] * value;
        }
}
