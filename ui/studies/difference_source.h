// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "ui/studies/study_source.h"

namespace pellucid::ui {

/// Gives the source of this key another description.
using RenameSource = std::function<void(const QString &key, const QString &description)>;

/// The registration of a pair of volumes, which several sources share. Thread-safe.
class Alignment {
public:
    /// Registers the volumes the first time. *Throws* as subtraction::registerRigidly.
    subtraction::Registration of(const volume::Volume &minuend, const volume::Volume &subtrahend,
                                 const task::Progress &progress);

private:
    std::timed_mutex m_mutex;
    std::optional<subtraction::Registration> m_found;
};

/// The difference of two volumes on the lattice of the first, as a volume of the first one's study.
/// Loading it loads both, and aligns the second if there is an alignment. `onLoaded` is called from
/// the thread that loads, with a description that says what the alignment found or why one is
/// needed; it may be empty. *Errors* of the load: those of both loads, of
/// subtraction::registerRigidly, and of subtraction::difference.
StudySource differenceSource(const StudySource &minuend, const StudySource &subtrahend,
                             std::shared_ptr<Alignment> alignment, RenameSource onLoaded);

/// The second volume aligned with the first, on its lattice, to check the alignment. Loading it
/// loads both.
StudySource alignedSource(const StudySource &minuend, const StudySource &subtrahend,
                          const std::shared_ptr<Alignment> &alignment);

} // namespace pellucid::ui
