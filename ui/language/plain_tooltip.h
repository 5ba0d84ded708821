// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace pellucid::ui {

/// A text as a tooltip that shows it letter by letter: Qt takes some texts for HTML, and files
/// contain any.
inline QString plainToolTip(const QString &text) {
    return text.isEmpty() ? text : "<qt>" + text.toHtmlEscaped().replace('\n', "<br>") + "</qt>";
}

} // namespace pellucid::ui
