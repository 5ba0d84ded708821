// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <new>

#include "core/decoding/client/reasons.h"
#include "core/decoding/process/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

/// Runs code that damaged files may break: DCMTK and OpenJPEG let exceptions of the standard
/// library through. *Throws* task::Error only.
template <class F> auto orDamaged(F &&f) {
    try {
        return f();
    } catch (const task::Error &) {
        throw;
    } catch (const std::bad_alloc &) {
        throw task::Error(task::ErrorCode::outOfMemory, task::because::needsTooMuchMemory);
    } catch (const std::exception &) {
        throw task::Error(task::ErrorCode::unusable, task::because::isDamaged);
    }
}

} // namespace pellucid::decoding::process
