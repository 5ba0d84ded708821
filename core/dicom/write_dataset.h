// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

class DcmFileFormat;
class DcmItem;
class DcmTagKey;

namespace pellucid::dicom {

/// A number as a decimal string of at most 16 characters; several are joined by backslashes.
std::string decimal(double value);
std::string decimals(std::initializer_list<double> values);

/// The kinds of new UIDs below this program's root.
enum class UidKind { study, series, instance };
std::string newUid(UidKind kind);
/// A UID that reveals neither machine nor time (PS3.5, B.2: 2.25 and 128 random bits).
std::string randomUid();

/// *Throws* Error{internal} if the attribute does not accept the value.
void put(DcmItem &dataset, const DcmTagKey &tag, const std::string &value);

/// Writes a file in the transfer syntax (DCMTK's E_TransferSyntax) that its pixels already have. It
/// appears only when complete. *Throws* Error{output}, also if the disk is full.
void writeDataset(DcmFileFormat &file, int transferSyntax, const std::filesystem::path &path);

} // namespace pellucid::dicom
