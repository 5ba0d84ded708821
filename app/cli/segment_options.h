// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "core/classify/look.h"
#include "core/segment/segment_set.h"

namespace pellucid::cli {

/// Loads the files of --segmentation for a volume, with their warnings on stderr. Null if there are
/// none. *Throws* Error{unusable, outOfMemory}; Error{usage} if one of `outs` is such a file.
std::shared_ptr<const segment::SegmentSet>
loadSegments(const std::vector<std::string> &files, const std::vector<std::filesystem::path> &outs,
             const volume::Volume &volume, const Context &context);

struct SceneOptions;

/// Adds classes for segments to a look: those that --segment names, or else all of them, unless the
/// look has classes of segments already. Of several options for one segment, the last counts.
/// *Throws* Error{usage} for a name that no segment has.
void showSegments(classify::Look &look, const SceneOptions &options,
                  const segment::SegmentSet &segments);

/// NAME[=WEIGHT][:#rrggbb] of an option.
struct WeightedName {
    std::string name;
    double weight = 1.0;
    std::optional<classify::Color> color;
};
/// Whether a name without a weight has the weight 1, or is refused.
enum class Weight { optional, required };
/// *Throws* Error{usage}.
WeightedName parseWeightedName(const std::string &option, const std::string &text, Weight weight);

} // namespace pellucid::cli
