// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QObject>

#include "core/task/reason.h"

namespace pellucid::ui {

class Document;

/// What the program tells its user without a question: the status bar shows it for some seconds,
/// and failures stay in the list of problems.
class Notices : public QObject {
    Q_OBJECT
public:
    explicit Notices(Document &document, QObject *parent = nullptr);

    /// A failure. `path`: what it concerns; may be empty.
    void report(const task::Reason &what, const QString &path);
    /// Something that is not a failure: what is done, or why nothing is.
    void say(const QString &text);
    /// Runs `what`, and reports a task::Error that it throws. What is not possible now is no
    /// problem of the study.
    void attempt(const std::function<void()> &what);

signals:
    void shown(const QString &text, int milliseconds);

private:
    Document &m_document;
};

} // namespace pellucid::ui
