// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/awaited_studies.h"

namespace pellucid::ui {

void AwaitedStudies::awaitBeside(const StudyFacts &study, const QString &open) {
    m_beside = {study, open, false};
}

void AwaitedStudies::setOpen(const QString &key) {
    if (m_beside && m_beside->open != key)
        m_beside.reset();
}

std::optional<StudyFacts> AwaitedStudies::arriving(const QString &uid) {
    if (!m_study || m_study->uid != uid)
        return std::nullopt;
    m_seen = uid;
    return m_study;
}

AwaitedStudies::Arrival AwaitedStudies::completed(const QString &uid,
                                                  const archive::RetrievalReport &report,
                                                  bool isAskedFor, bool isIdle) {
    Arrival arrival;
    if (isAskedFor && report.corrected > 0 && !m_askedToReplace.contains(uid)) {
        m_askedToReplace.insert(uid);
        arrival.asksToReplace = true;
    }
    const bool isForBeside = m_beside && m_beside->study.uid == uid;
    if (report.ofAnotherPatient > 0) {
        if (isForBeside)
            m_beside.reset();
        arrival.then = isAskedFor ? Then::askAboutPatient : Then::nothing;
    } else if (isForBeside) {
        m_beside->isHere = true;
        arrival.then = Then::openBeside;
    } else if (isIdle && isAskedFor && uid != m_seen) {
        arrival.then = Then::open;
    }
    return arrival;
}

std::optional<StudyFacts> AwaitedStudies::readyForBeside() const {
    return m_beside && m_beside->isHere ? std::optional(m_beside->study) : std::nullopt;
}

} // namespace pellucid::ui
