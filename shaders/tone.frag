#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/tone.glsl"

uniform sampler2DArray projection;
uniform int layers; // the images that the picture is mixed from; one may have three channels
uniform vec3 colors[3];
uniform vec2 range;
uniform bool inverted;

in vec2 position;
out vec4 shown;

void main() {
    vec3 value = vec3(0.0);
    for (int layer = 0; layer < layers; ++layer)
        value += colors[layer] * texture(projection, vec3(position, float(layer))).rgb;
    shown = vec4(tone(value, range.x, range.y, inverted), 1.0);
}
