// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/cli/commands.h"
#include "core/classify/density_field.h"
#include "core/dicom/catalogue.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/write_capture.h"

namespace pellucid::cli {

/// A volume that a command works on, with everything that was said on the way.
struct Input {
    dicom::LoadedVolume loaded;
    std::string seriesUid, seriesDescription;
    dicom::CaptureLabels labels; ///< of pictures that are made of it
    std::vector<dicom::Skipped> skipped;
    double scanMs = 0.0, loadMs = 0.0;
};

/// For options whose text says something.
CLI::Validator notEmpty();

/// What a command opens.
struct InputOptions {
    std::string path, series;
    int volume = 0; ///< of the series, 1-based; 0 selects the default
    bool fillGaps = false, large = false;
};

/// --large, of a command that opens something.
void addLargeOption(CLI::App &command, bool &large);

/// PATH, --series, --volume, --fill-gaps and --large.
void addInputOptions(CLI::App &command, InputOptions &options);

/// Scans a path and loads one volume of it: of the series named, else the one with most voxels.
/// What is not used or not shown is said on stderr. *Throws* Error{unusable} naming the path,
/// Error{outOfMemory} if the volume is missing for want of it;
/// Error{usage} if one of `outs` is one of the files that are read.
Input openInput(const InputOptions &options, const std::vector<std::filesystem::path> &outs,
                const Context &context);

/// Does work on an input. *Throws* as the work; what lacks memory names the input.
void naming(const std::filesystem::path &path, const std::function<void()> &work);

/// Why nothing of what was found can be used. *Throws* Error{unusable} naming a file and its
/// reason, or Error{outOfMemory}.
[[noreturn]] void failWithoutImages(const dicom::Catalogue &catalogue,
                                    const std::filesystem::path &path);

/// "LO,HI". *Throws* Error{usage}.
classify::FieldWindow parseWindow(const std::string &text);

/// Numbers separated by a character, exactly `count`. *Throws* Error{usage} naming the option.
std::vector<double> parseNumbers(const std::string &option, const std::string &text, char separator,
                                 std::size_t count);

/// Milliseconds since the last call on the same object.
class Stopwatch {
public:
    Stopwatch();
    double lapMs();

private:
    double m_last;
};

} // namespace pellucid::cli
