// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame's passes share: gpu/frame_block.h fills it, and a test compares the places of its
// members.
struct Place {
    int page, firstPlane;
};
struct ZeroSum {
    float value, moment;
};
struct ImageShade {
    float ambient, magnitude;
};

layout(std140, binding = FRAME_BLOCK) uniform Frame {
    // Cells of the spectrum by axis, 24.40 bits in two's complement; .w: turns of the phase, 0.64
    // bits. Exact whatever the size, where floats lose the fraction.
    uvec4 originLow, originHigh; // of column 0 in the lowest row, -rows/2
    uvec4 columnLow, columnHigh; // per column
    uvec4 rowLow, rowHigh;       // per row
    uvec4 termLow[MOST_TERMS], termHigh[MOST_TERMS];
    vec4 termWeight[MOST_TERMS]; // xy: complex
    int columns, rows;           // of the slice's grid
    int pictureColumns, pictureRows;
    int periodRows;              // rows of the picture within the period
    int termCount;
    int fieldCount, sourceCount; // fields come first
    int reconstruction, wraps;   // wraps: 0 or 1, see core/render/frame_geometry.h
    int slabStep;                // planes between the beginnings of slabs
    int columnStages, rowStages; // of the transform of a column, of a row
    int columnRotations, rowRotations, unpackRotations; // where the rotations of each begin
    float rollOff;
    float unit;                  // of the slice
    float cueBase;               // of a linear cue
    ivec4 padded;                // by axis, as are the next ones
    ivec4 firstCell;             // index of the first texel
    vec4 inversePadded;
    vec4 edgeSlack;              // see core/render/frame_geometry.h
    vec4 perMoment;
    vec4 shares[MOST_SPECTRA];   // of a source
    Place places[MOST_SPECTRA];  // of a source
    ZeroSum zero[6];             // by kind and sum
    ImageShade shade[3];
    vec4 gradient[3];
    vec4 excess[3];
    vec4 kernels[3 * MOST_PAIRS * MOST_PAIR_VECTORS]; // [axis][pair][...]: even and odd coefficients, two a vector
    vec4 momentKernels[3 * MOST_PAIRS * MOST_PAIR_VECTORS];
    ivec4 radices[8];            // four vectors for a column, four for a row
}
frame;
