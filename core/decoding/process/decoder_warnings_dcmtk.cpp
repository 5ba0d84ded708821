// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/decoder_warnings.h"

#include <cstdio>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/oflog/logger.h>
#include <dcmtk/oflog/nullap.h>
#include <dcmtk/oflog/oflog.h>
#include <dcmtk/oflog/spi/logevent.h>

namespace pellucid::decoding::process {

namespace {

namespace log = dcmtk::log4cplus;

bool isDamaged = false;

class Listener : public log::NullAppender {
    void append(const log::spi::InternalLoggingEvent &event) override {
        const OFString &message = event.getMessage();
        // A byte or two between the end of the pixels and the next marker is padding; more means
        // that the decoder lost synchronisation.
        constexpr int maxPadding = 3;
        int extraneous = 0;
        if (std::sscanf(message.c_str(), "Corrupt JPEG data: %d extraneous", &extraneous) == 1 &&
            extraneous <= maxPadding)
            return;
        for (const char *const text :
             {"Corrupt JPEG", "Premature end"}) // messages of the JPEG library
            isDamaged = isDamaged || message.find(text) != OFString_npos;
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

bool DecoderWarnings::foundDamage() const {
    return isDamaged;
}

} // namespace pellucid::decoding::process
