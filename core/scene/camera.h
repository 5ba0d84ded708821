// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "core/volume/lattice.h"

namespace pellucid::scene {

/// The six standard views. In `front` the viewer faces the patient: the patient's right is at the
/// left of the image, superior is up.
enum class StandardView { front, back, left, right, top, bottom };

/// Angles that are added to those of a standard view. *Units*: degrees.
struct ViewAngles {
    double azimuthDeg = 0.0, elevationDeg = 0.0, rollDeg = 0.0;
};

/// A parallel projection of the patient. Pixel (row r, column c) is centred at
/// u = pan.x + (c - (width-1)/2) pixel, v = pan.y + ((height-1)/2 - r) pixel about the centre of
/// rotation, which is the centre of the lattice.
struct Camera {
    /// The rotation [U V W]: columns U (image right), V (image up), W (toward the viewer), LPS.
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    double pixelMm = 1.0;
    int width = 2, height = 2;
    glm::dvec2 panMm{0.0};

    glm::dmat3 axes() const { return glm::mat3_cast(orientation); }
    bool operator==(const Camera &) const = default;
};

/// [U V W] = Rz(azimuth) Rx(90) Rx(-elevation) Rz(roll), where each angle is that of the standard
/// view plus that of `angles`.
glm::dquat viewOrientation(StandardView view, const ViewAngles &angles = {});

/// The side of the patient that a unit direction (LPS) points to: one or two of the letters R L A P
/// S I, the strongest component first.
std::string patientLetters(const glm::dvec3 &direction);

/// The orientation after a turn about the patient's long axis. *Units*: degrees, from above
/// anticlockwise.
glm::dquat turnedAboutLongAxis(const glm::dquat &orientation, double degrees);

/// DICOM's Patient Orientation of a picture (PS3.3 C.7.6.1.1.1), the directions of its rows and
/// columns: "L\F", with H and F for superior and inferior.
std::string dicomOrientation(const glm::dvec3 &right, const glm::dvec3 &up);

/// A box in a parallel projection: its middle and half its sides, along image right and up.
/// *Units*: mm, from the middle of the volume.
struct ProjectedBox {
    glm::dvec2 middleMm{0.0}, halfMm{0.0};
};
/// *Units*: corners in mm (LPS), from the middle of the volume.
ProjectedBox projectBox(const glm::dvec3 &lowMm, const glm::dvec3 &highMm,
                        const glm::dquat &orientation);

/// The front view with pixels of the lattice's shortest step and the smallest even square size that
/// contains every view of the lattice. *Throws* Error{usage} if that is more than
/// `largestImageSize`.
Camera defaultCamera(const volume::Lattice &lattice);

/// The same part of the patient, up to a pixel, in pixels that are no smaller than `pixelMm`.
Camera withPixelsAtLeast(Camera camera, double pixelMm);

/// A quarter of a voxel: smaller pixels show only the smoothness of the reconstruction.
inline double finestPixelMm(const volume::Lattice &lattice) {
    return 0.25 * lattice.shortestStepMm();
}

/// The smallest even number of pixels, 2 or more, that covers `pixels`. An excess below 1e-6 is
/// rounding.
int evenPixels(double pixels);

/// Whether fitting a box adjusts the size of a pixel or the size of the picture.
enum class FitBy { pixel, size };
/// Centers a box in the picture of each camera, and chooses one pixel or one size so that it fills
/// the largest but for a margin of 3.5 % on each side. Pixels never get smaller than an eighth, and
/// pictures never get more pixels. Does nothing for an empty box. *Units*: as `projectBox`.
/// *Requires*: the cameras have one size and one pixel.
void fitToBox(std::span<Camera> cameras, const glm::dvec3 &lowMm, const glm::dvec3 &highMm,
              FitBy by);

/// The largest width and height of an image.
inline constexpr int largestImageSize = 16384;

} // namespace pellucid::scene
