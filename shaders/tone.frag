#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/mixture.glsl"
#include "lib/tone.glsl"

uniform sampler2D correction; // of contrast
uniform bool isCorrected;
uniform vec2 correctionScale; // from the picture to the texture, which may be a little larger
uniform vec2 range;
uniform float exponent;
uniform vec2 air;
uniform bool inverted;

in vec2 position;
out vec4 shown;

void main() {
    vec3 value = vec3(0.0);
    for (int layer = 0; layer < layers; ++layer)
        value += colors[layer] * texture(projection, vec3(position, float(layer))).rgb;
    float added = isCorrected ? texture(correction, position * correctionScale).r : 0.0;
    shown = vec4(tone(value, added, range, exponent, air, inverted), 1.0);
}
