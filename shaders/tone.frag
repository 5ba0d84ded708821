#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/tone.glsl"

uniform sampler2DArray projection;
uniform int layers; // 1, with one or three channels; or 3, one per channel
uniform vec3 color;
uniform vec2 range;
uniform bool inverted;

in vec2 position;
out vec4 shown;

void main() {
    vec3 value = texture(projection, vec3(position, 0.0)).rgb;
    if (layers == 3)
        value = vec3(value.r, texture(projection, vec3(position, 1.0)).r,
                     texture(projection, vec3(position, 2.0)).r);
    shown = vec4(tone(color * value, range.x, range.y, inverted), 1.0);
}
