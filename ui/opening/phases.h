// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QObject>
#include <QTimer>

namespace pellucid::ui {

class Document;
class JobRunner;
class StudyOpener;

/// The volumes of the open series that differ in time, echo or the like: same place, same size. One
/// is shown at a time; look, view, window and planes stay.
class Phases : public QObject {
    Q_OBJECT
public:
    Phases(Document &document, StudyOpener &opener, JobRunner &jobs, QObject *parent = nullptr);

    /// 0 or 1: there is nothing to choose.
    int count() const { return int(m_sources.size()); }
    /// -1 while none is open.
    int current() const;
    QString label(int phase) const;
    void show(int phase);
    /// Forwards or back, and around.
    void step(int phases);
    /// One after the other. Each is loaded once; the second round is as fast as pictures are made.
    void togglePlaying();
    bool isPlaying() const { return m_timer.isActive(); }

signals:
    void changed();

private:
    void findPhases();

    Document &m_document;
    StudyOpener &m_opener;
    JobRunner &m_jobs;
    std::vector<int> m_sources;
    QTimer m_timer;
};

} // namespace pellucid::ui
