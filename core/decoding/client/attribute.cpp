// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/attribute.h"

#include <fmt/format.h>

namespace pellucid::decoding {

std::string tagText(const Attribute &attribute) {
    return attribute.tag == 0
               ? std::string()
               : fmt::format("({:04x},{:04x})", attribute.tag >> 16, attribute.tag & 0xFFFFU);
}

} // namespace pellucid::decoding
