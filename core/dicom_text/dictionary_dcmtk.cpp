// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom_text/dictionary.h"

#include <cstdlib>
#include <filesystem>
#include <string>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "core/dicom_text/reasons.h"
#include "core/files/user_folders.h"
#include "core/platform/process.h"
#include "core/task/error.h"

namespace pellucid::dicom_text {

namespace {

// An installation with its own libraries has DCMTK's dictionaries there, too.
void findDictionaries() {
    const auto own = files::programFolder();
    std::error_code ignored;
    for (const char *const place :
         {"share/pellucid", "../share/pellucid", "../../share/pellucid"}) {
        std::string paths;
        for (const char *const name : {"dicom.dic", "private.dic"})
            if (const auto path = own / place / name; std::filesystem::exists(path, ignored))
                paths += (paths.empty() ? "" : ":") + path.string();
        if (!paths.empty())
            platform::setMissingVariable("DCMDICTPATH", paths);
    }
}

} // namespace

void prepareDictionary() {
    static const bool loaded = [] {
        findDictionaries();
        // DCMTK logs every odd file to the console; reasons are returned as values instead.
        OFLog::configure(OFLogger::OFF_LOG_LEVEL);
        // Attributes from systems that did not know them arrive as UN.
        dcmEnableUnknownVRConversion.set(OFTrue);
        return dcmDataDict.isDictionaryLoaded() == OFTrue;
    }();
    if (!loaded)
        throw task::Error(task::ErrorCode::internal, task::because::dictionaryMissing);
}

} // namespace pellucid::dicom_text
