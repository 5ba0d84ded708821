// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

class QPushButton;
class QWidget;

namespace pellucid::ui {

class PlainLabel;

/// A button with its object name, by which tests find it, and its tip.
QPushButton *makeButton(const QString &text, const char *name, const QString &tip);
/// The same, drawn as a link: for small commands beside a heading.
QPushButton *makeLink(const QString &text, const char *name, const QString &tip);

/// Gives a widget a role of the style sheet: `muted`, `warning`, `link`, `heading`, ...
void setRole(QWidget &widget, const char *role);
/// Shows a text in a role.
void setMessage(PlainLabel &label, const QString &text, const char *role);

} // namespace pellucid::ui
