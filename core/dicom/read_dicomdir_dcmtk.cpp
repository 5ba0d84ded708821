// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "core/dicom/dictionary.h"
#include "core/dicom/read_instance.h"
#include "core/task/error.h"

namespace pellucid::dicom {

namespace {

namespace fs = std::filesystem;

// CDs are written in capitals and mounted in lower case: an entry matches whatever its case.
fs::path child(const fs::path &folder, const std::string &name) {
    std::error_code ignored;
    if (fs::exists(folder / name, ignored))
        return folder / name;
    const auto lower = [](std::string text) {
        std::transform(text.begin(), text.end(), text.begin(),
                       [](unsigned char c) { return char(std::tolower(c)); });
        return text;
    };
    for (const auto &entry : fs::directory_iterator(folder, ignored))
        if (lower(entry.path().filename().string()) == lower(name))
            return entry.path();
    return folder / name;
}

} // namespace

bool isDicomdir(const fs::path &path) {
    prepareDcmtk();
    DcmFileFormat file;
    OFString sopClass;
    return file.loadFile(path.c_str(), EXS_Unknown, EGL_noChange, 64, ERM_metaOnly).good() &&
           file.getMetaInfo() != nullptr &&
           file.getMetaInfo()->findAndGetOFString(DCM_MediaStorageSOPClassUID, sopClass).good() &&
           sopClass == UID_MediaStorageDirectoryStorage;
}

std::vector<fs::path> readDicomdir(const fs::path &path) {
    prepareDcmtk();
    DcmFileFormat file;
    const OFCondition loaded = file.loadFile(path.c_str());
    if (loaded.bad() || file.getDataset() == nullptr)
        throw task::Error(task::ErrorCode::unusable,
                          std::string("is not readable: ") + loaded.text(), path);
    // Every record of the flat sequence is looked at; the offsets that make it a tree are often
    // wrong and not needed to find the files.
    std::vector<fs::path> files;
    DcmSequenceOfItems *records = nullptr;
    if (file.getDataset()->findAndGetSequence(DCM_DirectoryRecordSequence, records).bad() ||
        records == nullptr)
        return files;
    for (unsigned long n = 0; n < records->card(); ++n) {
        fs::path target = path.parent_path();
        OFString part;
        unsigned long depth = 0;
        for (; depth < 16 &&
               records->getItem(n)->findAndGetOFString(DCM_ReferencedFileID, part, depth).good() &&
               !part.empty();
             ++depth) {
            // A component must be a plain name: an index may not lead out of its own folder.
            const std::string name(part.c_str());
            if (name == ".." || name.find('/') != std::string::npos)
                throw task::Error(task::ErrorCode::unusable, "lists a file outside its folder",
                                  path);
            target = child(target, name);
        }
        if (depth > 0)
            files.push_back(target);
    }
    return files;
}

} // namespace pellucid::dicom
