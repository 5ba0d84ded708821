// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/dicom/catalogue.h"

class QWidget;

namespace pellucid::ui {

/// Asks, without blocking, whether to open unusually large images, and calls `open` if the user
/// agrees. *Shape*: `huge` is not empty.
void askForHuge(QWidget *window, const std::vector<dicom::Skipped> &huge,
                const std::function<void()> &open);

} // namespace pellucid::ui
