// SPDX-License-Identifier: GPL-3.0-or-later
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "core/dcmtk/codecs.h"
#include "core/decoding/process/damage.h"
#include "core/decoding/process/dataset.h"
#include "core/decoding/process/memory_input.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

DirectoryFile parsed(std::span<const std::byte> bytes) {
    dcmtk::prepareDcmtk();
    DirectoryFile directory;
    OFString sopClass;
    {
        const auto input = memoryInput(bytes);
        DcmMetaInfo meta;
        meta.transferInit();
        const OFCondition read = meta.read(*input, EXS_Unknown, EGL_noChange, 64);
        meta.transferEnd();
        if (read.bad() || meta.findAndGetOFString(DCM_MediaStorageSOPClassUID, sopClass).bad() ||
            sopClass != UID_MediaStorageDirectoryStorage)
            return directory;
    }
    directory.isDirectory = true;
    const auto input = memoryInput(bytes);
    DcmFileFormat file;
    file.transferInit();
    const OFCondition loaded = file.read(*input, EXS_Unknown, EGL_noChange);
    file.transferEnd();
    if (loaded.bad() || file.getDataset() == nullptr)
        throw task::Error(task::ErrorCode::unusable, task::because::isNotReadable(loaded.text()));
    dropUnreadable(*file.getDataset());
    // Reads every record of the flat sequence; the offsets that make it a tree are often wrong, and
    // not needed to find the files.
    constexpr unsigned long deepest = 16; // DICOM needs 8
    DcmSequenceOfItems *records = nullptr;
    if (file.getDataset()->findAndGetSequence(DCM_DirectoryRecordSequence, records).bad() ||
        records == nullptr)
        return directory;
    for (unsigned long n = 0; n < records->card(); ++n) {
        std::vector<std::string> parts;
        OFString part;
        while (parts.size() < deepest &&
               records->getItem(n)
                   ->findAndGetOFString(DCM_ReferencedFileID, part,
                                        static_cast<unsigned long>(parts.size()))
                   .good() &&
               !part.empty())
            parts.emplace_back(part.c_str());
        if (!parts.empty())
            directory.files.push_back(std::move(parts));
    }
    return directory;
}

} // namespace

DirectoryFile parseDirectory(std::span<const std::byte> bytes) {
    return orDamaged([&] { return parsed(bytes); });
}

} // namespace pellucid::decoding::process
