// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/task/error.h"

namespace pellucid {

/// The exit code for a failure. Scripts rely on these values.
constexpr int exitCode(task::ErrorCode code) {
    switch (code) {
    case task::ErrorCode::internal:
    case task::ErrorCode::output:
        return 1;
    case task::ErrorCode::usage:
        return 2;
    case task::ErrorCode::unusable:
        return 3;
    case task::ErrorCode::outOfMemory:
        return 4;
    case task::ErrorCode::noSuchDevice:
        return 5;
    case task::ErrorCode::unreachable:
        return 6;
    case task::ErrorCode::incomplete:
        return 7;
    }
    return 1;
}

} // namespace pellucid
