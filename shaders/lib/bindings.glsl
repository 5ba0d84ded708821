// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings and limits of a frame. gpu/bindings.h repeats them; a test compares the two.
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
