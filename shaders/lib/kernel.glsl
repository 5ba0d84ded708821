// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolation of a spectrum. WIDTH: the kernel's; EVEN_TERMS, MOMENT_TERMS: number of
// coefficients of a tap's even part, and as many of its odd part, for the kernel and for its
// moment.
const int pairs = (WIDTH + 1) / 2;

// Even and odd part of a pair of taps at a squared offset, see PiecewiseKernel::pairs.
#define EVEN_AND_ODD(polynomials, axis, pair, terms, square, sum)                                  \
    vec2 sum = vec2(0.0);                                                                          \
    for (int n = terms - 1; n >= 0; --n) {                                                         \
        vec4 two = polynomials[(axis * MAX_PAIRS + pair) * MAX_PAIR_VECTORS + n / 2];            \
        sum = sum * square + (n % 2 == 0 ? two.xy : two.zw);                                       \
    }

// The weights along an axis for a centred offset c: of WIDTH taps, or of fewer for a narrower
// kernel.
void kernelWeights(int axis, float c, int width, out float weights[WIDTH]) {
    int kernel = 3 * (width - 1) + axis;
    if (width == WIDTH) {
        for (int k = 0; k < pairs; ++k) {
            EVEN_AND_ODD(frame.kernels, kernel, k, EVEN_TERMS, c * c, part)
            weights[k] = part.x + c * part.y;
            if (2 * k != WIDTH - 1)
                weights[WIDTH - 1 - k] = part.x - c * part.y;
        }
        return;
    }
    for (int k = 0; k < WIDTH; ++k) {
        int mirrored = width - 1 - k;
        EVEN_AND_ODD(frame.kernels, kernel, max(0, min(k, mirrored)), EVEN_TERMS, c * c, part)
        weights[k] = k < width ? part.x + (k > mirrored ? -c : c) * part.y : 0.0;
    }
}

#if CUED
// The offset of a tap is its grid index minus the frequency, which flips the sign of an odd kernel.
void momentWeights(int axis, float c, int width, out float weights[WIDTH]) {
    int kernel = 3 * (width - 1) + axis;
    float scale = -frame.perMoment[axis];
    if (width == WIDTH) {
        for (int k = 0; k < pairs; ++k) {
            EVEN_AND_ODD(frame.momentKernels, kernel, k, MOMENT_TERMS, c * c, part)
            weights[k] = scale * (part.x + c * part.y);
            if (2 * k != WIDTH - 1)
                weights[WIDTH - 1 - k] = scale * (c * part.y - part.x);
        }
        return;
    }
    for (int k = 0; k < WIDTH; ++k) {
        int mirrored = width - 1 - k;
        EVEN_AND_ODD(frame.momentKernels, kernel, max(0, min(k, mirrored)), MOMENT_TERMS, c * c,
                     part)
        float weight = k > mirrored ? c * part.y - part.x : part.x + c * part.y;
        weights[k] = k < width ? scale * weight : 0.0;
    }
}
#endif

struct Taps {
    ivec3 first; // the texel of the first tap
    int width;
    float x[WIDTH], y[WIDTH], z[WIDTH];
#if CUED
    float momentX[WIDTH], momentY[WIDTH], momentZ[WIDTH];
#endif
};

// A weighted sum of cells. For a linear cue also the sum of three such sums, each with the moment's
// weights along one axis and the plain weights along the other two.
struct Sum {
    vec2 value;
#if CUED
    vec2 moment;
#endif
};

Sum sumOfCells(sampler3D cells, Taps taps) {
    Sum sum;
    sum.value = vec2(0.0);
#if CUED
    sum.moment = vec2(0.0);
#endif
    for (int k = 0; k < WIDTH; ++k) {
        if (k >= taps.width)
            break;
        vec2 plane = vec2(0.0);
#if CUED
        vec2 planeMoment = vec2(0.0);
#endif
        for (int j = 0; j < WIDTH; ++j) {
            if (j >= taps.width)
                break;
            vec2 row = vec2(0.0);
#if CUED
            vec2 rowMoment = vec2(0.0);
#endif
            for (int i = 0; i < WIDTH; ++i) {
                if (i >= taps.width)
                    break;
                vec2 cell = texelFetch(cells, taps.first + ivec3(i, j, k), 0).rg;
                row += taps.x[i] * cell;
#if CUED
                rowMoment += taps.momentX[i] * cell;
#endif
            }
            plane += taps.y[j] * row;
#if CUED
            planeMoment += taps.y[j] * rowMoment + taps.momentY[j] * row;
#endif
        }
        sum.value += taps.z[k] * plane;
#if CUED
        sum.moment += taps.z[k] * planeMoment + taps.momentZ[k] * plane;
#endif
    }
    return sum;
}
