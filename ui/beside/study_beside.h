// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <QWidget>

#include "ui/beside/study_link.h"
#include "ui/document/document.h"
#include "ui/engine/card_copier.h"
#include "ui/engine/look_preparer.h"
#include "ui/jobs/job_runner.h"
#include "ui/opening/study_opener.h"
#include "ui/views/tools.h"

class QLabel;
class QToolButton;

namespace pellucid::ui {

/// A second study, beside the open one: a document, jobs and panes of its own under a heading that
/// names it, links it and closes it. There while it is wanted.
class StudyBeside : public QWidget {
    Q_OBJECT
public:
    StudyBeside(const Viewer &leader, GraphicsCard &card, QWidget *parent = nullptr);
    ~StudyBeside() override;

    void open(const StudySource &source);
    Document &document() { return m_document; }
    JobRunner &jobs() { return m_jobs; }
    StudyLink &link() { return *m_link; }
    const Viewer &viewer() const { return m_viewer; }
    /// Measures and crop boxes belong to the open study: their tools window here.
    void setTool(Tool tool);

signals:
    void closeRequested();
    void linkChanged(bool isLinked);
    void readoutChanged(const QString &text);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    Viewer makeViewer();
    QWidget *makeHeading();

    Document m_document;
    JobRunner m_jobs;
    LookPreparer m_preparer;
    CardCopier m_copier;
    StudyOpener m_opener;
    Viewer m_viewer;
    StudyLink *m_link;
    QLabel *m_name;
    QToolButton *m_linked;
};

/// Of the line over a study, so that panes stand side by side. *Units*: logical pixels.
inline constexpr int headingHeight = 32;

/// "Doe Jane, 2007-04-04 CT Chest, 3 5 mm": what stands over a study.
QString headingText(const StudySource &source);

} // namespace pellucid::ui
