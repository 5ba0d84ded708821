// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/dialog_place.h"

#include <algorithm>

#include <QDialog>
#include <QScreen>

namespace pellucid::ui {

void placeBeside(QDialog &dialog) {
    if (dialog.parentWidget() == nullptr)
        return;
    const QRect window = dialog.parentWidget()->window()->frameGeometry();
    const QRect screen = dialog.screen()->availableGeometry();
    const QSize size = dialog.frameGeometry().size();
    const int beside = window.right() + 8;
    const int x =
        beside + size.width() <= screen.right() ? beside : window.right() - size.width() - 4;
    const int y = window.top() + (window.height() - size.height()) / 2;
    dialog.move(
        std::clamp(x, screen.left(), std::max(screen.left(), screen.right() - size.width())),
        std::clamp(y, screen.top(), std::max(screen.top(), screen.bottom() - size.height())));
}

} // namespace pellucid::ui
