// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/scene_fields.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/preprocess/step_cache.h"

namespace pellucid::cli {

namespace {

// A picture asks for each step once; two classes may share one.
constexpr std::size_t budgetOfSteps = std::size_t(1) << 30;

bool isEmpty(const classify::DensityField &field) {
    return field.support.size().count() == 1 && field.values.value(field.support.lo) == 0.0;
}

} // namespace

classify::FieldWindow windowFor(const scene::Scene &scene, const volume::Volume &volume) {
    return scene.fieldWindow.value_or(classify::defaultFieldWindow(volume));
}

classify::ShownFields fieldsFor(const scene::Scene &scene, const volume::Volume &volume,
                                const Context &context) {
    preprocess::StepCache steps(budgetOfSteps);
    return classify::cropped(classify::shownFields(volume, windowFor(scene, volume), scene.look,
                                                   &steps, task::Progress(context.stop)),
                             scene.crop);
}

std::vector<std::string> lookWarnings(const CLI::App &command,
                                      const std::optional<presets::Preset> &preset,
                                      const scene::Scene &scene, const volume::Volume &volume) {
    std::vector<std::string> warnings;
    const bool hasClasses = !scene.look.classes.empty();
    const auto isGiven = [&](const char *option) { return command.count(option) > 0; };
    if (hasClasses && isGiven("--bezier"))
        warnings.emplace_back("--bezier weighs the whole volume; beside --class it is not seen");
    if (isGiven("--preset") && (isGiven("--class") || isGiven("--bezier")))
        warnings.emplace_back(
            "what is shown is --class or --bezier; of the preset its window and light are left");
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
        return "the field is empty: no value belongs to a class that is shown";
    const classify::FieldWindow window = windowFor(scene, volume);
    return fmt::format("the field is empty: no value lies above {} within a window of {} to {}",
                       window.low, window.low, window.high);
}

} // namespace pellucid::cli
