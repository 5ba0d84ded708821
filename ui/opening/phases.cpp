// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/opening/phases.h"

#include <algorithm>

#include "ui/document/document.h"
#include "ui/jobs/job_runner.h"
#include "ui/language/reasons.h"
#include "ui/opening/study_opener.h"

namespace pellucid::ui {

namespace {

constexpr int playMs = 200;

bool arePhases(const StudySource &a, const StudySource &b) {
    return !a.isClosed && !b.isClosed && a.study.key() == b.study.key() &&
           arePhases(a.volume, b.volume);
}

} // namespace

Phases::Phases(Document &document, StudyOpener &opener, JobRunner &jobs, QObject *parent)
    : QObject(parent), m_document(document), m_opener(opener), m_jobs(jobs) {
    m_timer.setInterval(playMs);
    document.whenever(Change::sources | Change::currentSource, this, &Phases::findPhases);
    connect(&m_timer, &QTimer::timeout, this, [this] {
        if (!m_jobs.isRunning()) // wait for the phase that is being loaded
            step(1);
    });
}

void Phases::findPhases() {
    m_sources.clear();
    const auto &sources = m_document.sources();
    const int open = m_document.currentSource();
    if (open >= 0)
        for (int n = 0; n < int(sources.size()); ++n)
            if (arePhases(sources[std::size_t(n)], sources[std::size_t(open)]))
                m_sources.push_back(n);
    if (count() < 2)
        m_timer.stop();
    emit changed();
}

int Phases::current() const {
    const auto at = std::find(m_sources.begin(), m_sources.end(), m_document.currentSource());
    return at == m_sources.end() ? -1 : int(at - m_sources.begin());
}

QString Phases::label(int phase) const {
    const VolumeFacts &volume =
        m_document.sources()[std::size_t(m_sources.at(std::size_t(phase)))].volume;
    return volume.label.empty() ? seriesText(volume) : translated(volume.label);
}

void Phases::show(int phase) {
    if (phase < 0 || phase >= count() || phase == current())
        return;
    const int source = m_sources[std::size_t(phase)];
    m_opener.openPhase(source, [this, source](const Outcome &) {
        // After a cancel or a failure, playing would request the phase again and again.
        if (source != m_document.currentSource())
            m_timer.stop();
        emit changed();
    });
}

void Phases::step(int phases) {
    if (count() > 1 && current() >= 0)
        show(((current() + phases) % count() + count()) % count());
}

void Phases::togglePlaying() {
    if (isPlaying())
        m_timer.stop();
    else if (count() > 1)
        m_timer.start();
    emit changed();
}

} // namespace pellucid::ui
