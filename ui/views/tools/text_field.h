// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QLineEdit>

namespace pellucid::ui {

/// A field on a pane for the text of an annotation. It takes the focus, gives the text when the
/// user presses Enter or clicks elsewhere, nothing after Escape, and deletes itself.
class TextField : public QLineEdit {
    Q_OBJECT
public:
    /// `at`: where the text begins; the field stays within the pane. *Units*: logical pixels.
    TextField(QWidget &pane, const QPointF &at, const QString &text,
              const std::function<void(const QString &)> &take);

protected:
    bool event(QEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;

private:
    friend void dropTextFields(QWidget &pane);
    void end(bool isTaken);

    std::function<void(const QString &)> m_take;
};

/// Drops the fields of a pane with what was typed.
void dropTextFields(QWidget &pane);

} // namespace pellucid::ui
