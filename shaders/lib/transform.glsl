// SPDX-License-Identifier: GPL-3.0-or-later
// Inverse transforms of a line in shared memory, of any length up to ROOM: Stockham's mixed-radix
// algorithm, which needs no reordering pass.
shared vec2 line[2 * ROOM];

// One stage from one half of `line` to the other. `done`: product of the radices of earlier stages.
void stage(int radix, int done, int length, int from, int to, int table) {
    int count = length / radix;
    int turn = length / (done * radix);
    for (int n = int(gl_LocalInvocationIndex); n < count; n += THREADS) {
        int k = n % done;
        vec2 v[8];
        v[0] = line[from + n];
        for (int q = 1; q < 8; ++q)
            if (q < radix)
                v[q] = multiplied(line[from + n + q * count], rotations[table + q * k * turn]);
        inverseFew(radix, v);
        int first = to + (n - k) * radix + k;
        for (int q = 0; q < 8; ++q)
            if (q < radix)
                line[first + q * done] = v[q];
    }
}

// Transforms line[0 .. length-1], which all threads have written, and returns the offset of the
// result. `plan`: 0 for a column, 1 for a row.
int transformLine(int length, int plan, int table) {
    int from = 0, done = 1;
    int stages = plan == 0 ? frame.columnStages : frame.rowStages;
    for (int s = 0; s < stages; ++s) {
        int radix = frame.radices[4 * plan + s / 4][s % 4];
        barrier();
        stage(radix, done, length, from, ROOM - from, table);
        from = ROOM - from;
        done *= radix;
    }
    barrier();
    return from;
}
