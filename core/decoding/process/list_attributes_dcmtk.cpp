// SPDX-License-Identifier: GPL-3.0-or-later
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <fmt/format.h>

#include "core/decoding/process/damage.h"
#include "core/decoding/process/dataset.h"
#include "core/decoding/process/load_file.h"
#include "core/decoding/process/parse.h"
#include "core/dicom_text/attributes.h"
#include "core/dicom_text/character_sets.h"

namespace pellucid::decoding::process {

using namespace dicom_text;

namespace {

// Longer values are not read into memory, see `loadFile`.
constexpr Uint32 longestValue = 4096;

bool isBulk(const DcmElement &element) {
    switch (element.ident()) {
    case EVR_OB:
    case EVR_OW:
    case EVR_OD:
    case EVR_OF:
    case EVR_OL:
    case EVR_OV:
    case EVR_UN:
    case EVR_PixelData:
    case EVR_ox:
    case EVR_px:
        return true;
    default:
        return false;
    }
}

bool hasLetters(const DcmElement &element) {
    switch (element.ident()) {
    case EVR_LO:
    case EVR_LT:
    case EVR_PN:
    case EVR_SH:
    case EVR_ST:
    case EVR_UC:
    case EVR_UT:
        return true;
    default:
        return false;
    }
}

class Lister {
public:
    explicit Lister(AttributeList &list) : m_list(list) {}

    // False if the list is full.
    bool add(DcmItem &item, const CharacterSets &sets, int depth) {
        for (DcmObject *object = item.nextInContainer(nullptr); object != nullptr;
             object = item.nextInContainer(object)) {
            auto *const element = dynamic_cast<DcmElement *>(object);
            if (element == nullptr)
                continue;
            if (!addElement(item, *element, sets, depth))
                return false;
        }
        return true;
    }

private:
    bool push(Attribute attribute) {
        if (m_list.attributes.size() == maxAttributes)
            return false;
        m_list.attributes.push_back(std::move(attribute));
        return true;
    }

    bool addElement(DcmItem &item, DcmElement &element, const CharacterSets &sets, int depth) {
        DcmTag tag = element.getTag();
        tag.lookupVRinDictionary();
        if (tag.isPrivate())
            item.findAndGetOFString(DcmTagKey(tag.getGroup(), tag.getElement() >> 8), m_creator);
        const std::string name = !tag.isPrivate() ? std::string(tag.getTagName())
                                 : tag.isPrivateReservation()
                                     ? "Private creator"
                                     : fmt::format("Private, {}", m_creator.c_str());
        auto *const sequence = dynamic_cast<DcmSequenceOfItems *>(&element);
        const bool isSequence = sequence != nullptr && element.ident() == EVR_SQ;
        const std::string value =
            isSequence ? fmt::format("{} items", sequence->card()) : valueOf(element, sets);
        if (!push({depth, std::uint32_t(tag.getGroup()) << 16 | tag.getElement(),
                   DcmVR(element.getVR()).getValidVRName(), oneLine(name), value}))
            return false;
        if (!isSequence)
            return true;
        if (depth + 2 > maxAttributeDepth)
            return false;
        for (unsigned long n = 0; n < sequence->card(); ++n)
            if (!push({depth + 1, 0, {}, std::to_string(n + 1), {}}) ||
                !add(*sequence->getItem(n), sets, depth + 2))
                return false;
        return true;
    }

    static std::string valueOf(DcmElement &element, const CharacterSets &sets) {
        const Uint32 bytes = element.getLengthField();
        if (element.ident() == EVR_PixelData || isBulk(element) || bytes > longestValue)
            return bytes == DCM_UndefinedLength ? "compressed" : fmt::format("{} bytes", bytes);
        OFString value;
        if (element.getOFStringArray(value, OFFalse).bad())
            return "not readable";
        const std::string text(value.c_str());
        return oneLine(hasLetters(element) ? sets.utf8(text) : text);
    }

    AttributeList &m_list;
    OFString m_creator;
};

AttributeList listed(std::span<const std::byte> bytes) {
    const LoadedFile file = loadFile(bytes, Extent::header);
    AttributeList list;
    list.isComplete = file.isComplete;
    Lister lister(list);
    if (DcmMetaInfo *const meta = file.format->getMetaInfo(); meta != nullptr) {
        dropUnreadable(*meta);
        const CharacterSets none(*meta);
        list.isComplete = lister.add(*meta, none, 0) && list.isComplete;
    }
    DcmDataset &dataset = file.dataset();
    const CharacterSets sets(dataset);
    list.isComplete = lister.add(dataset, sets, 0) && list.isComplete;
    return list;
}

} // namespace

AttributeList listAttributes(std::span<const std::byte> bytes) {
    return orDamaged([&] { return listed(bytes); });
}

} // namespace pellucid::decoding::process
