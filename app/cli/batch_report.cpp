// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch_report.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/image_output.h"
#include "app/cli/json_text.h"
#include "app/cli/terminal.h"
#include "core/scene/scene.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
using nlohmann::json;
using task::Error;
using task::ErrorCode;

json jsonOf(const std::vector<dicom::Skipped> &skipped) {
    json files = json::array();
    for (const dicom::Skipped &one : skipped)
        files.push_back({{"path", one.path.string()}, {"reason", one.reason.english()}});
    return files;
}

std::string studiesText(std::size_t count) {
    return fmt::format("{} {}", count, count == 1 ? "study" : "studies");
}

} // namespace

void BatchReport::begin(std::size_t studies, std::vector<dicom::Skipped> damaged,
                        std::vector<dicom::Skipped> unused) {
    m_studies = studies;
    m_damaged = std::move(damaged);
    m_unused = std::move(unused);
}

void BatchReport::finished(const std::string &key, const batch::DoneRecord &record,
                           double seconds) {
    const std::lock_guard lock(m_mutex);
    ++m_done;
    error::StatedError worst;
    bool isImprecise = false;
    std::vector<std::string> reported; // what concerns all outputs, once
    for (const batch::DoneRecord::MadeOutput &output : record.outputs) {
        const double known = output.measuredError.value_or(output.predictedError);
        if (known >= worst.relative)
            worst = {known, output.measuredError ? error::StatedError::Kind::measured
                                                 : error::StatedError::Kind::bound};
        // The tolerance of the exact method is no target.
        isImprecise = isImprecise ||
                      (output.tolerance != scene::referenceTolerance && known > output.tolerance);
        for (const std::string &warning : output.warnings)
            if (std::find(reported.begin(), reported.end(), warning) == reported.end()) {
                reported.push_back(warning);
                warn(key + ": " + output.name + ": " + warning);
            }
    }
    m_imprecise += isImprecise ? 1 : 0;
    if (m_isJson)
        m_finished.push_back({key, record.seriesUid, worst.relative, seconds, std::move(reported)});
    printLine(fmt::format("{}: outputs: {}; {:.2f} s, {}", key, record.outputs.size(), seconds,
                          errorText(worst)));
}

// The lock is held, and the study counted.
void BatchReport::printLine(const std::string &text) const {
    if (m_isJson)
        return;
    const std::size_t ended = m_done + m_doneBefore + m_failures.size() + m_passedOver.size();
    std::puts(printable(fmt::format("{} of {}: {}", ended, m_studies, text)).c_str());
    std::fflush(stdout);
}

void BatchReport::wasDoneBefore() {
    const std::lock_guard lock(m_mutex);
    ++m_doneBefore;
}

void BatchReport::passedOver(const std::string &key) {
    const std::lock_guard lock(m_mutex);
    m_passedOver.push_back(key);
    printLine(key + ": no series matches the recipe");
}

void BatchReport::failed(const std::string &key, const std::string &reason) {
    const std::lock_guard lock(m_mutex);
    m_failures.push_back({key, reason});
    printLine(key + ": failed");
    warn(reason.find(key) == std::string::npos ? key + ": " + reason : reason);
}

void BatchReport::print(const std::string &recipe, double seconds) {
    std::sort(m_failures.begin(), m_failures.end(),
              [](const Failure &a, const Failure &b) { return a.key < b.key; });
    std::sort(m_passedOver.begin(), m_passedOver.end());
    std::sort(m_finished.begin(), m_finished.end(),
              [](const Finished &a, const Finished &b) { return a.key < b.key; });
    if (m_isJson) {
        json finished = json::array(), failures = json::array();
        for (const Finished &study : m_finished)
            finished.push_back({{"study", study.key},
                                {"series", study.seriesUid},
                                {"error", study.error},
                                {"warnings", study.warnings},
                                {"seconds", study.seconds}});
        for (const Failure &failure : m_failures)
            failures.push_back({{"study", failure.key}, {"reason", failure.reason}});
        std::puts(jsonText({{"studies", m_studies},
                            {"done", m_done},
                            {"finished", finished},
                            {"skipped", m_doneBefore},
                            {"failed", failures},
                            {"without_such_a_series", m_passedOver},
                            {"beyond_tolerance", m_imprecise},
                            {"damaged_files", jsonOf(m_damaged)},
                            {"unused_files", jsonOf(m_unused)},
                            {"recipe", recipe},
                            {"seconds", seconds}})
                      .c_str());
        return;
    }
    std::string text = fmt::format("{} of {} done", m_done, studiesText(m_studies));
    if (m_doneBefore > 0)
        text += fmt::format(", {} done before", m_doneBefore);
    if (!m_failures.empty())
        text += fmt::format(", {} failed", m_failures.size());
    if (!m_passedOver.empty())
        text += fmt::format(", {} without a series that the recipe asks for", m_passedOver.size());
    if (m_imprecise > 0)
        text += fmt::format(", {} beyond the tolerance", m_imprecise);
    if (!m_damaged.empty())
        text += fmt::format("; damaged files: {}", m_damaged.size());
    std::puts(fmt::format("{}; {:.1f} s", text, seconds).c_str());
}

void BatchReport::requireAllDone() const {
    if (!m_failures.empty())
        throw Error(ErrorCode::incomplete,
                    because::inWords(
                        fmt::format("{} of {} failed", m_failures.size(), studiesText(m_studies))));
    if (!m_damaged.empty())
        throw Error(
            ErrorCode::incomplete,
            because::inWords(fmt::format("damaged files: {}; the first: {}", m_damaged.size(),
                                         m_damaged.front().reason.english())),
            m_damaged.front().path);
}

} // namespace pellucid::cli
