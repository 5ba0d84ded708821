#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/contrast.glsl"

uniform sampler2D finest;  // brightness
uniform sampler2D coarser; // means and the processed picture
uniform bool hasCoarser;
uniform vec3 curve; // scale, amplification, bend
uniform vec2 air;
uniform vec2 compression; // as in contrast_coarsest

out float correction;

void main() {
    float value = texelFetch(finest, ivec2(gl_FragCoord.xy), 0).r;
    float processed = compression.x + compression.y * (value - compression.x);
    if (hasCoarser) {
        vec2 above = expanded(coarser, gl_FragCoord.xy);
        float band = bodyShare(value, air) * (value - above.r);
        processed = above.g + bandCurve(band, curve.x, curve.y, curve.z);
    }
    correction = processed - value;
}
