// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace pellucid::ui {

/// A text from outside, such as a patient's name or a file's, as one line that is safe to show:
/// `system::printable`. For items of lists; a PlainLabel does it itself.
QString shownText(const QString &text);

/// The same, but line breaks stay.
QString shownLines(const QString &text);

/// A text from outside for an action, a menu, a button or a tab, which take an ampersand for the
/// mark of a key.
QString menuText(const QString &text);

/// The text of an edit that may contain a text from outside, for the list of edits and, after a
/// line break, for the menu (QUndoCommand).
QString editText(const QString &text);

/// A text from outside for the title of a window, in which "[*]" marks unsaved changes.
QString titleText(const QString &text);

/// A tooltip with a text from outside, or with a long text: Qt wraps only rich texts.
QString plainToolTip(const QString &text);

} // namespace pellucid::ui
