// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QMenu;

namespace pellucid::ui {

class GraphicsCard;

/// Adds the choice of the projection engine.
void addEngineMenu(QMenu &menu, GraphicsCard &card);

} // namespace pellucid::ui
