// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/same_patient.h"

#include "ui/studies/search_words.h"

namespace pellucid::ui {

namespace {

// The alphabetic form of a name, whose parts may be separated by carets or spaces.
QString nameOf(const StudyFacts &study) {
    QString name = study.patientName.section('=', 0, 0).replace('^', ' ');
    return folded(name.simplified());
}

bool areEqual(const QString &a, const QString &b) {
    return !a.isEmpty() && a == b;
}

} // namespace

SamePatient samePatient(const StudyFacts &a, const StudyFacts &b) {
    const bool sameId = areEqual(folded(a.patientId.trimmed()), folded(b.patientId.trimmed()));
    const bool sameDate = areEqual(a.birthDate.trimmed(), b.birthDate.trimmed());
    const bool sameName = areEqual(nameOf(a), nameOf(b));
    if (sameId)
        return sameDate || sameName ? SamePatient::yes : SamePatient::perhaps;
    return sameDate && sameName ? SamePatient::perhaps : SamePatient::no;
}

} // namespace pellucid::ui
