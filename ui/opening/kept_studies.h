// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <list>
#include <optional>

#include "core/prepare/prepared_engine.h"
#include "ui/document/document.h"
#include "ui/engine/look_preparer.h"

namespace pellucid::ui {

/// A study as it was when another one was opened, so that it can come back at once.
struct KeptStudy {
    int source = -1;
    OpenVolume opened;
    StudyView view;
    /// The engine of its projection, unless it was dropped or never made.
    std::optional<PreparedFor> preparedFor;
    std::optional<prepare::PreparedEngine> engine;

    std::size_t bytes() const;
};

/// The studies that were open before, as many as fit in memory. The study on the screen is not
/// among them. What is fastest to make again is dropped first: the spectra, beginning with those of
/// the study that was shown longest ago, then the volumes in the same order. The layers of looks
/// are not kept at all.
class KeptStudies {
public:
    /// Replaces what was kept of the same source.
    void keep(KeptStudy study);
    /// Removes a study and returns it; none if it was not kept.
    std::optional<KeptStudy> take(int source);
    /// Whether the study can come back at once, with its spectra.
    bool isReady(int source) const;
    /// Drops spectra and volumes until the rest fits.
    void trim(std::size_t budgetBytes);
    std::size_t bytes() const;
    std::size_t count() const { return m_studies.size(); }

private:
    std::list<KeptStudy> m_studies; ///< the last shown first
};

} // namespace pellucid::ui
