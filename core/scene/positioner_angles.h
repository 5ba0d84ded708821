// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include <glm/gtc/quaternion.hpp>

namespace pellucid::scene {

/// The line of sight as the angles of a C-arm, where the viewer is at the detector. *Units*:
/// degrees. *Source*: DICOM PS3.3 C.8.7.5, Positioner Primary and Secondary Angle (0018,1510 and
/// 1511): primary 0 is anterior, +90 the patient's left (LAO), -90 the right (RAO); secondary +90
/// is cranial (CRA), -90 caudal (CAU).
struct PositionerAngles {
    double primaryDeg = 0.0;   ///< above -180 to 180
    double secondaryDeg = 0.0; ///< -90 to 90
    bool operator==(const PositionerAngles &) const = default;
};

/// The angles of a view, whatever its roll. Straight from above or below, where the primary angle
/// has no meaning, it is that of the picture's lower edge, or of its upper edge from below.
PositionerAngles positionerAngles(const glm::dquat &orientation);
/// The upright view of these angles, see `viewOrientation`.
glm::dquat orientationOf(const PositionerAngles &angles);

/// The upright view from a direction, LPS; the standard views from above and below.
glm::dquat orientationFrom(const glm::dvec3 &toViewer);

/// Reads "LAO30,CRA20", "RAO 12.5 CAU 5", "CRA30" or "AP": each axis once or not at all, in any
/// order. *Throws* Error{usage} naming what is wrong.
PositionerAngles positionerAnglesFromText(const std::string &text);
/// "LAO 30 CRA 20", rounded to whole degrees; an axis at 0 is left out, "AP" means both are, and
/// "PA" a primary angle of 180.
std::string positionerText(const PositionerAngles &angles);

/// An angulation that is used in angiography or radiography, by its English name.
struct NamedAngles {
    const char *name;
    PositionerAngles angles;
};
inline constexpr std::array<NamedAngles, 12> commonAngles{{{"AP", {0, 0}},
                                                           {"PA", {180, 0}},
                                                           {"Left lateral", {90, 0}},
                                                           {"Right lateral", {-90, 0}},
                                                           {"AP cranial", {0, 30}},
                                                           {"AP caudal", {0, -30}},
                                                           {"LAO", {45, 0}},
                                                           {"RAO", {-30, 0}},
                                                           {"LAO cranial", {30, 25}},
                                                           {"Spider (LAO caudal)", {45, -30}},
                                                           {"RAO cranial", {-30, 25}},
                                                           {"RAO caudal", {-25, -20}}}};

} // namespace pellucid::scene
