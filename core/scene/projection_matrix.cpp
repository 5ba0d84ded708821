// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/projection_matrix.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/scene/reasons.h"
#include "core/task/error.h"

namespace pellucid::scene {

namespace {

namespace because = task::because;

[[noreturn]] void refuse(const task::Reason &what) {
    throw task::Error(task::ErrorCode::usage, what);
}

// The gradients of column and row, and what they are at the origin.
struct Rows {
    glm::dvec3 column, row;
    double columnAtOrigin = 0.0, rowAtOrigin = 0.0;
};

Rows rowsOf(const ProjectionMatrix &matrix) {
    for (const auto &row : matrix)
        if (!std::all_of(row.begin(), row.end(), [](double n) { return std::isfinite(n); }))
            refuse(because::matrixIsNotParallel);
    const auto &[x, y, z, w] = matrix[2];
    const double steepest = std::max({std::abs(x), std::abs(y), std::abs(z)});
    // A metre away, the scale has changed by less than a millionth.
    constexpr double perMm = 1e-9;
    if (w == 0.0 || steepest > perMm * std::abs(w))
        refuse(because::matrixIsNotParallel);
    const auto scaled = [w = w](const std::array<double, 4> &row) {
        return glm::dvec3(row[0], row[1], row[2]) / w;
    };
    const Rows rows{scaled(matrix[0]), scaled(matrix[1]), matrix[0][3] / w, matrix[1][3] / w};
    // Matrices are written with six digits and more.
    constexpr double tolerance = 1e-4;
    const double a = glm::length(rows.column), b = glm::length(rows.row);
    const bool isSquare = a > 0.0 && b > 0.0 && std::isfinite(1.0 / a) &&
                          std::abs(a - b) <= tolerance * a &&
                          std::abs(glm::dot(rows.column, rows.row)) <= tolerance * a * b;
    if (!isSquare)
        refuse(because::pixelsOfMatrixAreNotSquare);
    return rows;
}

// The middle of the volume, where a camera without pan looks at.
glm::dvec3 middleOf(const volume::Lattice &patient) {
    return patient.center().mm;
}

} // namespace

ProjectionMatrix projectionMatrix(const Camera &camera, const volume::Lattice &patient) {
    const glm::dmat3 axes = camera.axes();
    const glm::dvec3 middle =
        middleOf(patient) + camera.panMm.x * axes[0] + camera.panMm.y * axes[1];
    const glm::dvec3 column = axes[0] / camera.pixelMm, row = -axes[1] / camera.pixelMm;
    return {{{column.x, column.y, column.z, 0.5 * (camera.width - 1) - glm::dot(column, middle)},
             {row.x, row.y, row.z, 0.5 * (camera.height - 1) - glm::dot(row, middle)},
             {0.0, 0.0, 0.0, 1.0}}};
}

double pixelMmOf(const ProjectionMatrix &matrix) {
    const Rows rows = rowsOf(matrix);
    return 2.0 / (glm::length(rows.column) + glm::length(rows.row));
}

Camera cameraOf(const ProjectionMatrix &matrix, int width, int height,
                const volume::Lattice &patient) {
    const Rows rows = rowsOf(matrix);
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.pixelMm = pixelMmOf(matrix);
    // The nearest orthogonal axes: neither of the two is preferred.
    const glm::dvec3 a = glm::normalize(rows.column), b = glm::normalize(rows.row);
    const glm::dvec3 sum = glm::normalize(a + b), difference = glm::normalize(a - b);
    const glm::dvec3 right = glm::normalize(sum + difference),
                     up = glm::normalize(difference - sum);
    camera.orientation = glm::normalize(
        glm::quat_cast(glm::dmat3(right, up, glm::normalize(glm::cross(right, up)))));
    const glm::dvec3 middle = middleOf(patient);
    const double column = glm::dot(rows.column, middle) + rows.columnAtOrigin,
                 row = glm::dot(rows.row, middle) + rows.rowAtOrigin;
    camera.panMm = {(0.5 * (width - 1) - column) * camera.pixelMm,
                    (row - 0.5 * (height - 1)) * camera.pixelMm};
    return camera;
}

void agreeOnPixel(ViewList &list) {
    constexpr double rounding = 1e-4; // matrices are written with six digits and more
    for (const ViewList::View &view : list.views) {
        if (!view.matrix)
            continue;
        const double here = pixelMmOf(*view.matrix);
        if (list.pixelMm && std::abs(here - *list.pixelMm) > rounding * *list.pixelMm)
            refuse(because::pixelsOfViewsDiffer);
        if (!list.pixelMm)
            list.pixelMm = here;
    }
}

Camera cameraOf(const ViewList::View &view, const Camera &base, const volume::Lattice &patient) {
    if (view.matrix)
        return cameraOf(*view.matrix, base.width, base.height, patient);
    Camera camera = base;
    camera.orientation = *view.orientation;
    return camera;
}

} // namespace pellucid::scene
