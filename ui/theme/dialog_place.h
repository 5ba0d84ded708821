// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QDialog;

namespace pellucid::ui {

/// Moves a dialog beside the pictures of its parent's window: next to the window if the screen has
/// room there, otherwise over the panels at its right.
void placeBeside(QDialog &dialog);

} // namespace pellucid::ui
