// SPDX-License-Identifier: GPL-3.0-or-later
// In-place inverse transforms of a few points.
void inverse2(inout vec2 a, inout vec2 b) {
    vec2 sum = a + b;
    b = a - b;
    a = sum;
}

void inverse3(inout vec2 v[8]) {
    vec2 sum = v[1] + v[2];
    vec2 across = quarterTurned(0.866025404 * (v[1] - v[2]));
    vec2 middle = v[0] - 0.5 * sum;
    v[0] += sum;
    v[1] = middle + across;
    v[2] = middle - across;
}

void inverse4(inout vec2 a, inout vec2 b, inout vec2 c, inout vec2 d) {
    inverse2(a, c);
    inverse2(b, d);
    d = quarterTurned(d);
    inverse2(a, b);
    inverse2(c, d);
    vec2 second = c; // a, b, c, d are now results 0, 2, 1, 3
    c = b;
    b = second;
}

// Odd lengths use the symmetry of sines and cosines.
void inverse5(inout vec2 v[8]) {
    vec2 sum1 = v[1] + v[4], sum2 = v[2] + v[3];
    vec2 across1 = v[1] - v[4], across2 = v[2] - v[3];
    const float c1 = 0.309016994, c2 = -0.809016994, s1 = 0.951056516, s2 = 0.587785252;
    vec2 even1 = v[0] + c1 * sum1 + c2 * sum2;
    vec2 even2 = v[0] + c2 * sum1 + c1 * sum2;
    vec2 odd1 = quarterTurned(s1 * across1 + s2 * across2);
    vec2 odd2 = quarterTurned(s2 * across1 - s1 * across2);
    v[0] += sum1 + sum2;
    v[1] = even1 + odd1;
    v[4] = even1 - odd1;
    v[2] = even2 + odd2;
    v[3] = even2 - odd2;
}

void inverse7(inout vec2 v[8]) {
    vec2 sum1 = v[1] + v[6], sum2 = v[2] + v[5], sum3 = v[3] + v[4];
    vec2 across1 = v[1] - v[6], across2 = v[2] - v[5], across3 = v[3] - v[4];
    const float c1 = 0.623489802, c2 = -0.222520934, c3 = -0.900968868;
    const float s1 = 0.781831482, s2 = 0.974927912, s3 = 0.433883739;
    vec2 even1 = v[0] + c1 * sum1 + c2 * sum2 + c3 * sum3;
    vec2 even2 = v[0] + c2 * sum1 + c3 * sum2 + c1 * sum3;
    vec2 even3 = v[0] + c3 * sum1 + c1 * sum2 + c2 * sum3;
    vec2 odd1 = quarterTurned(s1 * across1 + s2 * across2 + s3 * across3);
    vec2 odd2 = quarterTurned(s2 * across1 - s3 * across2 - s1 * across3);
    vec2 odd3 = quarterTurned(s3 * across1 - s1 * across2 + s2 * across3);
    v[0] += sum1 + sum2 + sum3;
    v[1] = even1 + odd1;
    v[6] = even1 - odd1;
    v[2] = even2 + odd2;
    v[5] = even2 - odd2;
    v[3] = even3 + odd3;
    v[4] = even3 - odd3;
}

void inverse8(inout vec2 v[8]) {
    inverse4(v[0], v[2], v[4], v[6]);
    inverse4(v[1], v[3], v[5], v[7]);
    const float diagonal = 0.707106781;
    vec2 turned1 = diagonal * vec2(v[3].x - v[3].y, v[3].x + v[3].y);
    vec2 turned2 = quarterTurned(v[5]);
    vec2 turned3 = diagonal * vec2(-v[7].x - v[7].y, v[7].x - v[7].y);
    vec2 first = v[1], a = v[0], b = v[2], c = v[4], d = v[6];
    v[0] = a + first;
    v[4] = a - first;
    v[1] = b + turned1;
    v[5] = b - turned1;
    v[2] = c + turned2;
    v[6] = c - turned2;
    v[3] = d + turned3;
    v[7] = d - turned3;
}

void inverseFew(int radix, inout vec2 v[8]) {
    switch (radix) {
    case 2:
        inverse2(v[0], v[1]);
        break;
    case 3:
        inverse3(v);
        break;
    case 4:
        inverse4(v[0], v[1], v[2], v[3]);
        break;
    case 5:
        inverse5(v);
        break;
    case 7:
        inverse7(v);
        break;
    default:
        inverse8(v);
    }
}
