// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/view_keys.h"

#include <QKeyEvent>

namespace pellucid::ui {

std::optional<scene::StandardView> standardViewOf(const QKeyEvent &event) {
    using scene::StandardView;
    if ((event.modifiers() & Qt::KeypadModifier) == 0)
        return std::nullopt;
    const bool shift = (event.modifiers() & Qt::ShiftModifier) != 0;
    switch (event.key()) {
    // With Shift, or without Num Lock, keypad digits arrive as the keys printed below them.
    case Qt::Key_1:
    case Qt::Key_End:
        return shift ? StandardView::back : StandardView::front;
    case Qt::Key_3:
    case Qt::Key_PageDown:
        return shift ? StandardView::right : StandardView::left;
    case Qt::Key_7:
    case Qt::Key_Home:
        return shift ? StandardView::bottom : StandardView::top;
    default:
        return std::nullopt;
    }
}

} // namespace pellucid::ui
