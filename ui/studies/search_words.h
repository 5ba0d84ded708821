// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

namespace pellucid::ui {

/// A text with differences of case, accents and East Asian width removed.
QString folded(const QString &text);
/// The words of a search, folded.
QStringList searchWords(const QString &search);
/// Whether a text contains every word of a search.
bool containsWords(const QString &text, const QString &search);

} // namespace pellucid::ui
