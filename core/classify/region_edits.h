// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/classify/density_field.h"
#include "core/classify/look.h"

namespace pellucid::classify {

/// How a marked region changes the classes of a look.
enum class RegionUse {
    newClass, ///< it becomes a class
    add,      ///< a class gets it, too
    keep,     ///< classes keep only what is in it
    remove    ///< classes lose what is in it
};

/// The class that an edit changes; not set: every class of the look.
using EditedClass = std::optional<std::size_t>;

/// The class of the samples from `low` to `high` that are connected to a point. It has no color of
/// its own. `leakMm`: as for the step `connected`.
TissueClass connectedRegion(volume::PatientPoint point, double low, double high, double leakMm);

/// The class of the bone that is connected to a point, including its marrow and a rim of partial
/// volume: a millimetre, or a sample if that is more. `low`: the value from
/// which it is bone.
TissueClass boneRegion(const volume::Lattice &lattice, volume::PatientPoint point, double low);

/// The class of all samples within a cut.
TissueClass cutRegion(const LassoCut &cut);

/// The whole volume as a class, for a look without classes.
TissueClass volumeClass(const TransferFunction &curve, const FieldWindow &window);

// In all edits, a look without classes first becomes one class, the whole volume. A class that gets
// its first border by an edit gets the default edge with it. The caller validates the look.

/// *Requires*: `edited` is set if `use` is `add`. Returns the index of the class that shows the
/// region: the new one, or `edited`.
EditedClass useRegion(Look &look, const TissueClass &region, RegionUse use, EditedClass edited,
                      const FieldWindow &window);

/// Cuts classes along the line of sight.
void cutClasses(Look &look, const LassoCut &cut, EditedClass edited, const FieldWindow &window);

/// Adds strokes to a class, or erases them from one; not set: paints a new class, or erases from
/// every class. *Requires*: at least one stroke; all erase or none. Returns the class that was
/// painted, as `useRegion`.
EditedClass paintClass(Look &look, const std::vector<Stroke> &strokes, EditedClass edited,
                       const FieldWindow &window);

/// Adds a step to a class.
void addStep(Look &look, const Step &step, std::size_t edited);

/// The first class with a step that waits for points.
std::optional<std::size_t> awaitingClass(const Look &look);
/// Whether a point can be added to a class.
bool takesPoints(const TissueClass &tissue);
/// Adds a point to the last step of a class that takes points; false if it has none.
bool addPoint(TissueClass &tissue, volume::PatientPoint point);

/// Removes the points, strokes and cuts of a look, which belong to one patient. Steps that take
/// points wait for new ones. Classes of which nothing remains are removed.
Look withoutMarks(const Look &look);

} // namespace pellucid::classify
