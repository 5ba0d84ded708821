// SPDX-License-Identifier: GPL-3.0-or-later
// Multi-scale contrast, see core/picture/contrast.h. The passes draw grids whose row 0 is the top.

// The body's share of a pixel. `air`: its level, and the scale of what is above.
float bodyShare(float value, vec2 air) {
    return clamp((value - air.x) * air.y, 0.0, 1.0);
}

// The processed amplitude of a band. `scale`: one over the brightness of the knee.
float bandCurve(float band, float scale, float amplification, float bend) {
    float x = band * scale;
    return amplification * band * pow(x * x + 1.0, -bend);
}

// Weights 1, 3, 3, 1 over 8, of the four neighbors of a pixel twice as large.
const float binomial[4] = float[4](0.125, 0.375, 0.375, 0.125);

// The coarser grid, interpolated at a pixel of this one.
vec2 expanded(sampler2D coarser, vec2 pixel) {
    return texture(coarser, 0.5 * pixel / vec2(textureSize(coarser, 0))).rg;
}
