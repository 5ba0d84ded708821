// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QStringList>

#include "ui/studies/study_facts.h"

namespace pellucid::ui {

class Document;
class StudyLibrary;

/// The entries for what was opened recently, newest first, from the user's settings: paths, and
/// studies of the library by number and digest, without a name.
QStringList recentPaths();
/// Makes such an entry for a study of the library; finds the study of an entry, if it still exists.
QString recentEntry(const StudyFacts &study);
std::optional<StudyFacts> recentStudy(const QString &entry, StudyLibrary &library);
/// A path that may name a patient, as an entry with a label: "2026-01-01 CT". The path itself is
/// kept in the user's data folder, as the paths of the library are, and not in the settings.
/// Returns nothing if the file cannot be written.
std::optional<QString> privateEntry(const QString &path, const QString &label);
/// The label of such an entry; empty for others.
QString privateLabel(const QString &entry);
/// The path of an entry: itself, or what `privateEntry` kept; empty if it is gone.
QString pathOf(const QString &entry);
/// Whether a path below the user's home, or elsewhere, holds a name, the number or the birth date
/// of the patient, as folders of a disc often do: in the letters of the header, whatever their
/// case, accents and what stands between them.
bool namesPatient(const QString &path, const StudyFacts &study);
/// Whether the settings may keep a path: if studies are remembered, and it names no patient of the
/// document, or names are chosen to be shown.
bool mayBeKept(const QString &path, const Document &document);
/// Puts paths in front; the oldest beyond eight go.
void addRecentPaths(const QStringList &paths);
/// One of them; those that are no studies of the library, with the folder of exports; all.
void forgetRecentPath(const QString &path);
void forgetPaths();
void forgetRecentPaths();

/// Where the next export goes, if nothing else is said; kept as paths are.
QString exportFolder();
void setExportFolder(const QString &folder, const Document &document);

} // namespace pellucid::ui
