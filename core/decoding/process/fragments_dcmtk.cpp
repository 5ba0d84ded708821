// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/fragments.h"

#include <algorithm>
#include <cstring>
#include <map>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>

#include "core/decoding/process/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;

[[noreturn]] void fail(const task::Reason &reason) {
    throw task::Error(task::ErrorCode::unusable, reason);
}

DcmPixelSequence *sequenceOf(DcmDataset &dataset, DcmElement *&element) {
    element = nullptr;
    dataset.findAndGetElement(DCM_PixelData, element);
    auto *const pixels = dynamic_cast<DcmPixelData *>(element);
    DcmPixelSequence *sequence = nullptr;
    E_TransferSyntax syntax = EXS_Unknown;
    const DcmRepresentationParameter *parameter = nullptr;
    if (pixels == nullptr)
        fail(because::compressedPixelsNotReadable);
    pixels->getOriginalRepresentationKey(syntax, parameter);
    if (pixels->getEncapsulatedRepresentation(syntax, parameter, sequence).bad())
        return nullptr;
    return sequence;
}

// Offsets count from the first byte after the table; each fragment is preceded by eight bytes.
std::vector<std::size_t> startsByTable(Bytes table, const std::vector<Bytes> &fragments) {
    std::map<std::uint32_t, std::size_t> places;
    std::uint64_t at = 0;
    for (std::size_t n = 0; n < fragments.size() && at <= 0xFFFFFFFF; ++n) {
        places[std::uint32_t(at)] = n;
        at += 8 + fragments[n].size();
    }
    std::vector<std::size_t> starts;
    for (std::size_t n = 0; n + 4 <= table.size(); n += 4) {
        std::uint32_t offset = 0;
        for (std::size_t byte = 0; byte < 4; ++byte)
            offset |= std::to_integer<std::uint32_t>(table[n + byte]) << (8 * byte);
        const auto it = places.find(offset);
        if (it == places.end() || (!starts.empty() && it->second <= starts.back()))
            return {};
        starts.push_back(it->second);
    }
    return !starts.empty() && starts.front() == 0 ? starts : std::vector<std::size_t>();
}

} // namespace

CompressedFrames::CompressedFrames(DcmDataset &dataset, std::size_t frames,
                                   const std::function<bool(Bytes)> &startsFrame) {
    DcmElement *element = nullptr;
    DcmPixelSequence *const sequence = sequenceOf(dataset, element);
    Bytes table;
    if (sequence != nullptr) {
        // Iterates, because access by index counts from the first item each time.
        for (DcmObject *object = sequence->nextInContainer(nullptr); object != nullptr;
             object = sequence->nextInContainer(object)) {
            auto *const item = dynamic_cast<DcmPixelItem *>(object);
            Uint8 *data = nullptr;
            if (item == nullptr ||
                (item->getLength() > 0 && (item->getUint8Array(data).bad() || data == nullptr)))
                fail(because::fragmentNotReadable);
            const Bytes bytes(reinterpret_cast<const std::byte *>(data),
                              data == nullptr ? 0 : item->getLength());
            if (object == sequence->nextInContainer(nullptr))
                table = bytes;
            else
                m_fragments.push_back(bytes);
        }
    } else {
        Uint8 *data = nullptr;
        if (element->getUint8Array(data).bad() || data == nullptr)
            fail(because::compressedPixelsNotReadable);
        m_fragments.emplace_back(reinterpret_cast<const std::byte *>(data), element->getLength());
    }
    if (frames == 1 && !m_fragments.empty()) { // whatever its fragments start with
        m_starts = {0};
    } else if (m_fragments.size() == frames) {
        for (std::size_t n = 0; n < frames; ++n)
            m_starts.push_back(n);
    } else {
        m_starts = startsByTable(table, m_fragments);
        if (m_starts.size() != frames) {
            m_starts.clear();
            for (std::size_t n = 0; n < m_fragments.size(); ++n)
                if (startsFrame(m_fragments[n]))
                    m_starts.push_back(n);
        }
    }
    if (m_starts.size() != frames || m_starts.front() != 0)
        fail(because::holdsOtherFrames(std::max(m_starts.size(), m_fragments.size()), frames));
    m_starts.push_back(m_fragments.size());
}

std::vector<std::byte> CompressedFrames::frame(std::size_t n) const {
    std::vector<std::byte> bytes;
    for (std::size_t fragment = m_starts[n]; fragment < m_starts[n + 1]; ++fragment)
        bytes.insert(bytes.end(), m_fragments[fragment].begin(), m_fragments[fragment].end());
    return bytes;
}

bool beginsCodestream(Bytes fragment) {
    if (fragment.size() < 4)
        return false;
    const auto byte = [&](std::size_t n) { return std::to_integer<int>(fragment[n]); };
    return (byte(0) == 0xFF && (byte(1) == 0x4F || byte(1) == 0xD8 || byte(1) == 0x0A)) ||
           (fragment.size() >= 12 && (std::memcmp(fragment.data() + 4, "jP  ", 4) == 0 ||
                                      std::memcmp(fragment.data() + 4, "JXL ", 4) == 0));
}

} // namespace pellucid::decoding::process
