// SPDX-License-Identifier: GPL-3.0-or-later
// The slice at a frequency, with or without cue and light, as in core/render/frame_*_hwy.inc.
// FIELD_PAGES: number of textures ("pages") of fields; PAGES: the same plus those of gradients,
// which follow. A page holds one or more stacked spectra, or one of the SLABS slabs of a spectrum.
// SUMS, IMAGES: 1 to 3; SHADED, CUED, LIT: 0 or 1.
layout(binding = FIRST_SPECTRUM) uniform sampler3D pages[PAGES];

// The last row of each column inside the disc of the band.
layout(std430, binding = DISC_ROWS) readonly buffer DiscRows {
    int discRows[];
};

// The width that reads each tile, [strip][tile from -frame.tilesPerSide on].
layout(std430, binding = TILE_WIDTHS) readonly buffer TileWidths {
    int tileWidths[];
};

int widthAt(int column, int row) {
    if (frame.tilesPerSide == 0)
        return WIDTH;
    int tile = (row + frame.tilesPerSide * TILE_ROWS) / TILE_ROWS;
    return tileWidths[column / TILE_COLUMNS * 2 * frame.tilesPerSide + tile];
}

const int kinds = LIT + 1; // fields; gradient lengths under light

Fixed placeOf(int column, int row) {
    Fixed origin = Fixed(frame.originLow, frame.originHigh);
    Fixed perColumn = Fixed(frame.columnLow, frame.columnHigh);
    Fixed perRow = Fixed(frame.rowLow, frame.rowHigh);
    return plus(plus(origin, times(perColumn, uint(column))),
                times(perRow, uint(row + frame.rows / 2)));
}

// The cells to read and their weights. q: a_d.s. mirrored: the result is the conjugate of the value
// read.
Taps tapsAt(Fixed place, int width, out vec3 q, out bool mirrored) {
    ivec3 whole = wholeOf(place);
    vec3 part = partOf(place);
    q = (vec3(whole) + part) * frame.inversePadded.xyz;
    // The spectrum is periodic; at half a period both copies are equal.
    whole -= ivec3(round(q)) * frame.padded.xyz;
    mirrored = float(whole.x) + part.x < -frame.edgeSlack.x;
    if (mirrored) {
        whole = -whole - 1;
        part = 1.0 - part;
    }
    vec3 tap = ceil(part - (0.5 * float(width) + frame.edgeSlack.xyz));
    vec3 c = tap - part + 0.5 * float(width - 1);
    Taps taps;
    taps.width = width;
    taps.first = whole + ivec3(tap) - frame.firstCell.xyz;
    kernelWeights(0, c.x, width, taps.x);
    kernelWeights(1, c.y, width, taps.y);
    kernelWeights(2, c.z, width, taps.z);
#if CUED
    momentWeights(0, c.x, width, taps.momentX);
    momentWeights(1, c.y, width, taps.momentY);
    momentWeights(2, c.z, width, taps.momentZ);
#endif
    return taps;
}

// Each slab of a spectrum holds all cells that a kernel needs. Only the pages of the source's kind
// are tried.
Sum readSource(int source, Taps taps, int firstPage, int endPage) {
    int pageOfSource = frame.places[source].page;
    if (SLABS > 1) {
        int slab = min(taps.first.z / frame.slabStep, SLABS - 1);
        pageOfSource += slab;
        taps.first.z -= slab * frame.slabStep;
    }
    taps.first.z += frame.places[source].firstPlane;
    Sum sum;
    sum.value = vec2(0.0);
#if CUED
    sum.moment = vec2(0.0);
#endif
    for (int page = firstPage; page < endPage; ++page)
        if (page == pageOfSource)
            sum = sumOfCells(pages[page], taps);
    return sum;
}

#if SHADED
// F, and base F + moment of F.
struct Shades {
    vec2 plain, cued;
};

Shades shadesOf(Sum sum, float sign) {
    Shades s;
    s.plain = vec2(sum.value.x, sign * sum.value.y);
    s.cued = s.plain;
#if CUED
    // -i z, or +i conj z if the mirrored frequency was read.
    s.cued = frame.cueBase * s.plain + vec2(sum.moment.y, -sign * sum.moment.x);
#endif
    return s;
}

