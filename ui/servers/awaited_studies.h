// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QSet>
#include <QString>

#include "core/archive/retrieval.h"
#include "ui/studies/study_facts.h"

namespace pellucid::ui {

/// What the user waits for from servers, and what is to be done when it comes: the study that was
/// asked for last opens while it arrives, and another one may be wanted beside the open one.
class AwaitedStudies {
public:
    void await(const StudyFacts &study) { m_study = study; }
    /// `open`: the key of the open study, beside which this one is wanted.
    void awaitBeside(const StudyFacts &study, const QString &open);
    /// The user has chosen another volume: what arrives does not replace it.
    void forgetStudy() { m_study.reset(); }
    /// What is wanted beside one study is not wanted beside another. `key`: empty if none is open.
    void setOpen(const QString &key);
    void forgetBeside() { m_beside.reset(); }

    /// The awaited study, if it is the one that begins to arrive: it is to be opened.
    std::optional<StudyFacts> arriving(const QString &uid);

    enum class Then {
        nothing,
        say, ///< that a study has arrived
        open,
        openBeside,
        askAboutPatient ///< its images name another patient than the server
    };
    struct Arrival {
        /// The server has corrected data of images that were here before: the user is asked whether
        /// to replace them, once for each study, because some archives correct their lists alone.
        bool asksToReplace = false;
        Then then = Then::say; ///< if nothing is replaced
    };
    /// All of a study is here. `isAskedFor`: by a user. `isIdle`: nothing is open or being opened.
    Arrival completed(const QString &uid, const archive::RetrievalReport &report, bool isAskedFor,
                      bool isIdle);
    /// The study that is wanted beside the open one, if all of it is here.
    std::optional<StudyFacts> readyForBeside() const;

private:
    struct Beside {
        StudyFacts study;
        QString open;
        bool isHere = false;
    };
    std::optional<StudyFacts> m_study;
    QString m_seen; ///< was opened while it arrived: it is not opened again at its end
    std::optional<Beside> m_beside;
    QSet<QString> m_askedToReplace; ///< studies, by UID
};

} // namespace pellucid::ui
