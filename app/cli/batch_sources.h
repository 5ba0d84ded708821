// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/batch_job.h"
#include "app/cli/commands.h"
#include "core/archive/search.h"
#include "core/archive/server.h"
#include "core/dicom/catalogue.h"

namespace pellucid::cli {

/// A study that a batch may render.
struct BatchItem {
    std::string key;        ///< names its results: the study UID, or what stands for it
    std::size_t index = 0;  ///< of its source
    std::string studyUid{}; ///< on a server
};

/// Studies in files, or on a server. Thread-safe, but for `list`.
class BatchSource {
public:
    virtual ~BatchSource() = default;
    /// All studies, in an order that is the same everywhere. *Throws* as scanning and searching.
    virtual std::vector<BatchItem> list() = 0;
    /// A digest of a study, without reading its pixels. *Throws* as archive::listInstances.
    virtual std::string digestOf(const BatchItem &item) = 0;
    /// Calls `use` with the study, whose files are there meanwhile. *Throws* as `use` and
    /// archive::retrieve; Error{incomplete} if not all of it arrived.
    virtual void open(const BatchItem &item,
                      const std::function<void(const StudyToRender &)> &use) = 0;
    /// Files that belong to no study that can be read, each with its reason.
    virtual std::vector<dicom::Skipped> skipped() const { return {}; }
};

/// Leaves out the folder of the results, `except`.
std::unique_ptr<BatchSource> batchOfFiles(const std::vector<std::filesystem::path> &paths,
                                          const std::filesystem::path &except,
                                          const Context &context);
/// `terms`: those of studies; with the UID of a series, only this one of each study is retrieved.
std::unique_ptr<BatchSource> batchOfServer(const archive::Server &server,
                                           const archive::SearchTerms &terms,
                                           const batch::SeriesChoice &choice,
                                           const Context &context);

} // namespace pellucid::cli
