// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/classify/crop_box.h"
#include "core/classify/density_field.h"
#include "core/classify/look.h"
#include "core/fourier/kernels/kernel.h"
#include "core/fourier/storage.h"
#include "core/scene/camera.h"
#include "core/scene/image_definition.h"
#include "core/scene/tone.h"
#include "core/shading/shading.h"

namespace pellucid::scene {

/// The choices of the user about storage and interpolation of the spectrum. The planner makes those
/// that are absent.
struct Interpolation {
    std::optional<fourier::KernelChoice> kernel;
    /// Padded size over field size, 1 to 4, the same on every axis.
    std::optional<double> padding;
    std::optional<fourier::Storage> storage;
    /// Reads every frequency of a picture with the same kernel, even where the tolerance would
    /// allow a narrower one or none.
    bool isUniform = false;
    /// Whether the planner makes every choice that the tolerance depends on.
    bool isPlanned() const { return !kernel && !padding && !storage; }
    bool operator==(const Interpolation &) const = default;
};

/// What an engine is planned for: a single picture, or the whole volume from any direction, as in
/// the workstation, where the user turns it.
enum class PlannedFor { picture, volume };

/// The user's request: what to show, and how. A plain value that the window, the command line and
/// the tests share.
struct Scene {
    Camera camera;
    /// The field's window; the volume's default if absent.
    std::optional<classify::FieldWindow> fieldWindow;
    classify::Look look;
    classify::CropBox crop;
    shading::Shading shading;
    ImageDefinition image;
    /// Largest relative L2 error of the float image.
    double tolerance = 1.1e-3;
    Interpolation interpolation;
    PlannedFor plannedFor = PlannedFor::picture;
    Tone tone;
    /// It shows a difference of volumes: its look means nothing for one of them alone. Set in
    /// files.
    bool isOfDifference = false;

    bool operator==(const Scene &) const = default;
};

/// The named tolerances; `reference` is as exact as double precision allows.
struct NamedTolerance {
    const char *name;
    double tolerance;
};
inline constexpr double referenceTolerance = 1e-10;
inline constexpr std::array<NamedTolerance, 5> namedTolerances{{{"draft", 3e-2},
                                                                {"interactive", 1e-2},
                                                                {"standard", 1.1e-3},
                                                                {"fine", 1e-4},
                                                                {"reference", referenceTolerance}}};

/// *Throws* Error{usage} if a value is out of range; the reason names the value.
void validate(const Scene &scene);
void validate(const Exposure &exposure);

/// The scene as JSON, `"schema": "pellucid-scene/3"`.
std::string toJson(const Scene &scene);
/// *Throws* Error{usage}; the reason contains the JSON pointer of the value.
Scene sceneFromJson(const std::string &text);

} // namespace pellucid::scene
