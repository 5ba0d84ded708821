// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::ui {

class GraphicsCard;
class ProjectionView;
struct OpenStudy;

/// Connects the pane of the projection with the study whose document it shows: engines, state of
/// the plan, brightness and jobs. If the pane reports that the card failed, the card is given up.
void connectProjection(OpenStudy &study, ProjectionView &projection, GraphicsCard &card);

} // namespace pellucid::ui
