// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame's passes share: gpu/frame_block.h fills it, and a test compares the places of its
// members.
layout(std140, binding = FRAME_BLOCK) uniform Frame {
    // Cells of the spectrum by axis, 24.40 bits in two's complement; .w: turns of the phase, 0.64
    // bits. Exact whatever the size, where floats lose the fraction.
    uvec4 originLow, originHigh; // of column 0 in the lowest row, -rows/2
    uvec4 columnLow, columnHigh; // per column
    uvec4 rowLow, rowHigh;       // per row
    uvec4 termLow[MOST_TERMS], termHigh[MOST_TERMS];
    vec4 termWeight[MOST_TERMS]; // xy: complex
    ivec4 grid;                  // columns, rows; columns and rows of the picture
    ivec4 counts;                // terms; fields; rows of the picture within the period; sources
    ivec4 image;                 // reconstruction; wraps; -; -
    ivec4 padded;                // by axis; planes between the beginnings of slabs
    ivec4 firstCell;             // index of the first texel by axis
    vec4 inversePadded;
    vec4 edgeSlack;              // see core/render/frame_geometry.h
    vec4 scales;                 // roll-off; unit of the slice; base of a linear cue
    vec4 perMoment;
    vec4 shares[MOST_SPECTRA];   // of a source
    ivec4 places[MOST_SPECTRA];  // of a source: page and first plane in it
    vec4 zero[6];                // by kind and sum: value, moment
    vec4 shade[3];               // of an image: ambient, magnitude
    vec4 gradient[3];
    vec4 excess[3];
    vec4 kernels[3 * MOST_PAIRS * MOST_PAIR_VECTORS]; // [axis][pair][...]: even and odd coefficients, two a vector
    vec4 momentKernels[3 * MOST_PAIRS * MOST_PAIR_VECTORS];
    ivec4 stages;                // of the transform along rows' direction, of the other
    ivec4 radices[8];            // four vectors for each
    ivec4 tables;                // where rotations begin: rows, half columns, untangling
}
frame;
