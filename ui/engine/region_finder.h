// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <QObject>

#include "core/classify/tissue_class.h"
#include "ui/jobs/job_runner.h"

namespace pellucid::preprocess {
class StepCache;
}

namespace pellucid::ui {

class Document;

/// Finds the region that the user is choosing, or else that of the selected class while a region
/// tool is chosen, and lets the planes tint it. A newer wish replaces the search.
class RegionFinder : public QObject {
    Q_OBJECT
public:
    /// `steps`: results that the projection of the same classes needs, too.
    RegionFinder(Document &document, std::shared_ptr<preprocess::StepCache> steps,
                 QObject *parent = nullptr);
    JobRunner &jobs() { return m_jobs; }

private:
    std::optional<classify::TissueClass> wanted() const;
    void update();
    void start();

    Document &m_document;
    std::shared_ptr<preprocess::StepCache> m_steps, m_candidateSteps;
    std::optional<classify::TissueClass> m_wanted;
    JobRunner m_jobs;
};

} // namespace pellucid::ui
