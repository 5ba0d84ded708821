#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/contrast.glsl"

uniform sampler2D level;   // weighted values and shares
uniform sampler2D coarser; // means and the processed picture
uniform vec3 curve;        // scale, amplification, bend

out vec2 meanAndProcessed;

void main() {
    vec2 sums = texelFetch(level, ivec2(gl_FragCoord.xy), 0).rg;
    vec2 above = expanded(coarser, gl_FragCoord.xy);
    float mean = sums.r + (1.0 - min(sums.g, 1.0)) * above.r;
    meanAndProcessed =
        vec2(mean, above.g + bandCurve(mean - above.r, curve.x, curve.y, curve.z));
}
