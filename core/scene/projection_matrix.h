// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/camera.h"

namespace pellucid::scene {

/// A 3x4 projection matrix, row by row: it takes (x, y, z, 1), patient space in mm (LPS), to
/// (column, row, 1) w of a picture, whose pixel centers are at whole numbers, from 0 at the upper
/// left. That of a parallel projection ends with (0, 0, 0, w).
using ProjectionMatrix = std::array<std::array<double, 4>, 3>;

/// The matrix of a camera that looks at a volume. *Shape*: `patient`: that of the volume.
ProjectionMatrix projectionMatrix(const Camera &camera, const volume::Lattice &patient);
/// The camera with this matrix, whose pictures have this size. *Throws* Error{usage} if the matrix
/// is not that of a parallel projection on square pixels.
Camera cameraOf(const ProjectionMatrix &matrix, int width, int height,
                const volume::Lattice &patient);

/// The directions from which a volume is seen, as a file lists them.
struct ViewList {
    /// One of them is set.
    struct View {
        std::optional<glm::dquat> orientation;
        std::optional<ProjectionMatrix> matrix;
        bool operator==(const View &) const = default;
    };
    std::vector<View> views;
    std::optional<std::array<int, 2>> size; ///< width and height of the pictures
    std::optional<double> pixelMm;          ///< for views without a matrix
    bool operator==(const ViewList &) const = default;
};

/// Reads `{"views": [VIEW..], "size": [W, H], "pixel_mm": P}`. A VIEW is `{"matrix": [[4], [4],
/// [4]]}`, `{"primary_deg": A, "secondary_deg": B, "roll_deg": C}` in the convention of DICOM's
/// Positioner Primary and Secondary Angle (PS3.3, C.8.7.5), or text such as "RAO30,CRA20". *Throws*
/// Error{unusable} with the line and the reason, also if matrices differ in the size of a pixel.
ViewList viewListFromJson(const std::string &text);

/// The camera of a view; `base`: size and pixel where the view has none.
Camera cameraOf(const ViewList::View &view, const Camera &base, const volume::Lattice &patient);

/// The size of a pixel in mm that a matrix has. *Throws* as cameraOf.
double pixelMmOf(const ProjectionMatrix &matrix);
/// Gives all views the pixel of the matrices among them. *Throws* Error{usage} if they differ from
/// each other or from `pixelMm`.
void agreeOnPixel(ViewList &list);

} // namespace pellucid::scene
