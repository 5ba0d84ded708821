// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

class DcmFileFormat;
class DcmItem;
class DcmTagKey;

namespace pellucid::dicom {

/// A number as a decimal string, which holds 16 characters at most; several with backslashes.
std::string decimal(double value);
std::string decimals(std::initializer_list<double> values);

/// A new UID below this program's root.
enum class UidKind { study, series, instance };
std::string newUid(UidKind kind);
/// One that tells neither the machine nor the time (PS3.5, B.2: 2.25 and 128 random bits).
std::string randomUid();

/// *Throws* Error{internal} if the attribute does not take the value.
void put(DcmItem &dataset, const DcmTagKey &tag, const std::string &value);

/// Writes a file in a transfer syntax (DCMTK's E_TransferSyntax) that its pixels already have; it
/// appears only when complete. *Throws* Error{output}, when the disk is full too.
void writeDataset(DcmFileFormat &file, int transferSyntax, const std::filesystem::path &path);

} // namespace pellucid::dicom
