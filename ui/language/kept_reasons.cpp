// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/kept_reasons.h"

#include <QByteArray>
#include <QStringList>

#include "core/task/reasons.h"

namespace pellucid::ui {

namespace because = task::because;

QString toLine(const task::Reason &reason) {
    // Names may not be valid UTF-8.
    return QString::fromLatin1(
        QByteArray::fromStdString(reason.encoded()).toPercentEncoding(" :;,()'/=+"));
}

task::Reason reasonFromLine(const QString &line) {
    const std::string text = QByteArray::fromPercentEncoding(line.toUtf8()).toStdString();
    return task::Reason::decoded(text).value_or(because::inWords(line.toStdString()));
}

QString toLines(const std::vector<task::Reason> &reasons) {
    QStringList lines;
    for (const task::Reason &reason : reasons)
        lines << toLine(reason);
    return lines.join('\n');
}

std::vector<task::Reason> reasonsFromLines(const QString &lines) {
    std::vector<task::Reason> reasons;
    for (const QString &line : lines.split('\n', Qt::SkipEmptyParts))
        reasons.push_back(reasonFromLine(line));
    return reasons;
}

} // namespace pellucid::ui
