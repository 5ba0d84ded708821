// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/kept_reasons.h"

#include <array>
#include <functional>
#include <optional>
#include <utility>

#include <QByteArray>
#include <QStringList>

#include "core/task/reasons.h"
#include "core/volume/reasons.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;

std::optional<task::Reason> decoded(const QString &line) {
    return task::Reason::decoded(QByteArray::fromPercentEncoding(line.toUtf8()).toStdString());
}

// Earlier versions wrote plain sentences, which can only be shown and compared as text.
task::Reason plainSentence(const QString &text) {
    return because::inWords(text.toStdString());
}

// Stack directions are matched by reason: they distinguish a stack from the phases of another.
task::Reason labelPart(const QString &text) {
    static const std::array<std::pair<task::Reason, task::Because<1>>, 4> directions{
        {{because::axial, because::axialNumber},
         {because::coronal, because::coronalNumber},
         {because::sagittal, because::sagittalNumber},
         {because::images, because::imagesNumber}}};
    for (const auto &[direction, numbered] : directions) {
        const QString name = QString::fromStdString(direction.english());
        if (text == name)
            return direction;
        bool isNumber = false;
        if (const int number = text.mid(name.size() + 1).toInt(&isNumber);
            isNumber && text == name + " " + QString::number(number))
            return numbered(number);
    }
    return plainSentence(text);
}

std::vector<task::Reason> all(const QString &lines, const QString &separator,
                              const std::function<task::Reason(const QString &)> &read) {
    std::vector<task::Reason> reasons;
    for (const QString &line : lines.split(separator, Qt::SkipEmptyParts))
        reasons.push_back(read(line));
    return reasons;
}

} // namespace

QString toLine(const task::Reason &reason) {
    // Names may not be valid UTF-8.
    return QString::fromLatin1(
        QByteArray::fromStdString(reason.encoded()).toPercentEncoding(" :;,()'/=+"));
}

task::Reason reasonFromLine(const QString &line) {
    return decoded(line).value_or(plainSentence(line));
}

QString toLines(const std::vector<task::Reason> &reasons) {
    QStringList lines;
    for (const task::Reason &reason : reasons)
        lines << toLine(reason);
    return lines.join('\n');
}

std::vector<task::Reason> reasonsFromLines(const QString &lines) {
    return all(lines, "\n", reasonFromLine);
}

std::vector<task::Reason> labelFromLines(const QString &lines) {
    const QString first = lines.section('\n', 0, 0);
    return first.isEmpty() || decoded(first) ? reasonsFromLines(lines)
                                             : all(lines, ", ", labelPart);
}

} // namespace pellucid::ui
