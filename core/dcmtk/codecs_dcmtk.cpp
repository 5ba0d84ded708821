// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dcmtk/codecs.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpeg/djencode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <dcmtk/dcmjpls/djencode.h>

#include "core/dicom_text/dictionary.h"

namespace pellucid::dcmtk {

void prepareDcmtk() {
    dicom_text::prepareDictionary();
    [[maybe_unused]] static const bool registered = [] {
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
        return true;
    }();
}

} // namespace pellucid::dcmtk
