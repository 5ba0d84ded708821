// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/files/atomic_file.h"
#include "core/network/client/link.h"
#include "core/task/reason.h"

namespace pellucid::archive {

/// The patient of an object or a study.
struct Patient {
    std::string name, id, birthDate;

    bool isKnown() const { return !name.empty() || !id.empty() || !birthDate.empty(); }
};

/// Whether an object names a patient who is not the one that its server lists: the identifier
/// differs, or both name and birth date do. One of these two may have been corrected in the
/// archive. Without an identifier, name or birth date must agree. What is unknown does not differ;
/// case and separators of names make no difference.
bool isOfAnother(const Patient &listed, const Patient &named);

/// An object in a folder.
struct StoredObject {
    std::filesystem::path path;
    std::string studyUid, seriesUid, sopInstanceUid, sopClassUid;
    std::uint64_t bytes = 0;
    Patient patient{};
    std::string studyDate{};
};

/// A value that an archive has corrected since it sent an object: as it is here, and as listed now.
struct Correction {
    enum class Kind { name, id, birthDate, studyDate };
    Kind kind = Kind::name;
    std::string here, listed;
};

/// How an object differs from what its server lists. What is unknown does not differ; case and
/// separators of names make no difference.
std::vector<Correction> correctionsOf(const Patient &listed, const std::string &studyDate,
                                      const StoredObject &object);

/// It as a sentence for the user.
task::Reason reasonOf(const Correction &correction);

/// Why an object was not kept.
struct RefusedObject {
    std::string sopInstanceUid;
    task::Reason reason;
};

/// Whether a new object replaces an existing one with the same UID.
enum class Existing { stays, isReplaced };

/// Where received objects are stored: FOLDER/STUDY/SERIES/INSTANCE.dcm, named by their UIDs. A file
/// appears there only when it is complete, readable, and is what its sender announced.
class ObjectFolder {
public:
    /// `onDisk`: an object counts as kept only when it is on the disk, because its sender may
    /// delete it.
    enum class Durability { cached, synced };
    ObjectFolder(std::filesystem::path folder, Durability durability);

    const std::filesystem::path &folder() const { return m_folder; }
    /// Creates the folder if it is missing; like all in it, for the user alone. *Throws*
    /// Error{output}.
    void create() const;
    std::filesystem::path pathOf(const std::string &studyUid, const std::string &seriesUid,
                                 const std::string &sopInstanceUid) const;
    /// The object, if it is there and can be read to its end.
    std::optional<StoredObject> find(const std::string &studyUid, const std::string &seriesUid,
                                     const std::string &sopInstanceUid) const;

    /// Where an object belongs, as its server lists it. Without a series: anywhere in the study.
    struct Place {
        std::string studyUid, seriesUid;
    };
    /// Copies a complete file and gives the copy its name, because a compromised helper could still
    /// write to the original. If the same object is there already, with the same bytes, it
    /// stays; a damaged one is replaced. *Throws* Error{unusable} if it is not the object that was
    /// announced, belongs to none of the places, or would replace another file that stays;
    /// Error{output}.
    StoredObject keep(const files::AtomicFile &file, const network::Arrival &arrival,
                      std::uint64_t bytes, const std::vector<Place> &places = {},
                      Existing existing = Existing::stays) const;
    /// A file without a name. *Throws* Error{output}.
    std::unique_ptr<files::AtomicFile> open(const network::Arrival &arrival) const;

private:
    std::filesystem::path m_folder;
    Durability m_durability;
};

} // namespace pellucid::archive
