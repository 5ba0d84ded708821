#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/tone.glsl"

uniform sampler2D projection;
uniform vec2 range;
uniform bool inverted;

in vec2 position;
out vec4 color;

void main() {
    float grey = tone(texture(projection, position).r, range.x, range.y, inverted);
    color = vec4(vec3(grey), 1.0);
}
