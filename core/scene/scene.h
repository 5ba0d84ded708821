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
#include "core/shading/shading.h"

namespace pellucid::scene {

/// How the float image becomes grey: [low, high] in image units, or automatic; bright on dark, or
/// inverted like a film.
struct Tone {
    std::optional<double> low, high;
    bool inverted = false;
    bool operator==(const Tone &) const = default;
};

/// What the user fixes of how the spectrum is kept and read; what is absent the planner chooses.
struct Interpolation {
    std::optional<fourier::KernelChoice> kernel;
    /// Padded size over field size, 1 to 4, the same on every axis.
    std::optional<double> padding;
    std::optional<fourier::Storage> storage;
    /// Every frequency of a picture is read, whatever it is worth.
    bool isUniform = false;
    bool operator==(const Interpolation &) const = default;
};

/// What an engine is planned for: the picture alone, or the volume from anywhere, as the
/// workstation does, which turns it.
enum class PlannedFor { picture, volume };

/// What the user asked to see. A plain value: the window, the command line and the tests share it.
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

    bool operator==(const Scene &) const = default;
};

/// The tolerances that have a name; `reference` is as exact as double precision allows.
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

/// Throws Error{usage} if a value of the scene is out of its range; the message names it.
void validate(const Scene &scene);

/// The scene as JSON, `"schema": "pellucid-scene/2"`; version 1 is read, too.
std::string toJson(const Scene &scene);
/// *Throws* Error{usage} with the key and the reason.
Scene sceneFromJson(const std::string &text);

} // namespace pellucid::scene
