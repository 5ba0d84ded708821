// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parse/decoder_warnings.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/oflog/logger.h>
#include <dcmtk/oflog/nullap.h>
#include <dcmtk/oflog/oflog.h>
#include <dcmtk/oflog/spi/logevent.h>

namespace pellucid::parse {

namespace {

namespace log = dcmtk::log4cplus;

bool isDamaged = false;

class Listener : public log::NullAppender {
    void append(const log::spi::InternalLoggingEvent &event) override {
        const OFString &said = event.getMessage();
        // Of the JPEG library and of the run length decoder.
        for (const char *const what : {"Corrupt JPEG", "Premature end", "insufficient data"})
            isDamaged = isDamaged || said.find(what) != OFString_npos;
    }
};

} // namespace

DecoderWarnings::DecoderWarnings() {
    isDamaged = false;
    log::Logger root = log::Logger::getRoot();
    root.removeAllAppenders();
    root.addAppender(log::SharedAppenderPtr(new Listener));
    root.setLogLevel(OFLogger::WARN_LOG_LEVEL);
}

DecoderWarnings::~DecoderWarnings() {
    log::Logger::getRoot().setLogLevel(OFLogger::OFF_LOG_LEVEL);
}

bool DecoderWarnings::sayDamaged() const {
    return isDamaged;
}

} // namespace pellucid::parse
