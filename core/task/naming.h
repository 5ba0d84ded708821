// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/task/error.h"

namespace pellucid::task {

/// Runs `work` and returns its result. *Throws* as `work`; errors without a path get this one.
template <class F> auto naming(const std::filesystem::path &path, F &&work) {
    try {
        return work();
    } catch (const Error &error) {
        if (!error.path().empty())
            throw;
        throw Error(error.code(), error.reason(), path);
    }
}

} // namespace pellucid::task
