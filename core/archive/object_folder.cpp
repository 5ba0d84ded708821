// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/object_folder.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <system_error>
#include <vector>

#include "core/archive/reasons.h"
#include "core/decoding/client/decoder.h"
#include "core/decoding/client/reasons.h"
#include "core/files/open_regular.h"
#include "core/files/reasons.h"
#include "core/files/user_folders.h"
#include "core/system/text.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
namespace tag = network::tag;
using task::Error;
using task::ErrorCode;

std::string valueOf(const decoding::AttributeList &list, std::uint32_t tag) {
    for (const decoding::Attribute &attribute : list.attributes)
        if (attribute.depth == 0 && attribute.tag == tag)
            return attribute.value;
    return {};
}

bool haveSameBytes(const fs::path &a, const fs::path &b) {
    const files::RegularFile one = files::openRegular(a), other = files::openRegular(b);
    if (one.facts.bytes != other.facts.bytes)
        return false;
    std::vector<std::byte> some(std::size_t(1) << 20), others(some.size());
    try {
        for (;;) {
            const auto got = std::span(some).first(platform::readSome(one.handle, some));
            if (platform::readSome(other.handle, others) != got.size() ||
                !std::equal(got.begin(), got.end(), others.begin()))
                return false;
            if (got.empty())
                return true;
        }
    } catch (const std::system_error &) {
        return false; // the disk fails
    }
}

bool isWhole(const decoding::AttributeList &list) {
    return list.isComplete || list.attributes.size() >= decoding::maxAttributes;
}

StoredObject describedBy(const decoding::AttributeList &list) {
    return {{},
            valueOf(list, tag::studyUid),
            valueOf(list, tag::seriesUid),
            valueOf(list, tag::sopInstanceUid),
            valueOf(list, tag::sopClassUid),
            0,
            {valueOf(list, tag::patientName), valueOf(list, tag::patientId),
             valueOf(list, tag::birthDate)},
            valueOf(list, tag::studyDate)};
}

// The object in a file that is there; nothing if it cannot be read to its end: a power cut may have
// left less of it.
std::optional<StoredObject> objectIn(const fs::path &path) {
    std::error_code unknown;
    if (!fs::is_regular_file(path, unknown))
        return std::nullopt;
    try {
        const decoding::AttributeList list = decoding::Decoder::shared().attributes(path);
        if (!isWhole(list))
            return std::nullopt;
        StoredObject object = describedBy(list);
        object.path = path;
        const auto bytes = fs::file_size(path, unknown);
        object.bytes = unknown ? 0 : std::uint64_t(bytes);
        return object;
    } catch (const Error &error) {
        if (error.code() != ErrorCode::unusable)
            throw;
        return std::nullopt;
    }
}

// Names in one form: parts may be separated by carets or blanks, and groups by equals signs.
std::string comparable(const std::string &text) {
    std::string words;
    for (const char c : system::lowered(text.substr(0, text.find('=')))) {
        const bool isSeparator = c == '^' || c == ' ' || c == ',';
        if (!isSeparator)
            words += c;
        else if (!words.empty() && words.back() != ' ')
            words += ' ';
    }
    words.erase(words.find_last_not_of(' ') + 1);
    return words;
}

enum class Comparison { same, different, unknown };

Comparison compare(const std::string &a, const std::string &b) {
    const std::string one = comparable(a), other = comparable(b);
    if (one.empty() || other.empty())
        return Comparison::unknown;
    return one == other ? Comparison::same : Comparison::different;
}

} // namespace

bool isOfAnother(const Patient &listed, const Patient &named) {
    using enum Comparison;
    const Comparison id = compare(listed.id, named.id), name = compare(listed.name, named.name),
                     date = compare(listed.birthDate, named.birthDate);
    if (id == unknown) // what is left must agree in something
        return (name == different || date == different) && name != same && date != same;
    return id == different || (name == different && date == different);
}