// One term of an image's shaded slice, see core/render/frame_job.h. *Source*: Totsuka 1993, eq. 3
// to 5 and 12 to 14.
vec2 shaded(int channel, Shades field, Shades gradient, vec3 q) {
    vec2 slice = frame.shade[channel].ambient * field.cued;
#if LIT
    vec3 r = q - round(q);
    vec3 sine = vec3(sineOfTurn(r.x), sineOfTurn(r.y), sineOfTurn(r.z));
    slice += frame.shade[channel].magnitude * gradient.cued;
    slice += dot(frame.gradient[channel].xyz, sine) * quarterTurned(field.cued);
#if CUED
    vec3 cosine = vec3(cosineOfTurn(r.x), cosineOfTurn(r.y), cosineOfTurn(r.z));
    slice -= dot(frame.excess[channel].xyz, cosine) * field.plain;
#endif
#endif
    return slice;
}
#endif

void addSource(int source, Sum sum, int first, inout Sum sums[kinds * SUMS]) {
    vec4 weights = frame.channelWeights[source];
    for (int c = 0; c < SUMS; ++c) {
        sums[first + c].value += weights[c] * sum.value;
#if CUED
        sums[first + c].moment += weights[c] * sum.moment;
#endif
    }
}

void addTerm(int term, Taps taps, bool mirrored, bool isCentre, vec3 q,
             inout vec2 slice[IMAGES]) {
    Sum sums[kinds * SUMS];
    for (int s = 0; s < kinds * SUMS; ++s) {
        sums[s].value = vec2(0.0);
#if CUED
        sums[s].moment = vec2(0.0);
#endif
    }
    // One kind after the other, so that every index into the sums is a compile-time constant;
    // otherwise the array leaves the registers.
    for (int source = 0; source < frame.fieldCount; ++source)
        addSource(source, readSource(source, taps, 0, FIELD_PAGES), 0, sums);
#if LIT
    for (int source = frame.fieldCount; source < frame.sourceCount; ++source)
        addSource(source, readSource(source, taps, FIELD_PAGES, PAGES), SUMS, sums);
#endif
    // Frequency 0 decides the brightness of the picture, so its exact value replaces the rounded
    // sum.
    if (isCentre)
        for (int s = 0; s < kinds * SUMS; ++s) {
            int kindAndSum = s / SUMS * 3 + s % SUMS;
            sums[s].value = vec2(frame.zero[kindAndSum].value, 0.0);
#if CUED
            sums[s].moment = vec2(0.0, frame.zero[kindAndSum].moment);
#endif
        }
    float sign = mirrored ? -1.0 : 1.0;
    for (int c = 0; c < IMAGES; ++c) {
        int of = SUMS == 1 ? 0 : c;
#if SHADED
        vec2 value = shaded(c, shadesOf(sums[of], sign),
                            shadesOf(sums[(kinds - 1) * SUMS + of], sign), q);
        slice[c] += multiplied(frame.termWeight[term].xy, value);
#else
        slice[c] += vec2(sums[of].value.x, sign * sums[of].value.y);
#endif
    }
}

// *Requires*: a row of -rows/2 to rows/2 - 1, inside the disc.
void sliceAt(int column, int row, out vec2 slice[IMAGES]) {
    for (int c = 0; c < IMAGES; ++c)
        slice[c] = vec2(0.0);
    int width = widthAt(column, row);
    if (width == 0)
        return;
    Fixed centre = placeOf(column, row);
    vec3 q, ofCentre;
    bool mirrored;
    for (int term = 0; term < frame.termCount; ++term) {
        // The picture's own factors are those of the central slice.
        Fixed place = plus(centre, Fixed(frame.termLow[term], frame.termHigh[term]));
        Taps taps = tapsAt(place, width, q, mirrored);
        if (term == 0)
            ofCentre = q;
        addTerm(term, taps, mirrored, term == 0 && column == 0 && row == 0, q, slice);
    }
    float radius = length(2.0 * vec2(column, row) / vec2(frame.columns, frame.rows));
    float u = radius * radius * frame.detailWidth * frame.detailWidth;
    float factor = frame.unit * rollOffFactor(frame.rollOff, radius) *
                   (1.0 + frame.detail * u / (1.0 + u)) *
                   reconstructionFactor(frame.reconstruction, frame.wraps != 0, frame.rollOff,
                                        ofCentre);
    float turns = turnsOf(centre);
    vec2 phase = factor * vec2(cosineOfTurn(turns), sineOfTurn(turns));
    for (int c = 0; c < IMAGES; ++c)
        slice[c] = multiplied(phase, slice[c]);
}
