// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings and limits of a frame. gpu/bindings.h repeats them; a test compares the two.
#define FRAME_BLOCK 0
#define DISC_ROWS 0
#define ROTATIONS 1
#define SLICE 2
#define LINES 3
#define PICTURE 0
#define FIRST_SPECTRUM 0
#define MAX_SPECTRA 64
#define MAX_PAGES 16
#define MAX_TERMS 16
#define MAX_PAIRS 4
#define MAX_PAIR_VECTORS 3
#define THREADS 128
