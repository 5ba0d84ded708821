// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QSplitter>

#include "core/task/reason.h"
#include "ui/views/tools.h"
#include "ui/views/viewer.h"

class QLabel;

namespace pellucid::ui {

class GraphicsCard;
class StudyBeside;
struct StudySource;

/// The panes of the open study, and while it is wanted those of a second one beside them; which is
/// which stands over them then.
class StudyPair : public QSplitter {
    Q_OBJECT
public:
    StudyPair(const Viewer &open, GraphicsCard &card, QWidget *parent = nullptr);

    void openBeside(const StudySource &source);
    /// Nothing looks at the open study from beside it any more.
    void closeBeside();
    void toggleLink();
    void setTool(Tool tool);

signals:
    void besideChanged(bool isThere);
    void linkChanged(bool isLinked);
    void readoutChanged(const QString &text);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    void makeBeside();
    void showHeading();

    Viewer m_open;
    GraphicsCard &m_card;
    Tool m_tool = Tool::window;
    QLabel *m_heading;
    StudyBeside *m_beside = nullptr;
};

} // namespace pellucid::ui
