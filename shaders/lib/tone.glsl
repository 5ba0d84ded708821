// SPDX-License-Identifier: GPL-3.0-or-later
// The display curve of core/render/compose.h: window, x^(1/1.4), film inversion.
float tone(float value, float low, float high, bool inverted) {
    float x = clamp((value - low) / (high - low), 0.0, 1.0);
    x = pow(x, 1.0 / 1.4);
    return inverted ? 1.0 - x : x;
}
