// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/application.h"

#include <utility>

#include "core/confined/protection.h"
#include "core/task/progress.h"
#include "ui/language/failure.h"
#include "ui/theme/theme.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

constexpr qint64 silenceMs = 2000;

} // namespace

Application::Application(int &argc, char **argv) : QApplication(argc, argv) {
    confined::whenUnprotected([this] {
        QMetaObject::invokeMethod(
            this,
            [this] {
                if (!std::exchange(m_isUnprotected, true))
                    emit unprotected();
            },
            Qt::QueuedConnection);
    });
}

Application::~Application() {
    confined::whenUnprotected({});
}

bool Application::notify(QObject *receiver, QEvent *event) {
    try {
        keepPlain(receiver, *event);
        if (event->type() == QEvent::Show)
            if (const auto *const widget = qobject_cast<QWidget *>(receiver);
                widget != nullptr && widget->isWindow())
                matchTitleBar(*widget);
        return QApplication::notify(receiver, event);
    } catch (const task::Cancelled &) {
        // Nothing waits for the result.
    } catch (...) {
        const Failure failure = currentFailure();
        const bool isKnown = failure.what == m_lastFailure && m_sinceFailure.isValid() &&
                             m_sinceFailure.elapsed() < silenceMs;
        m_lastFailure = failure.what;
        m_sinceFailure.start();
        if (!isKnown) // queued: the failed event is still being handled
            QMetaObject::invokeMethod(
                this, [this, failure] { emit failed(failure.what, failure.path); },
                Qt::QueuedConnection);
    }
    return true;
}

} // namespace pellucid::ui
