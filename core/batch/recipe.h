// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/dicom/catalogue.h"
#include "core/error/checked_pictures.h"
#include "core/presets/preset.h"
#include "core/scene/projection_matrix.h"
#include "core/scene/scene.h"

namespace pellucid::batch {

/// Which series of a study is rendered. A condition that is empty holds for every series.
struct SeriesChoice {
    std::vector<std::string> modalities;          ///< one of them
    std::string description;                      ///< with the wildcards * and ?, whatever the case
    std::optional<std::array<double, 2>> sliceMm; ///< thinnest and thickest distance of slices
    int minSlices = 2;
    bool operator==(const SeriesChoice &) const = default;
};

enum class Format { png, png16, npy, nrrd, capture, captureLoop, video };

/// The extent that fills a picture: the whole volume from every side, or the body from its views.
enum class Fit { volume, body };

/// What is made of a series: pictures of one look from some directions, in one format.
struct Output {
    std::string name; ///< of its files, without the suffix
    Format format = Format::png;
    /// Where the scene starts from; of its camera, the orientation and the size count.
    std::optional<scene::Scene> scene;
    std::optional<presets::Preset> look; ///< replaces the look and the shading of the scene
    bool isWithoutCouch = false;         ///< of CT: only the patient is shown
    std::vector<scene::ViewList::View> views;
    bool isTurn = false; ///< the views are one turn about the patient's long axis
    std::optional<std::array<int, 2>> size;
    std::optional<double> pixelMm;
    Fit fit = Fit::volume;
    std::optional<double> tolerance;
    error::CheckedPictures check = error::CheckedPictures::rest;
    bool isDeidentified = false; ///< `capture` and `captureLoop`

    /// Whether each view has a file of its own.
    bool hasFileForEachView() const;
};

/// Standard projections of many studies: which series, and what is made of it.
struct Recipe {
    SeriesChoice series;
    std::vector<Output> outputs;
    /// Digest of all inputs of the results, also of the presets and scenes that it names.
    std::string digest;
};

inline constexpr int maxTurnViews = 3600;
inline constexpr std::uintmax_t maxRecipeBytes = std::uintmax_t(16) << 20;

/// Reads a recipe. Presets, scenes and lists of views that it names are read, too: presets by name
/// from the library, files relative to `folder`. *Throws* Error{unusable} with the line and the
/// reason.
Recipe recipeFromJson(const std::string &text, const std::filesystem::path &folder);
/// The same of a file, which the error names.
Recipe readRecipe(const std::filesystem::path &path);

/// A recipe that makes the same picture of other studies: from the direction of a scene, with its
/// quality and contrast, and this look. `turn`: the number of views of a turntable; 0: none.
std::string recipeOf(const scene::Scene &scene, const presets::Preset &look, Format format,
                     int turn, bool isDeidentified);

/// The file names of an output, in the order of its views.
std::vector<std::string> filesOf(const Output &output);

/// The scene of an output for a volume; its camera is that of the first view. *Throws* Error{usage}
/// if the volume needs a larger picture than there can be, or as scene::validate.
scene::Scene sceneOf(const Output &output, const volume::Volume &volume);
/// The cameras of all views; they have one size, and one size of a pixel. *Requires*, if the output
/// fits the body: `scene.tone.exposure` is that of the study.
std::vector<scene::Camera> camerasOf(const Output &output, const scene::Scene &scene,
                                     const volume::Lattice &patient);

/// The volume of a study with the most slices, among those that the choice holds for. *Throws*
/// Error{unusable} with the reason if there is none.
dicom::Selection choose(const SeriesChoice &choice, const dicom::Patient &patient,
                        const dicom::Study &study);

/// One line for the series, and one for each output.
std::vector<std::string> explained(const Recipe &recipe);

} // namespace pellucid::batch
