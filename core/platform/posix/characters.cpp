// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/characters.h"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <iconv.h>

namespace pellucid::platform {

std::string utf8Of(const std::string &bytes, const std::string &characterSet) {
    const iconv_t converter = ::iconv_open("UTF-8", characterSet.c_str());
    if (reinterpret_cast<std::intptr_t>(converter) == -1)
        return "?";
    std::string from = bytes, out(4 * bytes.size() + 8, '\0');
    char *in = from.data(), *to = out.data();
    std::size_t left = from.size(), space = out.size();
    while (::iconv(converter, &in, &left, &to, &space) == std::size_t(-1) && space > 0) {
        *to++ = '?';
        --space;
        if (errno != EILSEQ || left == 0)
            break;
        ++in;
        --left;
    }
    ::iconv_close(converter);
    out.resize(out.size() - space);
    return out;
}

// The tables of glibc are libraries, which stay loaded as long as a converter is open.
void openCharacterTables() {
    for (const char *const set : characterSets)
        (void)::iconv_open("UTF-8", set); // left open on purpose
}

} // namespace pellucid::platform
