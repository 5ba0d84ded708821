// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "core/batch/done_record.h"
#include "core/dicom/catalogue.h"

namespace pellucid::cli {

/// Reports each study of a batch as it ends, and sums up at the end. Thread-safe, except `begin`,
/// `print` and `requireAllDone`.
class BatchReport {
public:
    /// As one JSON object at the end, or a line for each study.
    explicit BatchReport(bool isJson) : m_isJson(isJson) {}

    /// `damaged`: files that count as failures; `unused`: intact files that are not images.
    void begin(std::size_t studies, std::vector<dicom::Skipped> damaged,
               std::vector<dicom::Skipped> unused);

    void finished(const std::string &key, const batch::DoneRecord &record, double seconds);
    void wasDoneBefore();
    /// No series of it is one that the recipe asks for.
    void passedOver(const std::string &key);
    void failed(const std::string &key, const std::string &reason);

    /// `recipe`: its digest.
    void print(const std::string &recipe, double seconds);
    /// *Throws* Error{incomplete} if studies failed or files are damaged.
    void requireAllDone() const;

private:
    struct Failure {
        std::string key, reason;
    };
    struct Finished {
        std::string key, seriesUid;
        double error = 0.0; ///< of the worst picture, measured if some were
        double seconds = 0.0;
        std::vector<std::string> warnings;
    };

    void printLine(const std::string &text) const;

    bool m_isJson;
    std::size_t m_studies = 0;
    std::vector<dicom::Skipped> m_damaged, m_unused;
    std::mutex m_mutex; ///< of what follows
    std::size_t m_done = 0, m_doneBefore = 0;
    std::size_t m_imprecise = 0; ///< done, but an output misses its tolerance
    std::vector<Failure> m_failures;
    std::vector<std::string> m_passedOver;
    std::vector<Finished> m_finished; ///< for the JSON object
};

} // namespace pellucid::cli
