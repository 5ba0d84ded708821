// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QString>

class QWidget;

namespace pellucid::ui {

/// A question that the user may agree to or cancel.
struct Question {
    const char *name; ///< of its window
    QString title, text;
    QString agree; ///< the button
};

/// Asks over a window, without blocking, and calls `agreed` if the user agrees,
/// `cancelled` if the user presses the other button. A question of the
/// same name that is still open is withdrawn.
void ask(QWidget *window, const Question &question, const std::function<void()> &agreed,
         const std::function<void()> &cancelled = {});

} // namespace pellucid::ui
