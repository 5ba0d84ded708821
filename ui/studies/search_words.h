// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

namespace pellucid::ui {

/// A text without case, accents and the two widths of East Asian letters.
QString folded(const QString &text);
/// The words of a search, folded.
QStringList searchWords(const QString &search);
/// Whether a text holds every word of a search.
bool holdsWords(const QString &text, const QString &search);

} // namespace pellucid::ui
