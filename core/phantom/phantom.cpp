// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/phantom/phantom.h"

#include <array>
#include <cmath>

#include "core/phantom/anatomy.h"
#include "core/phantom/reasons.h"
#include "core/task/error.h"

namespace pellucid::phantom {

namespace {

using MakeVolume = volume::Volume (*)(const volume::Lattice &, const task::Progress &);

struct Entry {
    Kind kind;
    const char *name;
    volume::GridSize size;
    glm::dvec3 spacingMm;
    MakeVolume make;
};

const std::array<Entry, 7> &entries() {
    static const std::array<Entry, 7> all{{
        {Kind::head, "head", {256, 256, 240}, {0.95, 0.95, 1.0}, makeHead},
        {Kind::chest, "chest", {288, 224, 180}, {1.4, 1.4, 2.0}, makeChest},
        {Kind::ellipsoids, "ellipsoids", {128, 128, 128}, {1.0, 1.0, 1.0}, makeEllipsoids},
        {Kind::metal, "metal", {128, 128, 128}, {1.0, 1.0, 1.0}, makeMetal},
        {Kind::cube, "cube", {64, 64, 64}, {1.0, 1.0, 1.0}, makeCube},
        {Kind::bars, "bars", {128, 128, 128}, {1.0, 1.0, 1.0}, makeBars},
        {Kind::sphere, "sphere", {64, 64, 64}, {1.0, 1.0, 1.0}, makeSphere},
    }};
    return all;
}

const Entry &entryOf(Kind kind) {
    return entries()[std::size_t(kind)];
}

} // namespace

std::vector<std::string> kindNames() {
    std::vector<std::string> names;
    for (const Entry &entry : entries())
        names.emplace_back(entry.name);
    return names;
}

Kind kindFromName(const std::string &name) {
    std::string known;
    for (const Entry &entry : entries()) {
        if (name == entry.name)
            return entry.kind;
        known += std::string(known.empty() ? "" : ", ") + entry.name;
    }
    throw task::Error(task::ErrorCode::usage, task::because::unknownPhantom(name, known));
}

std::string nameOf(Kind kind) {
    return entryOf(kind).name;
}

volume::Lattice phantomLattice(Kind kind, const Sampling &sampling) {
    const Entry &entry = entryOf(kind);
    const volume::GridSize size = sampling.size.value_or(entry.size);
    glm::dvec3 s = sampling.spacingMm.value_or(entry.spacingMm);
    if (sampling.size && !sampling.spacingMm) // the same field of view on another grid
        s *= glm::dvec3(entry.size.i, entry.size.j, entry.size.k) /
             glm::dvec3(size.i, size.j, size.k);
    const double tilt = sampling.tiltRad;
    if (!(std::abs(tilt) <= 1.0))
        throw task::Error(task::ErrorCode::usage, task::because::tiltOutOfRange);
    for (int d = 0; d < 3; ++d)
        if (!(size[d] >= 1 && size[d] <= 4096) || !(s[d] > 0.0 && s[d] < 1e6))
            throw task::Error(task::ErrorCode::usage, task::because::phantomSizeOutOfRange);
    // The table moves along z, so the distance along the normal is the movement times cos(tilt).
    const std::array<glm::dvec3, 3> steps{s.x * glm::dvec3(1, 0, 0),
                                          s.y * glm::dvec3(0, std::cos(tilt), -std::sin(tilt)),
                                          s.z / std::cos(tilt) * glm::dvec3(0, 0, 1)};
    const glm::dvec3 origin =
        -0.5 * (double(size.i - 1) * steps[0] + double(size.j - 1) * steps[1] +
                double(size.k - 1) * steps[2]);
    return volume::Lattice::make(size, {origin}, steps);
}

volume::Volume makePhantom(Kind kind, const volume::Lattice &lattice,
                           const task::Progress &progress) {
    return task::orOutOfMemory(task::because::noMemoryForThePhantom,
                               [&] { return entryOf(kind).make(lattice, progress); });
}

} // namespace pellucid::phantom
