// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstddef>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace pellucid::volume {

/// No supported machine has memory for more samples.
inline constexpr std::size_t maxSamples = std::size_t(1) << 36;

/// Number of samples along the three axes: columns, rows, slices.
struct GridSize {
    int i = 0, j = 0, k = 0;
    std::size_t count() const { return std::size_t(i) * std::size_t(j) * std::size_t(k); }
    /// The index of a sample in the grid: columns are fastest, then rows, then slices.
    std::size_t offsetOf(int column, int row, int slice) const {
        return (std::size_t(slice) * std::size_t(j) + std::size_t(row)) * std::size_t(i) +
               std::size_t(column);
    }
    int operator[](int axis) const { return axis == 0 ? i : axis == 1 ? j : k; }
    bool operator==(const GridSize &) const = default;
};

/// A sample's position in the grid: column, row, slice.
struct VoxelIndex {
    int i = 0, j = 0, k = 0;
    bool operator==(const VoxelIndex &) const = default;
};

/// A position in units of samples; sample centres are at integers.
struct VoxelPoint {
    glm::dvec3 v{0.0};
};

/// A position in patient space: DICOM LPS, mm.
struct PatientPoint {
    glm::dvec3 mm{0.0};
    bool operator==(const PatientPoint &) const = default;
};

/// A box of samples, with `lo` inclusive and `hi` exclusive.
struct VoxelBox {
    VoxelIndex lo, hi;
    GridSize size() const { return {hi.i - lo.i, hi.j - lo.j, hi.k - lo.k}; }
    bool contains(VoxelIndex n) const {
        return n.i >= lo.i && n.j >= lo.j && n.k >= lo.k && n.i < hi.i && n.j < hi.j && n.k < hi.k;
    }
    bool operator==(const VoxelBox &) const = default;
};

/// The smallest box that encloses two boxes; empty boxes are ignored.
VoxelBox united(const VoxelBox &a, const VoxelBox &b);

/// The positions of a volume's samples: an origin and three steps, which may have different lengths
/// (anisotropic voxels) and need not be orthogonal (gantry tilt). Sample (i, j, k) is at origin + i
/// a_0 + j a_1 + k a_2. Only a Lattice converts between voxel and patient space.
class Lattice {
public:
    /// One sample of one cubic millimetre at the origin.
    Lattice() = default;
    /// *Units*: mm, LPS. *Throws* Error{unusable} if a size is not positive, a number is not
    /// finite, or the steps span no volume.
    static Lattice make(GridSize size, PatientPoint origin, const std::array<glm::dvec3, 3> &steps);
    /// Orthogonal axes along LPS, with the centre of the lattice at the origin of patient space.
    /// *Throws* as make.
    static Lattice centred(GridSize size, glm::dvec3 spacingMm);

    const GridSize &size() const { return m_size; }
    PatientPoint origin() const { return {m_origin}; }
    /// The step vector of an axis, mm.
    const glm::dvec3 &step(int axis) const { return m_steps[axis]; }
    /// The length of a step, mm.
    double spacingMm(int axis) const;
    double shortestStepMm() const;
    double longestStepMm() const;
    /// |det(a_0 a_1 a_2)|, mm^3.
    double cellVolumeMm3() const;
    /// Unit normal of the slices, a_0 x a_1.
    glm::dvec3 sliceNormal() const;
    /// Distance between neighbouring slices, measured along their normal, mm.
    double sliceDistanceMm() const;
    /// Angle between the stack's direction a_2 and the slices' normal; 0 for an untilted scan.
    double shearRad() const;
    /// Half the longest of the four body diagonals |+-n_0 a_0 +- n_1 a_1 +- n_2 a_2|, mm.
    double radiusMm() const;

    PatientPoint center() const;
    PatientPoint patient(VoxelPoint p) const { return {m_origin + m_steps * p.v}; }
    PatientPoint patient(VoxelIndex n) const { return patient(VoxelPoint{{n.i, n.j, n.k}}); }
    VoxelPoint voxel(PatientPoint p) const { return {m_inverse * (p.mm - m_origin)}; }
    bool contains(VoxelIndex n) const;
    VoxelBox bounds() const { return {{0, 0, 0}, {m_size.i, m_size.j, m_size.k}}; }
    /// The part of this lattice in a box. *Requires*: the box is inside the lattice.
    Lattice cropped(const VoxelBox &box) const;

    bool operator==(const Lattice &) const = default;
    /// Whether their voxels fill the same box: no corner is further than a tenth of the shortest
    /// step from the same corner of the other one.
    bool fillsSameBox(const Lattice &other) const;

private:
    GridSize m_size{1, 1, 1};
    glm::dvec3 m_origin{0.0};
    glm::dmat3 m_steps{1.0};
    glm::dmat3 m_inverse{1.0};
};

} // namespace pellucid::volume