std::vector<Correction> correctionsOf(const Patient &listed, const std::string &studyDate,
                                      const StoredObject &object) {
    const Patient &here = object.patient;
    std::vector<Correction> corrections{
        {Correction::Kind::name, here.name, listed.name},
        {Correction::Kind::id, here.id, listed.id},
        {Correction::Kind::birthDate, here.birthDate, listed.birthDate},
        {Correction::Kind::studyDate, object.studyDate, studyDate}};
    std::erase_if(corrections, [](const Correction &one) {
        return compare(one.here, one.listed) != Comparison::different;
    });
    return corrections;
}

task::Reason reasonOf(const Correction &correction) {
    switch (correction.kind) {
    case Correction::Kind::name:
        return because::nameIsCorrected(correction.here, correction.listed);
    case Correction::Kind::id:
        return because::idIsCorrected(correction.here, correction.listed);
    case Correction::Kind::birthDate:
        return because::birthDateIsCorrected(correction.here, correction.listed);
    case Correction::Kind::studyDate:
        return because::studyDateIsCorrected(correction.here, correction.listed);
    }
    return because::studyDateIsCorrected(correction.here, correction.listed);
}

ObjectFolder::ObjectFolder(fs::path folder, Durability durability)
    : m_folder(std::move(folder)), m_durability(durability) {}

void ObjectFolder::create() const {
    files::createPrivateFolders(m_folder);
}

fs::path ObjectFolder::pathOf(const std::string &studyUid, const std::string &seriesUid,
                              const std::string &sopInstanceUid) const {
    return m_folder / studyUid / seriesUid / (sopInstanceUid + ".dcm");
}

std::optional<StoredObject> ObjectFolder::find(const std::string &studyUid,
                                               const std::string &seriesUid,
                                               const std::string &sopInstanceUid) const {
    return objectIn(pathOf(studyUid, seriesUid, sopInstanceUid));
}

std::unique_ptr<files::AtomicFile> ObjectFolder::open(const network::Arrival &arrival) const {
    return std::make_unique<files::AtomicFile>(m_folder / (arrival.sopInstanceUid + ".dcm"),
                                               files::AtomicFile::Readers::user);
}

StoredObject ObjectFolder::keep(const files::AtomicFile &file, const network::Arrival &arrival,
                                std::uint64_t bytes, const std::vector<Place> &places,
                                Existing existing) const {
    if (bytes == 0)
        throw Error(ErrorCode::output, because::isNotWritable, m_folder);
    // The helper still has the file open and could change it after the checks. It cannot reach the
    // copy.
    const std::unique_ptr<files::AtomicFile> copy = open(arrival);
    copy->write(file.view(), bytes);
    // The decoder reads the file that has no name yet.
    decoding::AttributeList list;
    try {
        list = decoding::Decoder::shared().attributes(copy->currentPath());
    } catch (const Error &error) {
        throw Error(error.code(), error.reason());
    }
    if (!isWhole(list))
        throw Error(ErrorCode::unusable, because::isTruncated);
    StoredObject object = describedBy(list);
    object.bytes = bytes;
    if (object.sopInstanceUid != arrival.sopInstanceUid ||
        object.sopClassUid != arrival.sopClassUid)
        throw Error(ErrorCode::unusable, because::isNotWhatWasAnnounced);
    // The UIDs become names of folders.
    if (!network::isUid(object.studyUid) || !network::isUid(object.seriesUid))
        throw Error(ErrorCode::unusable, because::hasNoValidUids);
    const auto isThere = [&](const Place &place) {
        return object.studyUid == place.studyUid &&
               (place.seriesUid.empty() || object.seriesUid == place.seriesUid);
    };
    if (!places.empty() && std::none_of(places.begin(), places.end(), isThere))
        throw Error(ErrorCode::unusable, because::isNotWhatWasAnnounced);
    object.path = pathOf(object.studyUid, object.seriesUid, object.sopInstanceUid);
    if (objectIn(object.path)) { // what is damaged is replaced
        if (haveSameBytes(copy->currentPath(), object.path))
            return object;
        if (existing == Existing::stays)
            throw Error(ErrorCode::unusable, because::anotherObjectHasItsUid);
    }
    files::createPrivateFolders(object.path.parent_path());
    copy->moveTo(object.path);
    copy->commit(m_durability == Durability::synced ? files::AtomicFile::Bytes::flushed
                                                    : files::AtomicFile::Bytes::unflushed);
    return object;
}

} // namespace pellucid::archive
