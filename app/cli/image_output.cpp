// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/image_output.h"

#include <fmt/format.h>

#include "core/files/image_files.h"
#include "core/render/compose.h"
#include "core/task/error.h"
#include "core/volume/nrrd.h"

namespace pellucid::cli {

namespace {

namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

enum class OutputKind { png, npy, nrrd };

OutputKind outputKind(const fs::path &out) {
    const std::string suffix = out.extension().string();
    if (suffix == ".png")
        return OutputKind::png;
    if (suffix == ".npy")
        return OutputKind::npy;
    if (suffix == ".nrrd")
        return OutputKind::nrrd;
    if (suffix == ".dcm")
        throw Error(ErrorCode::usage,
                    "-o: writing Secondary Captures (.dcm) is not available in this version");
    throw Error(ErrorCode::usage, "-o: '" + out.string() + "' must end in .png, .npy or .nrrd");
}

// The projection as a flat volume that lies in the patient where the picture plane does.
void writeImageNrrd(const fs::path &path, const render::ProjectionImage &image,
                    const render::Camera &camera, const volume::Lattice &patient) {
    const glm::dmat3 axes = camera.axes();
    const glm::dvec3 right = camera.pixelMm * axes[0], down = -camera.pixelMm * axes[1];
    const glm::dvec3 center =
        patient.center().mm + camera.panMm.x * axes[0] + camera.panMm.y * axes[1];
    const glm::dvec3 origin =
        center - 0.5 * (camera.width - 1) * right - 0.5 * (camera.height - 1) * down;
    const auto lattice = volume::Lattice::make({image.width, image.height, 1}, {origin},
                                               {right, down, -camera.pixelMm * axes[2]});
    volume::writeNrrd(path, volume::Volume(lattice, image.samples, volume::ValueUnit::none));
}

} // namespace

void checkOutput(const fs::path &out, bool isGrey) {
    if (outputKind(out) == OutputKind::nrrd && !isGrey)
        throw Error(ErrorCode::usage, "-o: coloured pictures are written as .png or .npy");
}

void writeImage(const fs::path &path, const render::ProjectionImage &image,
                const render::Scene &scene, const volume::Lattice &patient) {
    switch (outputKind(path)) {
    case OutputKind::png:
        files::writePng(path, render::compose(image, scene.tone), image.height, image.width);
        break;
    case OutputKind::npy:
        files::writeNpy(path, image.samples, image.height, image.width, image.channels);
        break;
    case OutputKind::nrrd:
        writeImageNrrd(path, image, scene.camera, patient);
        break;
    }
}

fs::path framePath(const fs::path &out, int frame) {
    return out.parent_path() /
           fmt::format("{}_{:04d}{}", out.stem().string(), frame, out.extension().string());
}

} // namespace pellucid::cli
