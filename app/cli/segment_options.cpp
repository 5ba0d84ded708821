// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/segment_options.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "app/cli/input.h"
#include "app/cli/scene_options.h"
#include "app/cli/terminal.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/files/file_ids.h"
#include "core/preprocess/segment_class.h"
#include "core/task/error.h"
#include "core/task/reasons.h"
#include "core/volume/volume_file.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

// Whether a name has a pattern, in which '*' stands for any characters.
bool matches(std::string_view pattern, std::string_view name) {
    const auto star = pattern.find('*');
    if (star == std::string_view::npos)
        return pattern == name;
    if (name.substr(0, star) != pattern.substr(0, star) || name.size() < star)
        return false;
    const std::string_view rest = pattern.substr(star + 1);
    for (std::size_t at = star; at <= name.size(); ++at)
        if (matches(rest, name.substr(at)))
            return true;
    return false;
}

[[noreturn]] void failUnknown(const std::string &name, const segment::SegmentSet &segments) {
    constexpr std::size_t maxNamed = 20;
    std::string names;
    std::size_t count = 0;
    for (const segment::Segmentation &segmentation : segments.segmentations())
        for (const segment::Segment &segment : segmentation.segments)
            if (count++ < maxNamed)
                names += (names.empty() ? "" : ", ") + segment.name;
    if (count > maxNamed)
        names += fmt::format(" and {} more", count - maxNamed);
    throw Error(ErrorCode::usage,
                because::inWords("--segment: no segment '" + name + "'; there are: " + names));
}

} // namespace

WeightedName parseWeightedName(const std::string &option, const std::string &text, Weight weight) {
    WeightedName parsed{text, 1.0, std::nullopt};
    // From the end, because a name may contain the same characters.
    if (const auto colon = text.rfind(":#"); colon != std::string::npos) {
        parsed.color = classify::colorFromText(text.substr(colon + 1));
        parsed.name.resize(colon);
    }
    const auto equals = parsed.name.rfind('=');
    if (equals == 0 || (equals == std::string::npos && weight == Weight::required))
        throw Error(ErrorCode::usage,
                    because::inWords(option + ": '" + text + "' is not NAME=WEIGHT[:#rrggbb]"));
    if (equals != std::string::npos) {
        parsed.weight = parseNumbers(option, parsed.name.substr(equals + 1), ',', 1).front();
        parsed.name.resize(equals);
    }
    return parsed;
}

std::shared_ptr<const segment::SegmentSet> loadSegments(const std::vector<std::string> &files,
                                                        const std::vector<fs::path> &outs,
                                                        const volume::Volume &volume,
                                                        const Context &context) {
    if (files.empty())
        return nullptr;
    auto segments =
        std::shared_ptr<const segment::SegmentSet>(new segment::SegmentSet(volume.lattice()));
    const files::FileIds outputs(outs);
    std::set<fs::path> read;
    for (const std::string &file : files) {
        std::error_code unknown;
        if (!read.insert(fs::weakly_canonical(file, unknown)).second)
            throw Error(ErrorCode::usage, because::inWords("--segmentation: is given twice"), file);
        const fs::path samples = volume::isVolumeFile(file)
                                     ? decoding::readVolumeFileHeader(file).samplesFile
                                     : fs::path(file);
        for (const fs::path &input : {fs::path(file), samples})
            if (const auto out = outputs.find(input))
                throw Error(ErrorCode::usage,
                            because::inWords("-o: is one of the files that are read"), *out);
        segment::Segmentation loaded =
            segment::loadSegmentation(file, volume, task::Progress(context.stop));
        for (const task::Reason &warning : loaded.warnings)
            warn(file + ": " + warning.english());
        segments = segments->with(std::move(loaded));
    }
    return segments;
}

void showSegments(classify::Look &look, const SceneOptions &options,
                  const segment::SegmentSet &segments) {
    const bool hasSegments =
        std::any_of(look.classes.begin(), look.classes.end(),
                    [](const classify::TissueClass &tissue) { return !tissue.segment.empty(); });
    if (options.segments.empty() && hasSegments)
        return;
    const auto add = [&](classify::TissueClass tissue) {
        const auto present =
            std::find_if(look.classes.begin(), look.classes.end(), [&](const auto &other) {
                return !tissue.segment.empty() && other.segment == tissue.segment;
            });
        if (present == look.classes.end())
            classify::addClass(look, std::move(tissue));
        else
            *present = std::move(tissue);
    };
    const auto showMatching = [&](const WeightedName &wanted) {
        bool isFound = false;
        std::size_t index = 0;
        for (const segment::Segmentation &segmentation : segments.segmentations())
            for (const segment::Segment &segment : segmentation.segments) {
                classify::TissueClass tissue = preprocess::classOf(segment, index++);
                if (segment.name != wanted.name && !matches(wanted.name, segment.name))
                    continue;
                isFound = true;
                tissue.weight = wanted.weight;
                tissue.color = wanted.color.value_or(tissue.color);
                add(std::move(tissue));
            }
        if (!isFound)
            failUnknown(wanted.name, segments);
    };
    if (options.segments.empty())
        showMatching({"*", 1.0, std::nullopt});
    for (const std::string &text : options.segments)
        showMatching(segments.find(text) != nullptr
                         ? WeightedName{text, 1.0, std::nullopt}
                         : parseWeightedName("--segment", text, Weight::optional));
    classify::validate(look);
}

} // namespace pellucid::cli
