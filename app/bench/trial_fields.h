// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "app/bench/genes.h"
#include "core/volume/lattice.h"

namespace pellucid::bench {

/// The kinds of fields that a search for counterexamples tries.
enum class FieldKind {
    points,
    corners,
    rods,
    sheet,
    shell,
    comb,
    chirp,
    body,
    noise,
    cloud,
    metal,
    pattern
};
inline constexpr int fieldKinds = 12;
const char *fieldKindName(FieldKind kind);

/// A field as a function of lattice coordinates, each in -1..1.
struct Shape {
    std::function<double(const glm::dvec3 &)> value;
    /// The direction, in the same coordinates, of its worst view.
    glm::dvec3 along{0.0, 0.0, 1.0};
};

/// A small lattice, often anisotropic or tilted.
volume::Lattice latticeOf(Genes &genes);
Shape shapeOf(FieldKind kind, Genes &genes, const volume::Lattice &lattice);
/// The samples of a shape, 0..1, with those that are not a function of position: single bright
/// samples, patterns, colored noise.
std::vector<float> samplesOf(FieldKind kind, const Shape &shape, Genes &genes,
                             const volume::GridSize &size);

} // namespace pellucid::bench
