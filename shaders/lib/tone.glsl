// SPDX-License-Identifier: GPL-3.0-or-later
// The display curve of core/picture/compose.h: window, x^(1/1.4), film inversion. The curve applies
// to the brightest channel, and the others keep their ratio to it; a grey pixel has three equal
// channels.
vec3 tone(vec3 value, float low, float high, bool inverted) {
    float most = max(value.r, max(value.g, value.b));
    float x = pow(clamp((most - low) / (high - low), 0.0, 1.0), 1.0 / 1.4);
    float lift = min(0.0, low); // lifts empty pixels to grey, which has no hue
    float largest = max(most, 0.0);
    vec3 shown = largest > lift ? x * (max(value, vec3(0.0)) - lift) / (largest - lift) : vec3(x);
    return inverted ? vec3(1.0) - shown : shown;
}
