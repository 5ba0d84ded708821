// SPDX-License-Identifier: GPL-3.0-or-later
// The display curve of core/picture/compose.h: contrast, range, x^exponent, air to black, film
// inversion. The curve applies to the brightest channel, and the others keep their ratio to it; a
// grey pixel has three equal channels.
vec3 tone(vec3 value, float added, vec2 range, float exponent, vec2 air, bool inverted) {
    float most = max(value.r, max(value.g, value.b));
    float x = clamp((most + added - range.x) / (range.y - range.x), 0.0, 1.0);
    x = x > 0.0 ? pow(x, exponent) : 0.0;
    if (air.y > 0.0) // its level, and how far above it pixels fade
        x *= smoothstep(0.0, air.y, most - air.x);
    float lift = min(0.0, range.x); // lifts empty pixels to grey, which has no hue
    float largest = max(most, 0.0);
    vec3 shown = largest > lift ? x * (max(value, vec3(0.0)) - lift) / (largest - lift) : vec3(x);
    return inverted ? vec3(1.0) - shown : shown;
}
