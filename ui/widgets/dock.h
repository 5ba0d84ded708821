// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QDockWidget;
class QString;
class QWidget;

namespace pellucid::ui {

/// Hides or shows the heading of a dock: in a tab, the tab names it.
void showHeading(QDockWidget &dock, bool isShown);

/// A dock whose heading collapses its panel when clicked. *Shape*: `corner`: a widget beside the
/// heading; may be null.
QDockWidget *makeDock(const QString &title, const char *name, QWidget *panel, QWidget *corner);

} // namespace pellucid::ui
