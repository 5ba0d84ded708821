// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/scene_fields.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/preprocess/step_cache.h"

namespace pellucid::cli {

namespace {

// A picture needs each step once, but two classes may share one.
constexpr std::size_t budgetOfSteps = std::size_t(1) << 30;

bool isEmpty(const classify::DensityField &field) {
    return field.support.size().count() == 1 && field.values.value(field.support.lo) == 0.0;
}

} // namespace

classify::FieldWindow windowFor(const scene::Scene &scene, const volume::Volume &volume) {
    return scene.fieldWindow.value_or(classify::defaultFieldWindow(volume));
}

classify::ShownFields fieldsFor(const scene::Scene &scene, const volume::Volume &volume,
                                const std::shared_ptr<const segment::SegmentSet> &segments,
                                const Context &context) {
    preprocess::StepCache steps(budgetOfSteps);
    preprocess::ClassRunner runner(steps, segments);
    return classify::cropped(classify::shownFields(volume, windowFor(scene, volume), scene.look,
                                                   &runner, task::Progress(context.stop)),
                             scene.crop);
}

std::vector<std::string> lookWarnings(const CLI::App &command,
                                      const std::optional<presets::Preset> &preset,
                                      const scene::Scene &scene, const volume::Volume &volume) {
    std::vector<std::string> warnings;
    const bool hasClasses = !scene.look.classes.empty();
    const auto isGiven = [&](const char *option) { return command.count(option) > 0; };
    if (hasClasses && isGiven("--bezier"))
        warnings.emplace_back("--bezier has no effect together with --class");
    if (isGiven("--preset") && (isGiven("--class") || isGiven("--bezier")))
        warnings.emplace_back(
            "--class or --bezier replaces the preset's look; its window and lights are kept");
    if (isGiven("--class") && volume.unit() != volume::ValueUnit::hounsfield)
        warnings.emplace_back(
            "the ranges of --class are in Hounsfield units, but the values may not be in HU");
    if (preset)
        if (const auto why = presets::mismatch(*preset, volume))
            warnings.push_back(why->english());
    return warnings;
}

std::string whyEmpty(const scene::Scene &scene, const volume::Volume &volume,
                     const classify::ShownFields &fields) {
    if (!std::all_of(fields.channels.begin(), fields.channels.end(), isEmpty))
        return {};
    if (!scene.look.classes.empty())
        return "the field is empty: no value is in a shown class";
    const classify::FieldWindow window = windowFor(scene, volume);
    return fmt::format("the field is empty: no value is above {} in the window from {} to {}",
                       window.low, window.low, window.high);
}

} // namespace pellucid::cli
