// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dcmtk/dictionary.h"

#include <cstdlib>
#include <filesystem>
#include <string>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpeg/djencode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <dcmtk/dcmjpls/djencode.h>

#include "core/dcmtk/reasons.h"
#include "core/files/user_folders.h"
#include "core/task/error.h"

namespace pellucid::dcmtk {

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
            ::setenv("DCMDICTPATH", paths.c_str(), 0);
    }
}

} // namespace

void prepareDcmtk() {
    static const bool loaded = [] {
        findDictionaries();
        // DCMTK logs every odd file to the console; reasons are returned as values instead.
        OFLog::configure(OFLogger::OFF_LOG_LEVEL);
        // Attributes from systems that did not know them arrive as UN.
        dcmEnableUnknownVRConversion.set(OFTrue);
        DcmRLEDecoderRegistration::registerCodecs();
        DcmRLEEncoderRegistration::registerCodecs();
        // Accepts pixels of defined length under a compressed syntax; the decoder checks what they
        // are.
        dcmUseExplLengthPixDataForEncTS.set(OFTrue);
        // Cornell's codec wrote 16-bit differences that others truncate.
        constexpr auto predictor6 = OFFalse, cornell = OFTrue;
        DJDecoderRegistration::registerCodecs(EDC_photometricInterpretation, EUC_default,
                                              EPC_default, predictor6, cornell);
        DJEncoderRegistration::registerCodecs();
        DJLSDecoderRegistration::registerCodecs();
        DJLSEncoderRegistration::registerCodecs();
        return dcmDataDict.isDictionaryLoaded() == OFTrue;
    }();
    if (!loaded)
        throw task::Error(task::ErrorCode::internal, task::because::dictionaryMissing);
}

} // namespace pellucid::dcmtk
