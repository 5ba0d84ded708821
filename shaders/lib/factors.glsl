// SPDX-License-Identifier: GPL-3.0-or-later
// Factors of a frequency. Series replace the driver's sine, whose error is unspecified.
const float pi2 = 9.8696044;

// sinc^2(r) for |r| <= 1/2 from its series in p = r^2, (-1)^k 2^(2k+1) (pi r)^(2k) / (2k+2)!, to
// 3e-8.
float sincSquared(float p) {
    float x = pi2 * p;
    float sum = -32768.0 / 20922789888000.0;
    sum = sum * x + 8192.0 / 87178291200.0;
    sum = sum * x - 2048.0 / 479001600.0;
    sum = sum * x + 512.0 / 3628800.0;
    sum = sum * x - 128.0 / 40320.0;
    sum = sum * x + 32.0 / 720.0;
    sum = sum * x - 8.0 / 24.0;
    return sum * x + 1.0;
}

// sin(2 pi r) for |r| <= 1/2, to 6e-8.
float sineOfTurn(float r) {
    float size = abs(r);
    float x = 6.28318531 * min(size, 0.5 - size), square = x * x;
    float sum = -1.0 / 39916800.0;
    sum = sum * square + 1.0 / 362880.0;
    sum = sum * square - 1.0 / 5040.0;
    sum = sum * square + 1.0 / 120.0;
    sum = sum * square - 1.0 / 6.0;
    sum = sum * square + 1.0;
    return r < 0.0 ? -sum * x : sum * x;
}

float cosineOfTurn(float r) {
    return sineOfTurn(0.25 - abs(r));
}

// A raised cosine from 1 at through = 0 to 0 at 1.
float raisedCosine(float through) {
    float halfway = 0.5 * clamp(through, 0.0, 1.0);
    float p = halfway * halfway;
    return max(0.0, 1.0 - pi2 * p * sincSquared(p));
}

// t(q), see core/scene/image_definition.h. A roll-off of 0 becomes a very steep one.
float rollOffFactor(float rollOff, float q) {
    float steep = max(1e-5, rollOff);
    return raisedCosine((q - (1.0 - steep)) / steep);
}

const int cubic = 0, linear = 1, bandLimited = 2, spline = 3;

// One axis per component.
vec3 sincSquared(vec3 p) {
    return vec3(sincSquared(p.x), sincSquared(p.y), sincSquared(p.z));
}

// sinc(2 r) for |r| <= 1/2 from its series in p = r^2, to 1e-8.
vec3 sincOfTurn(vec3 p) {
    vec3 x = 4.0 * pi2 * p;
    vec3 sum = vec3(1.0 / 355687428096000.0);
    sum = sum * x - 1.0 / 1307674368000.0;
    sum = sum * x + 1.0 / 6227020800.0;
    sum = sum * x - 1.0 / 39916800.0;
    sum = sum * x + 1.0 / 362880.0;
    sum = sum * x - 1.0 / 5040.0;
    sum = sum * x + 1.0 / 120.0;
    sum = sum * x - 1.0 / 6.0;
    return sum * x + 1.0;
}

// The product of K(q) over the axes, q = a_d.s in cycles per sample.
float reconstructionFactor(int reconstruction, bool wraps, float rollOff, vec3 q) {
    if (reconstruction == bandLimited)
        return rollOffFactor(rollOff, 2.0 * abs(q.x)) * rollOffFactor(rollOff, 2.0 * abs(q.y)) *
               rollOffFactor(rollOff, 2.0 * abs(q.z));
    // |sinc q| = |sinc(r) r/q| with r = q - round(q); ratio 1 for |q| <= 1/2, where q = r.
    vec3 r = wraps ? q - round(q) : q;
    vec3 ratio = mix(vec3(1.0), r / q, greaterThan(abs(q), vec3(0.5)));
    vec3 p = r * r, near = sincSquared(p), square = near * ratio * ratio, factor = square;
    if (reconstruction == cubic)
        factor = square * (3.0 * square - 2.0 * ratio * sincOfTurn(p));
    else if (reconstruction == spline) // 2 + cos 2 pi q = 3 - 2 sin^2 pi q
        factor = square * square / (1.0 - 2.0 / 3.0 * pi2 * p * near);
    return factor.x * factor.y * factor.z;
}
