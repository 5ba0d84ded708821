// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLabel>

namespace pellucid::ui {

/// A label that shows every text letter by letter. A QLabel takes some texts for HTML, reads the
/// files that they name, and shows what they say; and the texts of files are anybody's.
class PlainLabel : public QLabel {
public:
    explicit PlainLabel(const QString &text = {}, QWidget *parent = nullptr);
    /// Shows the lines of a text: `shownLines`.
    void setText(const QString &text);
};

/// Makes a label that Qt itself creates, such as a tooltip or that of a message, show its text
/// letter by letter, before the text is read. The application passes every event.
void keepPlain(QObject *receiver, const QEvent &event);

} // namespace pellucid::ui
