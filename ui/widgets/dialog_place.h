// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

namespace pellucid::ui {

/// Moves a dialog beside the pictures of its parent's window: next to the window if the screen has
/// room there, otherwise over the panels at its right.
void placeBeside(QDialog &dialog);

/// Shows the only dialog of a kind that a window has, in front. `make` makes one if there is none.
template <class Dialog, class Make> Dialog &showOnly(QWidget &window, const Make &make) {
    auto *dialog = window.findChild<Dialog *>();
    if (dialog == nullptr)
        dialog = make();
    dialog->show();
    dialog->raise();
    dialog->activateWindow();
    return *dialog;
}

} // namespace pellucid::ui
