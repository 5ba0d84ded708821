// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/presets/study_traits.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/files/reasons.h"
#include "core/presets/preset.h"
#include "core/task/error.h"

namespace pellucid::presets {

namespace {

constexpr std::array<std::pair<const char *, BodyRegion>, 7> names{
    {{"head", BodyRegion::head},
     {"neck", BodyRegion::neck},
     {"chest", BodyRegion::chest},
     {"abdomen", BodyRegion::abdomen},
     {"pelvis", BodyRegion::pelvis},
     {"spine", BodyRegion::spine},
     {"limb", BodyRegion::limb}}};

struct Word {
    const char *text;
    std::set<BodyRegion> regions;
};

// Parts of words, as scanners abbreviate and join them. *Source*: DICOM PS3.16, annex L, and usual
// descriptions of series.
const std::vector<Word> &words() {
    using enum BodyRegion;
    static const std::vector<Word> all{{"HEAD", {head}},
                                       {"SKULL", {head}},
                                       {"BRAIN", {head}},
                                       {"CEREBR", {head}},
                                       {"ORBIT", {head}},
                                       {"SINUS", {head}},
                                       {"FACE", {head}},
                                       {"FACIAL", {head}},
                                       {"JAW", {head}},
                                       {"MANDIB", {head}},
                                       {"MAXILL", {head}},
                                       {"DENTAL", {head}},
                                       {"TEETH", {head}},
                                       {"TEMPORAL BONE", {head}},
                                       {"NECK", {neck}},
                                       {"CAROTID", {neck, head}},
                                       {"CHEST", {chest}},
                                       {"THORA", {chest}},
                                       {"LUNG", {chest}},
                                       {"HEART", {chest}},
                                       {"CARDIA", {chest}},
                                       {"CORONARY", {chest}},
                                       {"BREAST", {chest}},
                                       {"ABD", {abdomen}},
                                       {"LIVER", {abdomen}},
                                       {"KIDNEY", {abdomen}},
                                       {"PANCREA", {abdomen}},
                                       {"KUB", {abdomen, pelvis}},
                                       {"TAP", {chest, abdomen, pelvis}},
                                       {"PELV", {pelvis}},
                                       {"PROSTATE", {pelvis}},
                                       {"BLADDER", {pelvis}},
                                       {"HIP", {pelvis}},
                                       {"SPINE", {spine}},
                                       {"CERVICAL", {spine, neck}},
                                       {"LUMBAR", {spine, abdomen}},
                                       {"SACR", {spine, pelvis}},
                                       {"KNEE", {limb}},
                                       {"ANKLE", {limb}},
                                       {"FOOT", {limb}},
                                       {"FEMUR", {limb}},
                                       {"HAND", {limb}},
                                       {"WRIST", {limb}},
                                       {"ELBOW", {limb}},
                                       {"SHOULDER", {limb, chest}},
                                       {"EXTREM", {limb}},
                                       {"WHOLEBODY", {head, neck, chest, abdomen, pelvis, limb}},
                                       {"WHOLE BODY", {head, neck, chest, abdomen, pelvis, limb}}};
    return all;
}

} // namespace

std::set<BodyRegion> regionsNamed(const std::string &bodyPart, const std::string &description) {
    const auto upper = [](const std::string &text) {
        std::string letters;
        for (const char c : text)
            letters += char(std::toupper(static_cast<unsigned char>(c)));
        return letters;
    };
    std::set<BodyRegion> regions;
    // `isCode`: words may be joined.
    const auto find = [&](const std::string &text, bool isCode) {
        const auto isLetter = [&](std::size_t n) {
            return n < text.size() && std::isalpha(static_cast<unsigned char>(text[n])) != 0;
        };
        for (const Word &word : words()) {
            const std::string part = word.text;
            for (std::size_t at = text.find(part); at != std::string::npos;
                 at = text.find(part, at + 1)) {
                const std::size_t end = at + part.size();
                const bool startsWord = at == 0 || !isLetter(at - 1);
                // A short word stands alone: TAP is no tape, and HIP no ship.
                constexpr std::size_t shortWord = 3;
                const bool isAlone = startsWord && !isLetter(end);
                // How the patient lies: "HEAD FIRST SUPINE".
                const bool isPosition = text.compare(end, 6, " FIRST") == 0;
                const bool isNamed =
                    part.size() <= shortWord && part != "ABD" ? isAlone : isCode || startsWord;
                if (isNamed && !isPosition)
                    regions.insert(word.regions.begin(), word.regions.end());
            }
        }
    };
    find(upper(bodyPart), true);
    find(upper(description), false);
    return regions;
}

BodyRegion regionFromName(const std::string &name) {
    std::string valid;
    for (const auto &[text, region] : names) {
        if (name == text)
            return region;
        valid += (valid.empty() ? "" : ", ") + std::string(text);
    }
    throw task::Error(task::ErrorCode::usage, task::because::isNoneOf(name, valid));
}

const char *regionName(BodyRegion region) {
    for (const auto &[text, named] : names)
        if (named == region)
            return text;
    return "";
}

bool isFor(const Preset &preset, const StudyTraits &traits) {
    if (preset.needsContrast && !traits.hasContrast)
        return false;
    return preset.regions.empty() || traits.regions.empty() ||
           std::any_of(preset.regions.begin(), preset.regions.end(),
                       [&](BodyRegion region) { return traits.regions.contains(region); });
}

} // namespace pellucid::presets
