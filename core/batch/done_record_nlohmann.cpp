// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/batch/done_record.h"

#include <algorithm>
#include <chrono>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/files/json_value_nlohmann.h"
#include "core/files/read_text.h"
#include "core/system/content_digest.h"
#include "core/task/error.h"

namespace pellucid::batch {

namespace {

namespace fs = std::filesystem;
using files::JsonValue;
using nlohmann::json;

constexpr std::uintmax_t maxRecordBytes = std::uintmax_t(4) << 20;

std::string digest(const std::string &text) {
    return system::contentDigest(std::as_bytes(std::span(text)));
}

} // namespace

std::string toJson(const DoneRecord &record) {
    json files = json::array(), outputs = json::array();
    for (const DoneRecord::MadeFile &file : record.files)
        files.push_back({{"name", file.name}, {"bytes", file.bytes}});
    for (const DoneRecord::MadeOutput &output : record.outputs) {
        outputs.push_back({{"name", output.name},
                           {"tolerance", output.tolerance},
                           {"predicted_error", output.predictedError},
                           {"warnings", output.warnings}});
        if (output.measuredError)
            outputs.back()["measured_error"] = *output.measuredError;
    }
    json out{{"program", record.program},
             {"recipe", record.recipe},
             {"inputs", record.inputs},
             {"study_uid", record.studyUid},
             {"series_uid", record.seriesUid},
             {"files", files},
             {"outputs", outputs},
             {"seconds", {{"load", record.loadSeconds}, {"render", record.renderSeconds}}}};
    if (!record.sentTo.empty())
        out["sent_to"] = record.sentTo;
    return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::optional<DoneRecord> doneIn(const fs::path &folder) {
    try {
        const json whole = json::parse(files::readText(folder / doneFile, maxRecordBytes));
        const JsonValue in(whole);
        DoneRecord record;
        record.program = in.at("program").text();
        record.recipe = in.at("recipe").text();
        record.inputs = in.at("inputs").text();
        record.studyUid = in.at("study_uid").text();
        record.seriesUid = in.at("series_uid").text();
        for (const JsonValue &file : in.at("files").elements()) {
            constexpr double largest = 9007199254740992.0; // whole numbers up to 2^53 are exact
            const double bytes = file.at("bytes").number(largest);
            record.files.push_back({file.at("name").text(), std::uint64_t(std::max(0.0, bytes))});
        }
        for (const JsonValue &output : in.at("outputs").elements()) {
            record.outputs.push_back({output.at("name").text(),
                                      output.at("tolerance").number(),
                                      output.at("predicted_error").number(),
                                      {},
                                      {}});
            if (const JsonValue measured = output["measured_error"])
                record.outputs.back().measuredError = measured.number();
            for (const JsonValue &warning : output.at("warnings").elements())
                record.outputs.back().warnings.push_back(warning.text());
        }
        if (const JsonValue sentTo = in["sent_to"])
            record.sentTo = sentTo.text();
        record.loadSeconds = in.at("seconds").at("load").number();
        record.renderSeconds = in.at("seconds").at("render").number();
        return record;
    } catch (const task::Error &) {
        return std::nullopt;
    } catch (const json::exception &) {
        return std::nullopt;
    }
}

bool isDone(const fs::path &folder, const DoneRecord &wanted) {
    const std::optional<DoneRecord> done = doneIn(folder);
    return done && done->program == wanted.program && done->recipe == wanted.recipe &&
           done->inputs == wanted.inputs && done->sentTo == wanted.sentTo &&
           std::all_of(done->files.begin(), done->files.end(),
                       [&](const DoneRecord::MadeFile &file) {
                           std::error_code failed;
                           const auto bytes = fs::file_size(folder / file.name, failed);
                           return !failed && bytes == file.bytes;
                       });
}

std::string digestOf(const std::vector<InputFile> &files) {
    std::vector<std::string> lines;
    for (const InputFile &file : files) {
        std::error_code unknown;
        const auto bytes = fs::file_size(file.path, unknown);
        const auto time = fs::last_write_time(file.changing, unknown).time_since_epoch();
        const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
        lines.push_back(fmt::format("{} {} {}", file.path.filename().string(), bytes, ns));
    }
    return digestOf(std::move(lines));
}

std::string digestOf(std::vector<std::string> sopInstanceUids) {
    std::sort(sopInstanceUids.begin(), sopInstanceUids.end());
    std::string text;
    for (const std::string &uid : sopInstanceUids)
        text += uid + "\n";
    return digest(text);
}

int shardOf(const std::string &key, int count) {
    // The last digits are as random as any.
    constexpr std::size_t digits = 15;
    const std::string hex = digest(key);
    return int(std::stoull(hex.substr(hex.size() - digits), nullptr, 16) %
               std::uint64_t(std::max(1, count)));
}

} // namespace pellucid::batch
