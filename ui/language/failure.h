// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/task/reason.h"

namespace pellucid::ui {

/// What went wrong, as it is said to the user.
struct Failure {
    task::Reason what;
    QString path; ///< empty if it is about no file
};

/// Of the exception that is being handled, whatever it is.
Failure currentFailure();

} // namespace pellucid::ui
