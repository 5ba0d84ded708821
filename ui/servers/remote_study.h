// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

#include "core/archive/object_folder.h"
#include "core/archive/search.h"
#include "ui/studies/study_facts.h"

namespace pellucid::ui {

/// A study that servers have.
struct RemoteStudy {
    StudyFacts study;
    QStringList servers;
    int instances = 0; ///< as the server counts them; 0: unknown
};

RemoteStudy remoteStudy(const archive::FoundEntry &entry);

archive::Patient patientOf(const StudyFacts &study);

/// What the words of a search mean to a server: dates, a modality, an identifier, a name.
archive::SearchTerms searchTermsOf(const QString &words);

} // namespace pellucid::ui
