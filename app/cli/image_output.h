// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/dicom/write_capture.h"
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

/// How a picture was derived, for its Derivation Description. `predictedError`: relative L2.
std::string derivationText(double predictedError);

/// OUT_0007.png for frame 7.
std::filesystem::path framePath(const std::filesystem::path &out, int frame);

/// The file beside an array of views that describes them.
std::filesystem::path geometryPath(const std::filesystem::path &array);
/// Where a view was seen from: its projection matrix, its angles as of DICOM's positioner, the
/// directions of its axes, and its predicted error (relative L2). *Shape*: `patient`: that of the
/// volume.
nlohmann::json geometryJson(const scene::Camera &camera, const volume::Lattice &patient,
                            double predictedError);
/// Describes views that have one size, and one size of a pixel. *Throws* Error{output}.
void writeGeometry(const std::filesystem::path &path, const scene::Camera &camera,
                   const nlohmann::json &views);

} // namespace pellucid::cli
