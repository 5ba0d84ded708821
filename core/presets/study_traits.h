// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>

namespace pellucid::presets {

struct Preset;

/// A region of the body that a study shows, or a preset is meant for.
enum class BodyRegion { head, neck, chest, abdomen, pelvis, spine, limb };

/// The properties of a study that decide which presets are offered.
struct StudyTraits {
    std::set<BodyRegion> regions; ///< empty: unknown
    bool hasContrast = false;     ///< vessels filled with contrast medium
    bool operator==(const StudyTraits &) const = default;
};

/// The regions that a header names: codes that scanners write into BodyPartExamined, such as
/// "CHESTABDPELVIS", and English words in the description of the series. Empty if there are none.
std::set<BodyRegion> regionsNamed(const std::string &bodyPart, const std::string &description);

/// "head", "neck", ... *Throws* Error{usage} listing the valid names.
BodyRegion regionFromName(const std::string &name);
const char *regionName(BodyRegion region);

/// Whether a preset is worth offering for a study of its modality.
bool isFor(const Preset &preset, const StudyTraits &traits);

} // namespace pellucid::presets
