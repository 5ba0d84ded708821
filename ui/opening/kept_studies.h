// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <list>
#include <optional>

#include "core/dicom/load_volume.h"
#include "core/mpr/plane.h"
#include "core/picture/compose.h"
#include "core/prepare/prepared_engine.h"
#include "ui/engine/look_preparer.h"

namespace pellucid::ui {

/// A study as it was when another was opened, so that going back to it takes no time.
struct KeptStudy {
    int source = -1;
    volume::Volume volume;
    volume::ValueWindow initialWindow;
    classify::FieldWindow fieldWindow;
    scene::Scene scene;
    /// Its projection, unless it was dropped or never made.
    std::optional<PreparedFor> preparedFor;
    std::optional<prepare::PreparedEngine> engine;
    volume::ValueWindow displayWindow;
    volume::PatientPoint crosshair;
    mpr::PlaneAxes axes;
    std::optional<picture::ToneRange> brightness;

    std::size_t bytes() const;
};

/// The studies that were open before, as far as the memory goes. What is shown is not among them
/// and stays. Of the rest goes first what is made again fastest: the layers of looks are not kept
/// at all, results of steps leave their cache when it is full, then the spectra of the study that
/// was shown longest ago go, of the next, and so on, and then the volumes in the same order.
class KeptStudies {
public:
    /// In place of what was kept of the same source.
    void keep(KeptStudy study);
    /// Takes a study out, if it is there.
    std::optional<KeptStudy> take(int source);
    /// Whether it comes back at once, with its spectra.
    bool isReady(int source) const;
    /// Drops until the rest fits.
    void trim(std::size_t budgetBytes);
    std::size_t bytes() const;
    std::size_t count() const { return m_studies.size(); }

private:
    std::list<KeptStudy> m_studies; ///< shown last first
};

} // namespace pellucid::ui
