// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "core/decoding/client/reasons.h"
#include "core/task/reason.h"

namespace pellucid::decoding {

inline constexpr std::uint32_t imageTypeTag = 0x00080008;
inline constexpr std::uint32_t bValueOfGeTag = 0x00431039; // a private attribute

/// How the values of an attribute are compared.
enum class ValueKind {
    text,
    number,
    driftingNumber, ///< which may change from slice to slice, as trigger times do
    driftingTime,   ///< the same, as hours, minutes and seconds
};

/// An attribute that can tell volumes at the same positions apart.
struct Dimension {
    std::uint32_t tag; ///< group in the upper, element in the lower 16 bits
    ValueKind kind;
    task::Because<1> label; ///< names a volume by its value
};

/// The most telling come first. Where these do not suffice, any other attribute may.
inline constexpr std::array dimensions{
    Dimension{0x00200100, ValueKind::number, task::because::temporalPosition}, // ..Identifier
    Dimension{0x00209128, ValueKind::number, task::because::temporalPosition}, // ..Index
    Dimension{0x00540060, ValueKind::number, task::because::heartInterval},    // R-R Interval
    Dimension{0x00540070, ValueKind::number, task::because::timeSlot},
    Dimension{0x00540030, ValueKind::number, task::because::phase},
    Dimension{0x00540100, ValueKind::number, task::because::timeSlice},
    Dimension{0x00540010, ValueKind::number, task::because::energyWindow},
    Dimension{0x00540020, ValueKind::number, task::because::detector},
    Dimension{0x00209241, ValueKind::number, task::because::percentOfCycle}, // cardiac phase
    Dimension{0x00180086, ValueKind::number, task::because::echo},
    Dimension{0x00180081, ValueKind::number, task::because::echoTime},
    Dimension{0x00189082, ValueKind::number, task::because::echoTime}, // Effective Echo Time
    Dimension{0x00180082, ValueKind::number, task::because::inversionTime},
    Dimension{0x00189087, ValueKind::number, task::because::bValue},
    Dimension{bValueOfGeTag, ValueKind::number, task::because::bValue},
    Dimension{0x00189089, ValueKind::text, task::because::gradientDirection},
    Dimension{0x00181314, ValueKind::number, task::because::flipAngle},
    Dimension{0x00180060, ValueKind::number, task::because::tubeVoltage},
    Dimension{0x00181210, ValueKind::text, task::because::reconstructionKernel},
    Dimension{0x00181060, ValueKind::driftingNumber, task::because::milliseconds}, // Trigger Time
    Dimension{0x00209153, ValueKind::driftingNumber, task::because::milliseconds}, // trigger delay
    Dimension{0x00541300, ValueKind::driftingNumber,
              task::because::milliseconds}, // frame reference
    Dimension{0x00209056, ValueKind::text, task::because::stack},
    Dimension{0x00200012, ValueKind::number, task::because::acquisition},
    Dimension{imageTypeTag, ValueKind::text, task::because::type},
    Dimension{0x00080032, ValueKind::driftingTime, task::because::acquisitionTime},
    Dimension{0x0008002A, ValueKind::text, task::because::acquisitionTime}, // with its date
    Dimension{0x00080033, ValueKind::driftingTime, task::because::contentTime},
};

} // namespace pellucid::decoding
