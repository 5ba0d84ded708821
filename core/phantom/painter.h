// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::phantom {

/// A solid: the signed distance from its surface near the surface (negative inside, mm), and a box
/// in patient space; it is not evaluated outside the box.
struct Shape {
    std::function<double(const glm::dvec3 &mm)> distance;
    glm::dvec3 low{0.0}, high{0.0};

    double operator()(const glm::dvec3 &mm) const { return distance(mm); }
};

Shape ellipsoid(glm::dvec3 center, glm::dvec3 radii, glm::dquat rotation = glm::dquat(1, 0, 0, 0));
/// A rod with round ends of different radii.
Shape rod(glm::dvec3 from, glm::dvec3 to, double fromRadius, double toRadius);
/// Rods of one radius along a polyline.
Shape tube(const std::vector<glm::dvec3> &points, double radius);
Shape roundedBox(glm::dvec3 center, glm::dvec3 halfSize, double rounding,
                 glm::dquat rotation = glm::dquat(1, 0, 0, 0));

/// The union with a fillet of about `fillet` mm.
Shape united(const Shape &a, const Shape &b, double fillet = 0.0);
Shape intersected(const Shape &a, const Shape &b);
Shape without(const Shape &a, const Shape &b);
/// Grown by a distance, or shrunk if negative.
Shape grown(const Shape &shape, double mm);
/// The same shape reflected in the patient's median plane.
Shape mirrored(const Shape &shape);

/// Fills a volume with shapes, later ones over earlier ones, with edges softened over about one
/// voxel as by a scanner. The shapes are defined in patient space, so that any lattice, tilted ones
/// too, samples the same anatomy.
class Painter {
public:
    using Texture = std::function<double(const glm::dvec3 &mm)>;

    Painter(const volume::Lattice &lattice, double backgroundHu, task::Progress progress);

    void paint(const Shape &shape, double hu);
    void paint(const Shape &shape, const Texture &hu);
    /// Draws all shapes, adds normal noise (the same for the same seed, whatever the number of
    /// threads) and rounds.
    volume::Volume finish(double noiseHu, std::uint32_t seed, volume::VolumeNotes notes);

private:
    struct Stroke {
        Shape shape;
        Texture hu;
        volume::VoxelBox box; ///< where it may be
    };
    void drawPlane(const Stroke &stroke, int k, float *plane) const;

    volume::Lattice m_lattice;
    double m_backgroundHu, m_softnessMm;
    std::vector<Stroke> m_strokes;
    task::Progress m_progress;
};

} // namespace pellucid::phantom
