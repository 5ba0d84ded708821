// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/object_folder.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/decoder/decoder.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
namespace tag = exchange::tag;
using task::Error;
using task::ErrorCode;

std::string valueOf(const decoder::AttributeList &list, std::uint32_t tag) {
    for (const decoder::Attribute &attribute : list.attributes)
        if (attribute.depth == 0 && attribute.tag == tag)
            return attribute.value;
    return {};
}

bool haveSameBytes(const fs::path &a, const fs::path &b) {
    std::ifstream one(a, std::ios::binary), other(b, std::ios::binary);
    return std::equal(std::istreambuf_iterator<char>(one), {},
                      std::istreambuf_iterator<char>(other), {});
}

bool isWhole(const decoder::AttributeList &list) {
    return list.isComplete || list.attributes.size() >= decoder::maxAttributes;
}

// Whether a file that is there can be read to its end: a power cut may have left less of it.
bool isIntact(const fs::path &path) {
    std::error_code unknown;
    if (!fs::is_regular_file(path, unknown))
        return false;
    try {
        return isWhole(decoder::Decoder::shared().attributes(path));
    } catch (const Error &error) {
        if (error.code() != ErrorCode::unusable)
            throw;
        return false;
    }
}

} // namespace

ObjectFolder::ObjectFolder(fs::path folder, Keeps keeps)
    : m_folder(std::move(folder)), m_keeps(keeps) {}

fs::path ObjectFolder::pathOf(const std::string &studyUid, const std::string &seriesUid,
                              const std::string &sopInstanceUid) const {
    return m_folder / studyUid / seriesUid / (sopInstanceUid + ".dcm");
}

bool ObjectFolder::has(const std::string &studyUid, const std::string &seriesUid,
                       const std::string &sopInstanceUid) const {
    return isIntact(pathOf(studyUid, seriesUid, sopInstanceUid));
}

std::unique_ptr<files::AtomicFile> ObjectFolder::open(const exchange::Arrival &arrival) const {
    return std::make_unique<files::AtomicFile>(m_folder / (arrival.sopInstanceUid + ".dcm"));
}

StoredObject ObjectFolder::keep(files::AtomicFile &file, const exchange::Arrival &arrival,
                                std::uint64_t bytes, const std::optional<Place> &place) const {
    if (bytes == 0)
        throw Error(ErrorCode::output, because::isNotWritable, m_folder);
    // The decoder reads the file that has no name yet.
    const fs::path unnamed = "/proc/self/fd/" + std::to_string(file.descriptor());
    decoder::AttributeList list;
    try {
        list = decoder::Decoder::shared().attributes(unnamed);
    } catch (const Error &error) {
        throw Error(error.code(), error.reason());
    }
    if (!isWhole(list))
        throw Error(ErrorCode::unusable, because::isTruncated);
    StoredObject object{{},
                        valueOf(list, tag::studyUid),
                        valueOf(list, tag::seriesUid),
                        valueOf(list, tag::sopInstanceUid),
                        valueOf(list, tag::sopClassUid),
                        bytes};
    if (object.sopInstanceUid != arrival.sopInstanceUid ||
        object.sopClassUid != arrival.sopClassUid)
        throw Error(ErrorCode::unusable, because::isNotWhatWasAnnounced);
    // The UIDs become names of folders.
    if (!exchange::isUid(object.studyUid) || !exchange::isUid(object.seriesUid))
        throw Error(ErrorCode::unusable, because::hasNoValidUids);
    if (place && (object.studyUid != place->studyUid || object.seriesUid != place->seriesUid))
        throw Error(ErrorCode::unusable, because::isNotWhatWasAnnounced);
    object.path = pathOf(object.studyUid, object.seriesUid, object.sopInstanceUid);
    std::error_code failed;
    if (isIntact(object.path)) { // what is damaged is replaced
        if (!haveSameBytes(unnamed, object.path))
            throw Error(ErrorCode::unusable, because::anotherObjectHasItsUid);
        return object;
    }
    fs::create_directories(object.path.parent_path(), failed);
    if (failed)
        throw Error(ErrorCode::output, because::cannotBeMade(task::systemReason(failed.value())),
                    object.path.parent_path());
    file.moveTo(object.path);
    file.commit(m_keeps == Keeps::onDisk ? files::AtomicFile::Bytes::flushed
                                         : files::AtomicFile::Bytes::unflushed);
    return object;
}

} // namespace pellucid::archive
