// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters that all passes of a frame share. gpu/frame_block.h has the same layout; a test
// compares the offsets.
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
    // xyz: cells of the spectrum by axis, 24.40 bits in two's complement; w: turns of the phase,
    // 0.64 bits. Exact at any size, where floats would lose the fraction.
    uvec4 originLow, originHigh; // of column 0 in the lowest row, -rows/2
    uvec4 columnLow, columnHigh; // per column
    uvec4 rowLow, rowHigh;       // per row
    uvec4 termLow[MAX_TERMS], termHigh[MAX_TERMS];
    vec4 termWeight[MAX_TERMS]; // xy: complex
    int columns, rows;           // of the slice's grid
    int pictureColumns, pictureRows;
    int periodRows;              // rows of the picture within the period
    int termCount;
    int fieldCount, sourceCount; // fields come first
    int reconstruction, wraps;   // wraps: 0 or 1, see core/render/frame_geometry.h
    int tilesPerSide;            // on each side of row 0; 0: one width reads everything
    int slabStep;                // planes from one slab's beginning to the next
    int columnStages, rowStages; // stages of a column's and a row's transform
    int columnRotations, rowRotations, unpackRotations; // offsets of the rotations
    float rollOff;
    float unit;                  // of the slice
    float cueBase;               // of a linear cue
    float detail, detailWidth;   // see core/render/frame_job.h
    ivec4 padded;                // by axis, like the following vectors
    ivec4 firstCell;             // grid index of the first texel
    vec4 inversePadded;
    vec4 edgeSlack;              // see core/render/frame_geometry.h
    vec4 perMoment;
    vec4 channelWeights[MAX_SPECTRA]; // by source
    Place places[MAX_SPECTRA];         // by source
    ZeroSum zero[6];             // by kind and sum
    ImageShade shade[3];
    vec4 gradient[3];
    vec4 excess[3];
    // [width - 1][axis][pair][...]: a vector holds two even and two odd coefficients
    vec4 kernels[MAX_WIDTH * 3 * MAX_PAIRS * MAX_PAIR_VECTORS];
    vec4 momentKernels[MAX_WIDTH * 3 * MAX_PAIRS * MAX_PAIR_VECTORS];
    ivec4 radices[8];            // four vectors for a column, four for a row
}
frame;
