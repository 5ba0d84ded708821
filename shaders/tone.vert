#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
// One triangle that covers the viewport; no vertex data. Row 0 of the image is its top row.
out vec2 position;

void main() {
    vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
    position = vec2(corner.x, 1.0 - corner.y);
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
