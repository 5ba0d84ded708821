// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/beside/study_link.h"
#include "ui/document/measurement_store.h"
#include "ui/opening/open_study.h"
#include "ui/views/tools/tool.h"

class QToolButton;

namespace pellucid::ui {

class PlainLabel;

/// A second study beside the open one: panes of its own under a heading that names it, links it and
/// closes it.
class StudyBeside : public QWidget {
    Q_OBJECT
public:
    StudyBeside(const Viewer &leader, GraphicsCard &card, QWidget *parent = nullptr);
    ~StudyBeside() override;

    void open(const StudySource &source);
    Document &document() { return m_study.document; }
    JobRunner &jobs() { return m_study.jobs; }
    bool isLinked() const { return m_link->isLinked(); }
    void toggleLink();
    const Viewer &viewer() const { return m_viewer; }
    /// Crop boxes and regions belong to the open study: here their tools set the window.
    void setTool(Tool tool);
    /// Whether the heading names the patient.
    void setNameShown(bool isShown);

signals:
    void closeRequested();
    void linkChanged(bool isLinked);
    void readoutChanged(const QString &text);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    Viewer makeViewer();
    QWidget *makeHeading();
    /// Lets the link follow, if the volume is complete.
    void beginLink();

    OpenStudy m_study;
    MeasurementStore m_measurements;
    Viewer m_viewer;
    StudyLink *m_link;
    void showName();

    PlainLabel *m_name;
    bool m_showsName = true;
    QToolButton *m_linked;
};

/// The height of the heading above a study; both are equally high. *Units*: logical pixels.
inline constexpr int headingHeight = 32;

/// The heading of a study: "Doe Jane, 2007-04-04 CT Chest, 3 5 mm".
QString headingText(const StudySource &source);

/// The same with what identifies the patient: "Doe Jane  F  1950-01-31 (57 y)  ID 123 ...".
QString bannerText(const StudySource &source);

} // namespace pellucid::ui
