// SPDX-License-Identifier: GPL-3.0-or-later
// The display curve of core/picture/compose.h: window, x^(1/1.4), film inversion. The brightest
// channel takes the curve, the others keep their ratio to it; a grey pixel has all three alike.
vec3 tone(vec3 value, float low, float high, bool inverted) {
    float most = max(value.r, max(value.g, value.b));
    float x = pow(clamp((most - low) / (high - low), 0.0, 1.0), 1.0 / 1.4);
    float lift = min(0.0, low); // what is empty is lifted to grey, which has no hue
    float largest = max(most, 0.0);
    vec3 shown = largest > lift ? x * (max(value, vec3(0.0)) - lift) / (largest - lift) : vec3(x);
    return inverted ? vec3(1.0) - shown : shown;
}
