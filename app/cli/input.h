// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/cli/commands.h"
#include "app/cli/fetched_study.h"
#include "core/classify/density_field.h"
#include "core/dicom/catalogue.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/write_capture.h"
#include "core/subtraction/rigid_registration.h"

namespace pellucid::cli {

/// The volume that a command works on, and what scanning and loading reported.
struct Input {
    dicom::LoadedVolume loaded;
    std::string seriesUid, seriesDescription;
    dicom::CaptureLabels labels; ///< for pictures of the volume
    std::vector<dicom::Skipped> skipped;
    double scanMs = 0.0, loadMs = 0.0;
    /// How the subtracted volume was aligned, if it was.
    std::optional<subtraction::Registration> registration;
};

/// Rejects an empty text.
CLI::Validator notEmpty();

/// The options that select a command's input.
struct InputOptions {
    std::string path, series;
    RemoteOptions remote;
    int volume = 0; ///< number within the series, from 1; 0 selects the default
    bool fillGaps = false, large = false;
    std::string subtract, subtractSeries, alignment, ///< of a volume that is subtracted
        weights;                                     ///< of both
};

/// Adds --allow-unprotected, for commands that work through what strangers send while nobody looks.
void addProtectionOption(CLI::App &command, bool &allowsUnprotected);
/// *Throws* Error{usage} if the system cannot confine the helpers, unless that is allowed.
void requireProtection(const std::string &command, bool allowsUnprotected);

/// Adds --large.
void addLargeOption(CLI::App &command, bool &large);

/// Adds PATH, --from, --study, --series, --volume, --fill-gaps and --large.
void addInputOptions(CLI::App &command, InputOptions &options);
/// Adds --subtract, --subtract-series, --register and --weights.
void addSubtractionOptions(CLI::App &command, InputOptions &options);

/// Scans a path and loads one volume: that of the given series, or the one with the most voxels;
/// and subtracts another one, if the options name it. Warns on stderr about unused files and other
/// series and volumes. *Throws* Error{unusable} naming the path; Error{outOfMemory} if files were
/// skipped for lack of memory; Error{usage} if one of `outs` is an input file.
Input openInput(const InputOptions &options, const std::vector<std::filesystem::path> &outs,
                const Context &context);

/// Runs `work`. *Throws* as `work`; a lack of memory names the input `path`.
void naming(const std::filesystem::path &path, const std::function<void()> &work);

/// *Throws* the reason why the catalogue has no usable images: Error{unusable} naming a file and
/// its reason, or Error{outOfMemory}.
[[noreturn]] void failWithoutImages(const dicom::Catalogue &catalogue,
                                    const std::filesystem::path &path);

/// "LO,HI". *Throws* Error{usage}.
classify::FieldWindow parseWindow(const std::string &text);

/// Exactly `count` finite decimal numbers, separated by a character. Not CLI11's `delimiter` and
/// `expected`, which accept `nan`, hexadecimal numbers and empty parts. *Throws* Error{usage}
/// naming the option.
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
