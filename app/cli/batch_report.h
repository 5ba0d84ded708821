// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/batch/done_record.h"
#include "core/dicom/catalogue.h"

namespace pellucid::cli {

/// What becomes of the studies of a batch, told while it happens and summed up at its end.
/// Thread-safe, but for `begin` and what comes after the work.
class BatchReport {
public:
    /// As one JSON object at the end, or a line for each study.
    explicit BatchReport(bool isJson) : m_isJson(isJson) {}

    /// `damaged`: files that count as failures; `unused`: others that are no images.
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

    bool m_isJson;
    std::size_t m_studies = 0;
    std::vector<dicom::Skipped> m_damaged, m_unused;
    std::mutex m_mutex; ///< of what follows
    std::size_t m_done = 0, m_doneBefore = 0;
    std::vector<Failure> m_failures;
    std::vector<std::string> m_passedOver;
    nlohmann::json m_finished = nlohmann::json::array(); ///< for the JSON object
};

} // namespace pellucid::cli
