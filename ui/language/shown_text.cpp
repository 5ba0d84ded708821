// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/shown_text.h"

#include <QFontMetrics>
#include <QStringList>
#include <QTextLayout>
#include <QToolTip>

#include "core/system/printable.h"

namespace pellucid::ui {

QString shownText(const QString &text) {
    return QString::fromStdString(system::printable(text.toStdString()));
}

QString shownLines(const QString &text) {
    QStringList lines = text.split('\n');
    for (QString &line : lines)
        line = shownText(line);
    return lines.join('\n');
}

QString menuText(const QString &text) {
    return shownText(text).replace('&', "&&");
}

QString editText(const QString &text) {
    return shownText(text) + '\n' + menuText(text);
}

QString titleText(const QString &text) {
    return shownText(text).replace("[*]", "[*][*]");
}

QString plainToolTip(const QString &text) {
    constexpr int columns = 80; // as wide as Qt makes rich ones
    const int width = columns * QFontMetrics(QToolTip::font()).horizontalAdvance('x');
    QStringList lines;
    for (const QString &line : shownLines(text).split('\n')) {
        if (line.size() <= columns / 2) { // fits, also if its letters are wide
            lines << line;
            continue;
        }
        QTextLayout layout(line, QToolTip::font());
        QTextOption wrapping;
        wrapping.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
        layout.setTextOption(wrapping);
        layout.beginLayout();
        for (QTextLine part = layout.createLine(); part.isValid(); part = layout.createLine()) {
            part.setLineWidth(width);
            lines << line.mid(part.textStart(), part.textLength()).trimmed();
        }
        layout.endLayout();
    }
    return lines.join('\n');
}

} // namespace pellucid::ui
