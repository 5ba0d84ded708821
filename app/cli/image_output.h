// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/dicom/write_capture.h"
#include "core/error/stated_error.h"
#include "core/picture/projection_image.h"
#include "core/scene/scene.h"

namespace pellucid::cli {

/// *Throws* Error{usage} unless the path ends in .png, .npy or .dcm, or in .nrrd for a grey
/// picture.
void checkOutput(const std::filesystem::path &out, bool isGrey);

/// Whether the file shows the picture through the scene's tone, as .png and .dcm do; the others
/// hold its values.
bool isDisplayed(const std::filesystem::path &out);

/// Writes a projection: as a picture through the scene's tone, whose exposure is known, or its
/// values. `labels`: for a Secondary Capture. *Throws* Error{output}, Error{usage} for a kind that
/// cannot hold it.
void writeImage(const std::filesystem::path &path, const picture::ProjectionImage &image,
                const scene::Scene &scene, const volume::Lattice &patient,
                const dicom::CaptureLabels &labels);

/// "error 0.0003, measured", "error at most 0.0011".
std::string errorText(const error::StatedError &error);

/// How a picture was derived, for its Derivation Description.
std::string derivationText(const error::StatedError &error);
/// A measured error with its interval; null if there is none.
nlohmann::json measuredJson(const std::optional<error::StatedError> &error);

/// OUT_0007.png for frame 7.
std::filesystem::path framePath(const std::filesystem::path &out, int frame);

/// The file beside an array of views that describes them.
std::filesystem::path geometryPath(const std::filesystem::path &array);
/// Where a view was seen from: its projection matrix, its angles as of DICOM's positioner, the
/// directions of its axes, and its error (relative L2). *Shape*: `patient`: that of the
/// volume.
nlohmann::json geometryJson(const scene::Camera &camera, const volume::Lattice &patient,
                            const error::StatedError &error);
/// Describes views that have one size, and one size of a pixel. *Throws* Error{output}.
void writeGeometry(const std::filesystem::path &path, const scene::Camera &camera,
                   const nlohmann::json &views);

} // namespace pellucid::cli
