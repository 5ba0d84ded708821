// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/dicom/catalogue.h"

namespace pellucid::batch {

/// What was made of a study, in its file `done.json`.
struct DoneRecord {
    struct MadeFile {
        std::string name;
        std::uint64_t bytes = 0;
    };
    struct MadeOutput {
        std::string name;
        double tolerance = 0.0, predictedError = 0.0; ///< relative L2, of any view
        std::optional<double> measuredError;          ///< of the worst measured view
        std::vector<std::string> warnings;
    };
    std::string program;        ///< its name and version
    std::string recipe, inputs; ///< digests
    std::string studyUid, seriesUid;
    std::vector<MadeFile> files; ///< empty if they were only sent
    std::vector<MadeOutput> outputs;
    std::string sentTo; ///< the name of a server, if any
    double loadSeconds = 0.0, renderSeconds = 0.0;
};

inline constexpr const char *doneFile = "done.json";

std::string toJson(const DoneRecord &record);
/// That of a folder; none if it is missing or is no such record.
std::optional<DoneRecord> doneIn(const std::filesystem::path &folder);

/// Whether a folder has all results of this recipe for these inputs, by this program.
bool isDone(const std::filesystem::path &folder, const DoneRecord &wanted);

/// A file of a study. `changing`: the archive that contains it, or the file itself.
struct InputFile {
    std::filesystem::path path, changing;
};
/// A digest of the files of a study: their names, sizes and times of change.
std::string digestOf(const std::vector<InputFile> &files);
/// A digest of these instances, in whatever order.
std::string digestOf(std::vector<std::string> sopInstanceUids);

/// The part, 0 to `count` - 1, of a batch in `count` parts that a study belongs to: the same on
/// every machine.
int shardOf(const std::string &key, int count);

} // namespace pellucid::batch
