#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/tone.glsl"

uniform sampler2D projection;
uniform vec2 range;
uniform bool inverted;

in vec2 position;
out vec4 color;

void main() {
    color = vec4(tone(texture(projection, position).rgb, range.x, range.y, inverted), 1.0);
}
