// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/log.h"

#include <utility>

namespace pellucid::system {

namespace {

LogSink &sinkInUse() {
    static LogSink sink;
    return sink;
}

} // namespace

void setLogSink(LogSink sink) {
    sinkInUse() = std::move(sink);
}

void log(const std::string &line) {
    if (const LogSink &sink = sinkInUse())
        sink(line);
}

} // namespace pellucid::system
