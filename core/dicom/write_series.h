// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::dicom {

enum class TransferSyntax {
    implicitLittle,
    explicitLittle,
    explicitBig,
    deflated,
    rle,
    jpegLossless,
    jpegLs,
    jpeg2000
};

/// *Throws* Error{usage} for an unknown name; the message lists the known ones.
TransferSyntax transferSyntaxFromName(const std::string &name);
std::vector<std::string> transferSyntaxNames();

/// The attributes of a written series.
struct SeriesLabels {
    std::string patientName, patientId, studyDescription, seriesDescription, bodyPart;
    int seriesNumber = 1;
    std::vector<volume::ValueWindow> windows;
};

/// Writes a CT volume of int16 HU losslessly as one file per slice, IM0001.dcm and so on, signed 16
/// bits. Creates the folder if necessary; an existing file of such a name is an error. Writes
/// either all files or none. *Throws* Error{output}, Error{usage} if the volume is not int16,
/// Cancelled.
void writeCtSeries(const std::filesystem::path &folder, const volume::Volume &volume,
                   const SeriesLabels &labels, TransferSyntax syntax,
                   const task::Progress &progress = {});

} // namespace pellucid::dicom
