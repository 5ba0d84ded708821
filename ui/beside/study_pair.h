// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QSplitter>

#include "core/task/reason.h"
#include "ui/views/overlay.h"
#include "ui/views/tools/tool.h"
#include "ui/views/viewer.h"

namespace pellucid::ui {

class GraphicsCard;
class PlainLabel;
class StudyBeside;
struct StudySource;

/// The panes of the open study and, if the user wants it, those of a second study beside them. Each
/// then has a heading with its name.
class StudyPair : public QSplitter {
    Q_OBJECT
public:
    StudyPair(const Viewer &open, GraphicsCard &card, QWidget *parent = nullptr);

    void openBeside(const StudySource &source);
    /// Closes the second study and its link, which refers to the open study.
    void closeBeside();
    void toggleLink();
    /// The study whose panes have the keyboard's focus: the one beside, or else the open one.
    Viewer focused() const;
    const Viewer &open() const { return m_open; }
    /// That of the study beside; null if there is none.
    const Viewer *beside() const;
    bool isLinked() const;
    Tool tool() const { return m_tool; }
    /// The tool of the left button in all panes.
    void setTool(Tool tool);
    const Overlays &overlays() const { return m_overlays; }
    /// Applies to all panes, including later ones.
    void setOverlays(const Overlays &overlays);
    bool showsBanner() const { return m_showsBanner; }
    /// Names the patient above the panes, also of a single study.
    void setBannerShown(bool isShown);

signals:
    void besideOpened();
    /// A second study was opened, closed, linked or unlinked.
    void changed();
    void readoutChanged(const QString &text);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    void makeBeside();
    void showHeading();

    Viewer m_open;
    GraphicsCard &m_card;
    Tool m_tool = Tool::window;
    Overlays m_overlays;
    bool m_showsBanner = true;
    PlainLabel *m_heading;
    StudyBeside *m_beside = nullptr;
};

} // namespace pellucid::ui
