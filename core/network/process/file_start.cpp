// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/file_start.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "core/files/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::network::process {

namespace {

constexpr std::size_t preamble = 132, longestMetaHeader = 64 << 10;
constexpr const char *implicitSyntax = "1.2.840.10008.1.2", *explicitSyntax = "1.2.840.10008.1.2.1",
                     *bigEndianSyntax = "1.2.840.10008.1.2.2",
                     *deflatedSyntax = "1.2.840.10008.1.2.1.99";

[[noreturn]] void fail() {
    throw task::Error(task::ErrorCode::unusable, task::because::isNotDicom);
}

template <class T>
T numberAt(std::span<const std::byte> bytes, std::size_t at, bool isBigEndian = false) {
    std::uint32_t value = 0;
    for (std::size_t n = 0; n < sizeof(T); ++n) {
        const std::size_t from = at + (isBigEndian ? n : sizeof(T) - 1 - n);
        value = value << 8 | std::to_integer<std::uint32_t>(bytes[from]);
    }
    return T(value);
}

std::string textAt(std::span<const std::byte> bytes, std::size_t at, std::size_t length) {
    std::string text(reinterpret_cast<const char *>(bytes.data()) + at, length);
    while (!text.empty() && (text.back() == '\0' || text.back() == ' '))
        text.pop_back();
    return text;
}

// An element's place. *Shape*: of its value.
struct Element {
    std::uint16_t group = 0, number = 0;
    std::size_t begin = 0, end = 0;
};

// The element at a place; nothing if more bytes are needed.
std::optional<Element> elementAt(std::span<const std::byte> bytes, std::size_t at,
                                 bool isExplicit = true, bool isBigEndian = false) {
    constexpr std::size_t longestHead = 12;
    if (bytes.size() < at + longestHead)
        return std::nullopt;
    Element element{numberAt<std::uint16_t>(bytes, at, isBigEndian),
                    numberAt<std::uint16_t>(bytes, at + 2, isBigEndian)};
    const std::string vr = textAt(bytes, at + 4, 2);
    const bool isLong = vr == "OB" || vr == "OW" || vr == "UN" || vr == "UT" || vr == "SQ";
    element.begin = at + (isExplicit && isLong ? 12 : 8);
    element.end = element.begin + (!isExplicit ? numberAt<std::uint32_t>(bytes, at + 4, isBigEndian)
                                   : isLong    ? numberAt<std::uint32_t>(bytes, at + 8, isBigEndian)
                                            : numberAt<std::uint16_t>(bytes, at + 6, isBigEndian));
    return element;
}

// Some de-identification changes the UIDs of the data set alone: they count. False if more bytes
// are needed.
bool takeDatasetUids(std::span<const std::byte> bytes, std::size_t at, Arrival &arrival) {
    constexpr std::uint16_t group = 0x0008, classNumber = 0x0016, instanceNumber = 0x0018;
    const std::string &syntax = arrival.transferSyntax;
    if (syntax == deflatedSyntax)
        return true;
    for (;;) {
        const auto element =
            elementAt(bytes, at, syntax != implicitSyntax, syntax == bigEndianSyntax);
        if (!element)
            return false;
        // An undefined length, or nonsense: those of the meta header have to do.
        if (element->group > group || element->number > instanceNumber ||
            element->end > longestMetaHeader)
            return true;
        if (bytes.size() < element->end)
            return false;
        std::string *const uid = element->group != group             ? nullptr
                                 : element->number == classNumber    ? &arrival.sopClassUid
                                 : element->number == instanceNumber ? &arrival.sopInstanceUid
                                                                     : nullptr;
        if (uid != nullptr)
            if (const std::string found =
                    textAt(bytes, element->begin, element->end - element->begin);
                isUid(found))
                *uid = found;
        at = element->end;
    }
}

} // namespace

std::optional<FileStart> readFileStart(std::span<const std::byte> start, bool isWhole) {
    const auto more = [&]() -> std::optional<FileStart> {
        if (isWhole)
            fail();
        return std::nullopt;
    };
    if (start.size() < preamble)
        return more();
    if (std::memcmp(start.data() + preamble - 4, "DICM", 4) != 0)
        fail();
    Arrival arrival;
    std::size_t at = preamble;
    for (;;) {
        const auto element = elementAt(start, at);
        if (at > longestMetaHeader)
            fail();
        if (!element)
            return more();
        if (element->group != 0x0002)
            break;
        const std::size_t length = element->end - element->begin;
        if (length > longestMetaHeader)
            fail();
        if (start.size() < element->end)
            return more();
        if (element->number == 0x0002)
            arrival.sopClassUid = textAt(start, element->begin, length);
        else if (element->number == 0x0003)
            arrival.sopInstanceUid = textAt(start, element->begin, length);
        else if (element->number == 0x0010)
            arrival.transferSyntax = textAt(start, element->begin, length);
        at = element->end;
    }
    // Some writers label implicit value representations as explicit, which are two capitals.
    const auto isCapital = [&](std::size_t n) {
        const char c = char(start[n]);
        return c >= 'A' && c <= 'Z';
    };
    if (arrival.transferSyntax == explicitSyntax && !(isCapital(at + 4) && isCapital(at + 5)))
        arrival.transferSyntax = implicitSyntax;
    if (!takeDatasetUids(start, at, arrival) && !isWhole)
        return std::nullopt;
    if (!isUid(arrival.sopClassUid) || !isUid(arrival.sopInstanceUid) ||
        !isUid(arrival.transferSyntax))
        fail();
    return FileStart{arrival, at};
}

FileStart startOf(std::span<const std::byte> file) {
    constexpr std::size_t longest = 2 * longestMetaHeader;
    return *readFileStart(file.first(std::min(file.size(), longest)), true);
}

} // namespace pellucid::network::process
