// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/studies/search_words.h"

#include <algorithm>

namespace pellucid::ui {

QString folded(const QString &text) {
    QString plain;
    for (const QChar c : text.normalized(QString::NormalizationForm_KD))
        if (c.category() != QChar::Mark_NonSpacing)
            plain += c;
    return plain.toCaseFolded();
}

QStringList searchWords(const QString &search) {
    return folded(search).split(' ', Qt::SkipEmptyParts);
}

bool containsWords(const QString &text, const QString &search) {
    const QString in = folded(text);
    const QStringList words = searchWords(search);
    return std::all_of(words.begin(), words.end(),
                       [&](const QString &word) { return in.contains(word); });
}

} // namespace pellucid::ui
