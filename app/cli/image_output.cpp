// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/image_output.h"

#include <fmt/format.h>

#include "app/cli/json_text.h"
#include "core/files/atomic_file.h"
#include "core/files/image_files.h"
#include "core/picture/compose.h"
#include "core/picture/projection_volume.h"
#include "core/scene/positioner_angles.h"
#include "core/scene/projection_matrix.h"
#include "core/task/error.h"
#include "core/task/reasons.h"
#include "core/volume/nrrd.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

enum class OutputKind { png, npy, nrrd, capture };

OutputKind outputKind(const fs::path &out) {
    const std::string suffix = out.extension().string();
    if (suffix == ".png")
        return OutputKind::png;
    if (suffix == ".npy")
        return OutputKind::npy;
    if (suffix == ".nrrd")
        return OutputKind::nrrd;
    if (suffix == ".dcm")
        return OutputKind::capture;
    throw Error(ErrorCode::usage, because::inWords("-o: '" + out.string() +
                                                   "' must end in .png, .npy, .nrrd or .dcm"));
}

} // namespace

void checkOutput(const fs::path &out, bool isGrey) {
    if (outputKind(out) == OutputKind::nrrd && !isGrey)
        throw Error(ErrorCode::usage,
                    because::inWords("-o: colored pictures are written as .png, .npy or .dcm"));
}

bool isDisplayed(const fs::path &out) {
    const OutputKind kind = outputKind(out);
    return kind == OutputKind::png || kind == OutputKind::capture;
}

void writeImage(const fs::path &path, const picture::ProjectionImage &image,
                const scene::Scene &scene, const volume::Lattice &patient,
                const dicom::CaptureLabels &labels) {
    const auto shown = [&] {
        return picture::compose(image, picture::displayOf(scene.tone, scene.camera.orientation));
    };
    switch (outputKind(path)) {
    case OutputKind::png:
        files::writePng(path, shown(), image.height, image.width);
        break;
    case OutputKind::npy:
        files::writeNpy(path, image.samples, image.height, image.width, image.channels);
        break;
    case OutputKind::capture: {
        dicom::CaptureLabels of = labels;
        of.pixelMm = scene.camera.pixelMm;
        of.patientOrientation =
            scene::dicomOrientation(scene.camera.axes()[0], scene.camera.axes()[1]);
        const scene::PositionerAngles angles = scene::positionerAngles(scene.camera.orientation);
        of.positionerDeg = {angles.primaryDeg, angles.secondaryDeg};
        dicom::writeCapture(path, shown(), image.height, image.width, of);
        break;
    }
    case OutputKind::nrrd:
        volume::writeNrrd(path, picture::projectionVolume(image, scene.camera, patient));
        break;
    }
}

std::string errorText(const error::StatedError &error) {
    return error.isMeasured() ? fmt::format("error {:.2g}, measured", error.relative)
                              : fmt::format("error at most {:.2g}", error.relative);
}

std::string derivationText(const error::StatedError &error) {
    return fmt::format("{}, {} (relative L2)", dicom::CaptureLabels().derivation, errorText(error));
}

nlohmann::json measuredJson(const std::optional<error::StatedError> &error) {
    if (!error || !error->isMeasured())
        return nullptr;
    return {{"relative_l2", error->relative},
            {"low", error->low},
            {"high", error->high},
            {"frequencies", error->frequencies}};
}

fs::path framePath(const fs::path &out, int frame) {
    return out.parent_path() /
           fmt::format("{}_{:04d}{}", out.stem().string(), frame, out.extension().string());
}

fs::path geometryPath(const fs::path &array) {
    fs::path path = array;
    return path.replace_extension(".json");
}

nlohmann::json geometryJson(const scene::Camera &camera, const volume::Lattice &patient,
                            const error::StatedError &error) {
    const scene::PositionerAngles angles = scene::positionerAngles(camera.orientation);
    const glm::dmat3 axes = camera.axes();
    const auto list = [](const glm::dvec3 &v) { return nlohmann::json{v.x, v.y, v.z}; };
    return {
        {"matrix", scene::projectionMatrix(camera, patient)},
        {"primary_deg", angles.primaryDeg},
        {"secondary_deg", angles.secondaryDeg},
        {"right", list(axes[0])},
        {"down", list(-axes[1])},
        {"toward_viewer", list(axes[2])},
        {"predicted_error", error.isMeasured() ? nlohmann::json() : nlohmann::json(error.relative)},
        {"measured_error", measuredJson(error)}};
}

void writeGeometry(const fs::path &path, const scene::Camera &camera, const nlohmann::json &views) {
    files::AtomicFile file(path);
    file.write(jsonText({{"geometry", "parallel"},
                         {"space", "DICOM patient space (LPS), mm"},
                         {"matrix", "(x, y, z, 1) to (column, row, 1); whole numbers are centers "
                                    "of pixels"},
                         {"values", "line integrals, field times mm"},
                         {"size", {camera.width, camera.height}},
                         {"pixel_mm", camera.pixelMm},
                         {"views", views}}) +
               "\n");
    file.commit();
}

} // namespace pellucid::cli
