#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
uniform sampler2D level; // weighted values and shares
uniform float middleWeight;
uniform vec2 compression; // the value that stays, and the factor of differences from it

out vec2 meanAndProcessed;

void main() {
    vec2 sums = texelFetch(level, ivec2(gl_FragCoord.xy), 0).rg;
    float mean = (sums.r + middleWeight * compression.x) / (sums.g + middleWeight);
    meanAndProcessed = vec2(mean, compression.x + compression.y * (mean - compression.x));
}
