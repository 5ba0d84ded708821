// SPDX-License-Identifier: GPL-3.0-or-later
// The images that a picture is mixed from; one may have three channels.
uniform sampler2DArray projection;
uniform int layers;
uniform vec3 colors[3];
