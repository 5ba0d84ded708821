// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/image_output.h"

#include <fmt/format.h>

#include "core/files/image_files.h"
#include "core/render/compose.h"
#include "core/render/projection_volume.h"
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
        volume::writeNrrd(path, render::projectionVolume(image, scene.camera, patient));
        break;
    }
}

fs::path framePath(const fs::path &out, int frame) {
    return out.parent_path() /
           fmt::format("{}_{:04d}{}", out.stem().string(), frame, out.extension().string());
}

} // namespace pellucid::cli
