// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/notices.h"

#include <QFileInfo>

#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"

namespace pellucid::ui {

Notices::Notices(Document &document, QObject *parent) : QObject(parent), m_document(document) {
    connect(&document, &Document::editRefused, this,
            [this](const task::Reason &reason) { report(reason, {}); });
}

void Notices::report(const task::Reason &what, const QString &path) {
    m_document.addProblems({{path.toStdString(), what}});
    const QString name = shownText(QFileInfo(path).fileName());
    emit shown(name.isEmpty() ? translated(what) : name + ": " + translated(what), 8000);
}

void Notices::say(const QString &text) {
    emit shown(shownText(text), 4000);
}

void Notices::attempt(const std::function<void()> &what) {
    try {
        what();
    } catch (const task::Error &error) {
        if (error.code() == task::ErrorCode::usage && error.path().empty())
            say(translated(error.reason()));
        else
            report(error.reason(), QString::fromStdString(error.path().string()));
    }
}

} // namespace pellucid::ui
