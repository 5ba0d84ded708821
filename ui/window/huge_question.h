// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/dicom/catalogue.h"

class QWidget;

namespace pellucid::ui {

/// Asks, without blocking, whether images that are unusually large are to be opened all the same.
/// *Shape*: `huge` has at least one. Calls `open` if they are.
void askForHuge(QWidget *window, const std::vector<dicom::Skipped> &huge,
                const std::function<void()> &open);

} // namespace pellucid::ui
