// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "core/classify/color_basis.h"
#include "core/classify/tissue_class.h"

namespace pellucid::classify {

/// An atlas of the whole body has some hundred segments.
inline constexpr std::size_t maxClasses = 1000;

/// How a volume is shown: its density through a transfer function, or, if there are classes, the
/// sum of weight times class in the colors of the classes.
struct Look {
    TransferFunction transferFunction;
    std::vector<TissueClass> classes;
    bool operator==(const Look &) const = default;
};

/// *Throws* Error{usage} naming the value that is out of range, or the class whose steps refer to a
/// missing or ambiguous class, form a circle, or combine too many classes.
void validate(const Look &look);

/// The classes with the operands of their steps in place of the names, so that each can be computed
/// without the others. *Requires*: a valid look.
std::vector<TissueClass> withOperands(const Look &look);
/// The segments that each class needs, its operands' included. *Requires*: a valid look.
std::vector<std::set<std::string>> segmentsOf(const Look &look);
/// Whether a class combines, directly or through others, with that of a name.
bool dependsOn(const Look &look, const TissueClass &tissue, const std::string &name);

/// Removes a class. Steps that name it keep it as their own.
void removeClass(Look &look, std::size_t index);
/// Replaces a class; steps that name it follow its new name, which gets a number if another class
/// has it.
void replaceClass(Look &look, std::size_t index, TissueClass by);
/// Adds a class at the end, with a number behind its name if another class has it.
void addClass(Look &look, TissueClass tissue);

/// Whether values alone do not decide about any of the classes: it has steps or a segment, or is
/// drawn.
bool haveRegions(const std::vector<TissueClass> &classes);

/// The classes with a nonzero weight, with the operands of their steps; the others cost nothing.
/// *Requires*: a valid look.
std::vector<TissueClass> visibleClasses(const Look &look);

/// The basis of the visible classes' colors, with one entry of amounts per class; white if there
/// are none.
ColorBasis colorBasisOf(const Look &look);
/// The number of fields that the picture of a look needs: the rank of its colors.
std::size_t channelsOf(const Look &look);
/// Whether the picture has no color.
bool isGrey(const Look &look);

} // namespace pellucid::classify
