// SPDX-License-Identifier: GPL-3.0-or-later
// Where the resources of a frame are bound, and its limits; gpu/bindings.h says the same, which a
// test compares.
#define FRAME_BLOCK 0
#define DISC_ROWS 0
#define ROTATIONS 1
#define SLICE 2
#define LINES 3
#define PICTURE 0
#define FIRST_SPECTRUM 0
#define MOST_SPECTRA 64
#define MOST_PAGES 16
#define MOST_TERMS 16
#define MOST_PAIRS 4
#define MOST_PAIR_VECTORS 3
#define THREADS 128
