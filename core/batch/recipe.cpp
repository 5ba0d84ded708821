// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/batch/recipe.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/batch/reasons.h"
#include "core/classify/couch.h"
#include "core/scene/positioner_angles.h"
#include "core/scene/reasons.h"
#include "core/system/text.h"
#include "core/task/error.h"

namespace pellucid::batch {

namespace {

namespace because = task::because;

struct FormatFacts {
    const char *suffix, *words;
    bool isOneFile; ///< for all views
};
FormatFacts factsOf(Format format) {
    switch (format) {
    case Format::png:
        return {".png", "a picture (PNG)", false};
    case Format::png16:
        return {".png", "a picture in 16 bits of grey (PNG)", false};
    case Format::npy:
        return {".npy", "values (NumPy)", true};
    case Format::nrrd:
        return {".nrrd", "values (NRRD)", false};
    case Format::capture:
        return {".dcm", "a DICOM Secondary Capture", false};
    case Format::captureLoop:
        return {".dcm", "a DICOM Multi-frame Secondary Capture", true};
    case Format::video:
        return {".mp4", "a video (MP4)", true};
    }
    return {};
}

// Whether a text matches a pattern, in which * stands for any bytes and ? for one. On a mismatch,
// the last * takes one byte more: no combination is tried twice.
bool matches(std::string_view pattern, std::string_view text) {
    std::size_t p = 0, star = std::string_view::npos, resumed = 0;
    for (std::size_t t = 0; t < text.size();) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resumed = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++resumed;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool holds(const SeriesChoice &choice, const dicom::Series &series,
           const dicom::VolumeEntry &volume) {
    const volume::Lattice &lattice = volume.geometry.lattice;
    if (!volume.placed || volume.notes.isLocalizer || volume.fillsHoles ||
        lattice.size().k < choice.minSlices)
        return false;
    const auto &modalities = choice.modalities;
    if (!modalities.empty() &&
        std::find(modalities.begin(), modalities.end(), series.modality) == modalities.end())
        return false;
    if (!choice.description.empty() &&
        !matches(system::lowered(choice.description), system::lowered(series.description)))
        return false;
    constexpr double rounding = 1e-3; // mm, of written positions
    const double distance = lattice.sliceDistanceMm();
    return !choice.sliceMm || (distance >= (*choice.sliceMm)[0] - rounding &&
                               distance <= (*choice.sliceMm)[1] + rounding);
}

int smallestSide(const scene::Camera &camera) {
    return std::min(camera.width, camera.height);
}

} // namespace

bool Output::hasFileForEachView() const {
    return views.size() > 1 && !factsOf(format).isOneFile;
}

std::vector<std::string> filesOf(const Output &output) {
    const FormatFacts facts = factsOf(output.format);
    if (!output.hasFileForEachView())
        return {output.name + facts.suffix};
    std::vector<std::string> names;
    for (std::size_t n = 0; n < output.views.size(); ++n)
        names.push_back(fmt::format("{}_{:04d}{}", output.name, n, facts.suffix));
    return names;
}

scene::Scene sceneOf(const Output &output, const volume::Volume &volume) {
    const volume::Lattice &lattice = volume.lattice();
    scene::Scene scene = output.scene.value_or(scene::Scene());
    if (!output.scene)
        scene.image.detailMm = scene::defaultDetailMm(lattice.radiusMm());
    if (output.look) {
        scene.fieldWindow = output.look->window;
        scene.look = presets::lookFor(
            *output.look, scene.fieldWindow.value_or(classify::defaultFieldWindow(volume)));
        scene.shading = output.look->shading;
    }
    if (output.isWithoutCouch && volume.unit() == volume::ValueUnit::hounsfield)
        classify::removeCouch(scene.look,
                              scene.fieldWindow.value_or(classify::defaultFieldWindow(volume)));
    if (output.tolerance)
        scene.tolerance = *output.tolerance;
    scene::Camera camera;
    if (!output.size && !output.pixelMm) {
        camera = scene::defaultCamera(lattice);
    } else {
        const double across = 2.0 * lattice.radiusMm();
        if (output.size) {
            camera.width = (*output.size)[0];
            camera.height = (*output.size)[1];
        } else {
            const double side = across / *output.pixelMm;
            if (side > scene::largestImageSize)
                throw task::Error(
                    task::ErrorCode::usage,
                    because::volumeNeedsALargerImage(scene::largestImageSize,
                                                     fmt::format("{:.3g}", *output.pixelMm)));
            camera.width = camera.height = scene::evenPixels(side);
        }
        // The whole volume from every side.
        camera.pixelMm = output.pixelMm.value_or(across / smallestSide(camera));
    }
    scene.camera = scene::cameraOf(output.views.front(), camera, lattice);
    scene::validate(scene);
    return scene;
}

std::vector<scene::Camera> camerasOf(const Output &output, const scene::Scene &scene,
                                     const volume::Lattice &patient) {
    scene::Camera base = scene.camera;
    base.panMm = {};
    std::vector<scene::Camera> cameras;
    for (const scene::ViewList::View &view : output.views)
        cameras.push_back(scene::cameraOf(view, base, patient));
    if (output.fit == Fit::body && scene.tone.exposure)
        scene::fitToBox(cameras, scene.tone.exposure->lowMm, scene.tone.exposure->highMm,
                        output.size ? scene::FitBy::pixel : scene::FitBy::size);
    return cameras;
}

dicom::Selection choose(const SeriesChoice &choice, const dicom::Patient &patient,
                        const dicom::Study &study) {
    dicom::Selection chosen;
    for (const dicom::Series &series : study.series)
        for (const dicom::VolumeEntry &volume : series.volumes) {
            if (!holds(choice, series, volume))
                continue;
            // Of equals, the same whatever the order of the files.
            const auto comesBefore = [](const dicom::Selection &a, const dicom::Selection &b) {
                const int slicesOfA = a.volume->geometry.lattice.size().k,
                          slicesOfB = b.volume->geometry.lattice.size().k;
                return slicesOfA != slicesOfB ? slicesOfA > slicesOfB
                                              : a.series->uid < b.series->uid;
            };
            const dicom::Selection candidate{&patient, &study, &series, &volume};
            if (chosen.volume == nullptr || comesBefore(candidate, chosen))
                chosen = candidate;
        }
    if (chosen.volume == nullptr)
        throw task::Error(task::ErrorCode::unusable, because::noSeriesIsChosen);
    return chosen;
}

std::vector<std::string> explained(const Recipe &recipe) {
    std::string series = "of each study, the volume with the most slices";
    const SeriesChoice &choice = recipe.series;
    if (!choice.modalities.empty()) {
        series += ", of modality";
        for (std::size_t n = 0; n < choice.modalities.size(); ++n)
            series += (n == 0 ? " " : " or ") + choice.modalities[n];
    }
    if (!choice.description.empty())
        series += fmt::format(", described as '{}'", choice.description);
    if (choice.sliceMm)
        series += fmt::format(", with slices {:g} to {:g} mm apart", (*choice.sliceMm)[0],
                              (*choice.sliceMm)[1]);
    series += fmt::format(", with at least {} slices", choice.minSlices);
    std::vector<std::string> lines{series};
    for (const Output &output : recipe.outputs) {
        const std::size_t views = output.views.size();
        const std::vector<std::string> files = filesOf(output);
        std::string line = files.front();
        if (files.size() > 1)
            line += " .. " + files.back();
        line += fmt::format(": {}", factsOf(output.format).words);
        line += output.isTurn ? fmt::format(", {} views of one turn", views)
                : views > 1   ? fmt::format(", {} views", views)
                : output.views.front().orientation
                    ? ", from " + scene::positionerText(
                                      scene::positionerAngles(*output.views.front().orientation))
                    : ", by a matrix";
        if (output.look)
            line += fmt::format(", look '{}'", output.look->name);
        else if (output.scene)
            line += ", of a scene";
        if (output.isWithoutCouch)
            line += ", without the couch";
        if (output.size)
            line += fmt::format(", {} x {} pixels", (*output.size)[0], (*output.size)[1]);
        if (output.pixelMm)
            line += fmt::format(", {:g} mm a pixel", *output.pixelMm);
        if (output.fit == Fit::body)
            line += ", fits the body";
        line +=
            fmt::format(", error at most {:g}",
                        output.tolerance.value_or(output.scene.value_or(scene::Scene()).tolerance));
        if (output.isDeidentified)
            line += ", without the patient's identity";
        lines.push_back(line);
    }
    return lines;
}

} // namespace pellucid::batch
