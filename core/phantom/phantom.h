// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::phantom {

enum class Kind { head, chest, ellipsoids, metal, cube, bars, sphere };

/// The grid of a phantom. Missing entries use the kind's defaults.
struct Sampling {
    std::optional<volume::GridSize> size = std::nullopt;
    /// Distances of columns, rows and slices; the last is measured along the slices' normal.
    std::optional<glm::dvec3> spacingMm = std::nullopt;
    /// Gantry tilt: slices rotated about the patient's x axis, stacked along z.
    double tiltRad = 0.0;
};

/// *Throws* Error{usage} for an unknown name; the message lists the known ones.
Kind kindFromName(const std::string &name);
std::string nameOf(Kind kind);
std::vector<std::string> kindNames();

/// *Throws* Error{usage} for sizes, spacings or tilts that do not make a lattice.
volume::Lattice phantomLattice(Kind kind, const Sampling &sampling);

/// The phantom as a CT volume in HU. *Throws* Cancelled, Error{outOfMemory}.
volume::Volume makePhantom(Kind kind, const volume::Lattice &lattice,
                           const task::Progress &progress = {});

} // namespace pellucid::phantom
