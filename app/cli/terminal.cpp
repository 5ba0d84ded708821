// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/terminal.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "app/cli/reasons.h"
#include "core/platform/terminal.h"
#include "core/system/utf8.h"
#include "core/task/error.h"
#include "core/task/progress.h"

namespace pellucid::cli {

std::string escapedControls(const std::string &json) {
    std::string escaped;
    for (std::size_t at = 0; at < json.size();) {
        const system::CodePoint point = system::codePointAt(json, at);
        const std::size_t bytes = std::max<std::size_t>(1, point.bytes);
        const unsigned code = point.code;
        if (code > 0xFFFF && system::isHidden(code)) // in UTF-16: two halves
            escaped +=
                fmt::format("\\u{:04x}\\u{:04x}", 0xD7C0 + (code >> 10), 0xDC00 + (code & 0x3FFU));
        else if (code >= 0x7F && (system::isControl(code) || system::isHidden(code)))
            escaped += fmt::format("\\u{:04x}", code);
        else
            escaped.append(json, at, bytes);
        at += bytes;
    }
    return escaped;
}

std::string counted(std::size_t count, const std::string &noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string askHidden(const std::string &question, const std::stop_token &stop) {
    platform::HiddenAnswer answer = platform::askHidden(question, stop);
    if (!answer.isAsked)
        throw task::Error(task::ErrorCode::usage, task::because::passwordNeedsATerminal);
    if (!answer.line)
        throw task::Cancelled();
    return *std::move(answer.line);
}

void warn(const std::string &what) {
    std::fprintf(stderr, "pellucid-cli: warning: %s\n", printable(what).c_str());
}

} // namespace pellucid::cli
