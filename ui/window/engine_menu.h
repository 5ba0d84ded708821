// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QMenu;

namespace pellucid::ui {

class GraphicsCard;

/// The choice of what makes the projections.
void addEngineMenu(QMenu &menu, GraphicsCard &card);

} // namespace pellucid::ui
