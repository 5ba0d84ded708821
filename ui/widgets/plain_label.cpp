// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/plain_label.h"

#include <QEvent>

#include "ui/language/shown_text.h"

namespace pellucid::ui {

PlainLabel::PlainLabel(const QString &text, QWidget *parent) : QLabel(parent) {
    setTextFormat(Qt::PlainText);
    setText(text);
}

void PlainLabel::setText(const QString &text) {
    QLabel::setText(shownLines(text));
}

// A label is polished before it is measured or painted, a tooltip before it has a text.
void keepPlain(QObject *receiver, const QEvent &event) {
    if (event.type() != QEvent::Polish)
        return;
    if (auto *const label = qobject_cast<QLabel *>(receiver))
        label->setTextFormat(Qt::PlainText);
}

} // namespace pellucid::ui
