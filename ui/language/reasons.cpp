// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/reasons.h"

#include <string>

#include <QCoreApplication>
#include <QRegularExpression>
#include <QStringList>

#include "ui/language/shown_text.h"

namespace pellucid::ui {

namespace {

// The sentences themselves are in each room's reasons.h.
constexpr const char *betweenLabels = QT_TRANSLATE_NOOP("Reasons", ", ");
constexpr const char *betweenReasons = QT_TRANSLATE_NOOP("Reasons", "; ");

QString joined(const std::vector<task::Reason> &reasons, const char *separator) {
    QStringList all;
    for (const task::Reason &reason : reasons)
        all << translated(reason);
    return all.join(QCoreApplication::translate("Reasons", separator));
}

// Archives name files after UIDs, which say nothing to a reader: the end tells them apart.
QString withoutUids(QString text) {
    constexpr qsizetype kept = 8;
    static const QRegularExpression uid("[0-2](?:\\.\\d+){5,}(?=\\.[A-Za-z]|[^\\s:]*\\.dcm)");
    for (auto found = uid.match(text); found.hasMatch(); found = uid.match(text))
        text.replace(found.capturedStart(), found.capturedLength(),
                     QString::fromUtf8("…") + found.captured().right(kept).remove('.'));
    return text;
}

QString translated(const task::Argument &argument) {
    return argument.reasons.empty() ? withoutUids(shownText(QString::fromStdString(argument.text)))
                                    : joined(argument.reasons, betweenReasons);
}

} // namespace

QString translated(const task::Reason &reason) {
    const std::string english(reason.sentence().english);
    const QString form = QCoreApplication::translate("Reasons", english.c_str());
    // Fill all placeholders in one pass: an argument may itself contain one.
    QString filled;
    for (qsizetype n = 0; n < form.size(); ++n) {
        const int place = form[n] == '%' && n + 1 < form.size() ? form[n + 1].unicode() - '1' : -1;
        if (place >= 0 && place < int(reason.arguments().size())) {
            filled += translated(reason.arguments()[std::size_t(place)]);
            ++n;
        } else {
            filled += form[n];
        }
    }
    return filled;
}

QString translated(const std::vector<task::Reason> &label) {
    return joined(label, betweenLabels);
}

} // namespace pellucid::ui
