// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/text_field.h"

#include <algorithm>
#include <utility>

#include <QKeyEvent>

namespace pellucid::ui {

namespace {

constexpr int preferredWidth = 170, longestText = 200;

} // namespace

TextField::TextField(QWidget &pane, const QPointF &at, const QString &text,
                     const std::function<void(const QString &)> &take)
    : QLineEdit(text, &pane), m_take(take) {
    setObjectName("annotationField");
    setPlaceholderText(tr("Text"));
    setAccessibleName(tr("Text of the annotation"));
    setMaxLength(longestText);
    const QSize size(std::min(preferredWidth, pane.width()), sizeHint().height());
    const QPoint place = at.toPoint() - QPoint(0, size.height() / 2);
    setGeometry({{std::clamp(place.x(), 0, pane.width() - size.width()),
                  std::clamp(place.y(), 0, std::max(0, pane.height() - size.height()))},
                 size});
    selectAll();
    show();
    setFocus();
}

// All keys are letters here, also those of the tools.
bool TextField::event(QEvent *event) {
    if (event->type() == QEvent::ShortcutOverride) {
        event->accept();
        return true;
    }
    return QLineEdit::event(event);
}

void TextField::keyPressEvent(QKeyEvent *event) {
    if (event->key() == Qt::Key_Escape)
        end(false);
    else if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
        end(true);
    else
        QLineEdit::keyPressEvent(event);
}

void TextField::focusOutEvent(QFocusEvent *event) {
    QLineEdit::focusOutEvent(event);
    if (event->reason() != Qt::PopupFocusReason) // its own menu
        end(true);
}

void TextField::end(bool isTaken) {
    const auto take = std::exchange(m_take, nullptr);
    if (!take) // hiding it takes the focus away once more
        return;
    const bool hadFocus = hasFocus();
    hide();
    deleteLater();
    if (hadFocus)
        parentWidget()->setFocus();
    if (isTaken)
        take(text().trimmed());
}

void dropTextFields(QWidget &pane) {
    for (TextField *const field : pane.findChildren<TextField *>())
        field->end(false);
}

} // namespace pellucid::ui
