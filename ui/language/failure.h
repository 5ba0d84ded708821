// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/task/reason.h"

namespace pellucid::ui {

/// An error as it is shown to the user.
struct Failure {
    task::Reason what;
    QString path; ///< empty if no file is involved
};

/// Describes the exception that is being handled, of any type.
Failure currentFailure();

} // namespace pellucid::ui
