// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QWidget;

namespace pellucid::ui {

class Notices;

/// Opens the manual in the user's browser.
void openManual(Notices &notices);
/// Shows version, license and libraries of the program.
void showAbout(QWidget &window);

} // namespace pellucid::ui
