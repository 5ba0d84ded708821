// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QObject>
#include <QTimer>

namespace pellucid::ui {

class Document;
class JobRunner;
class StudyOpener;

/// The phases of the open series: volumes of the same place and size that differ in time, echo or
/// the like. One is shown at a time; look, view, window and planes stay.
class Phases : public QObject {
    Q_OBJECT
public:
    Phases(Document &document, StudyOpener &opener, JobRunner &jobs, QObject *parent = nullptr);

    /// The number of phases; 0 or 1: there is nothing to choose.
    int count() const { return int(m_sources.size()); }
    /// The index of the open phase; -1: none is open.
    int current() const;
    QString label(int phase) const;
    void show(int phase);
    /// Steps forwards or back, and from one end to the other.
    void step(int phases);
    /// Plays the phases in a loop. The first round loads each; later ones are as fast as the
    /// frames.
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
