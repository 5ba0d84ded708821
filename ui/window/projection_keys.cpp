// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/projection_keys.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QKeyEvent>
#include <QKeySequenceEdit>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTextEdit>

#include "ui/views/projection_view.h"

namespace pellucid::ui {

namespace {

// Text fields need letters and digits.
bool takesText(const QWidget *widget) {
    return qobject_cast<const QLineEdit *>(widget) != nullptr ||
           qobject_cast<const QAbstractSpinBox *>(widget) != nullptr ||
           qobject_cast<const QKeySequenceEdit *>(widget) != nullptr ||
           qobject_cast<const QTextEdit *>(widget) != nullptr ||
           qobject_cast<const QPlainTextEdit *>(widget) != nullptr;
}

} // namespace

ProjectionKeys::ProjectionKeys(QWidget &window, ProjectionView &projection)
    : QObject(&window), m_window(window), m_projection(projection) {
    qApp->installEventFilter(this);
}

bool ProjectionKeys::eventFilter(QObject *watched, QEvent *event) {
    const auto type = event->type();
    const bool isKey =
        type == QEvent::KeyPress || type == QEvent::KeyRelease || type == QEvent::ShortcutOverride;
    auto *const widget = isKey ? qobject_cast<QWidget *>(watched) : nullptr;
    if (widget == nullptr || widget->window() != &m_window || takesText(widget) ||
        qobject_cast<ProjectionView *>(widget) != nullptr || m_isForwarding)
        return QObject::eventFilter(watched, event);
    auto *const key = static_cast<QKeyEvent *>(event);
    if (key->key() == Qt::Key_Q && key->modifiers() == Qt::NoModifier) {
        if (type != QEvent::ShortcutOverride && !key->isAutoRepeat())
            emit comparisonRequested(type == QEvent::KeyPress);
        return type != QEvent::ShortcutOverride;
    }
    // Some systems mark arrow keys as keypad keys; these belong to the planes.
    const bool isView = (key->modifiers() & Qt::KeypadModifier) != 0 &&
                        (key->key() < Qt::Key_Left || key->key() > Qt::Key_Down);
    if (!isView)
        return QObject::eventFilter(watched, event);
    if (type == QEvent::ShortcutOverride) {
        event->accept();
        return true;
    }
    m_isForwarding = true; // events that it ignores return to this filter
    QCoreApplication::sendEvent(&m_projection, event);
    m_isForwarding = false;
    return true;
}

} // namespace pellucid::ui
