// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/files/session_folder.h"
#include "core/task/reason.h"
#include "core/volume/volume.h"

namespace pellucid::dicom {

/// A file that is not used, and why.
struct Skipped {
    std::filesystem::path path;
    task::Reason reason; ///< `because::needsTooMuchMemory` is not its fault
    bool isHuge = false; ///< it is used if that is asked for, see `ScanOptions`
};

/// One image plane: a file, or one frame of a multi-frame file.
struct FrameReference {
    std::filesystem::path path;
    int frame = 0;
    /// Of what the scan found there, as `digestOf` says: anything else is not what was meant.
    std::size_t digest = 0;
    bool operator==(const FrameReference &) const = default;
};

/// Where the planes of a stack lie and where the volume's slices will be.
struct StackGeometry {
    volume::Lattice lattice;
    /// For an uneven stack: distance of every frame from the lattice's first slice, along the
    /// slices' normal, mm; the lattice's slices are interpolated between them. Empty if every frame
    /// is a slice.
    std::vector<double> frameOffsetsMm;
};

/// Frames that make one volume, or, without positions, a set of images.
struct VolumeEntry {
    /// What tells it from the other volumes of its series; empty if it is alone.
    std::vector<task::Reason> label;
    std::vector<FrameReference> frames; ///< in the order of the stack
    StackGeometry geometry;
    bool placed = true; ///< false: images only, not a volume
    /// Holes of several slices are interpolated; the runs between them are volumes of their own.
    bool fillsHoles = false;
    std::optional<task::Reason> notPlacedReason; ///< set if it is not placed
    volume::ValueUnit unit = volume::ValueUnit::none;
    volume::VolumeNotes notes;
    std::filesystem::path volumeFile; ///< set instead of frames for a file of one volume or several
    int fileVolume = 0;               ///< which of them

    std::size_t voxels() const { return geometry.lattice.size().count(); }
};

/// A volume's label in English.
std::string labelText(const std::vector<task::Reason> &label);

/// A file of a series; its UID tells copies of one instance. A NRRD file has none.
struct InstanceFile {
    std::filesystem::path path;
    std::string sopInstanceUid;
};

struct Series {
    std::string uid, description, modality, bodyPart;
    int number = 0;
    std::vector<VolumeEntry> volumes;
    std::vector<InstanceFile> files;
};

struct Study {
    std::string uid, date, description;
    std::vector<Series> series;
};

struct Patient {
    std::string id, name, birthDate, sex;
    std::vector<Study> studies;
};

/// An archive, and where its files are as long as somebody may load from them.
struct Unpacked {
    std::shared_ptr<const files::SessionFolder> folder;
    std::filesystem::path archive;
};

/// What a scan found.
struct Catalogue {
    std::vector<Patient> patients;
    std::vector<Skipped> skipped;
    /// What archives were unpacked to; it is there as long as somebody may load from it.
    std::vector<Unpacked> unpacked;
    /// Where a file is for people: what archives were unpacked to is gone when they look.
    std::filesystem::path named(const std::filesystem::path &file) const;
    /// The archive that a file is in, or nothing.
    std::optional<std::filesystem::path> archiveOf(const std::filesystem::path &file) const;

    bool empty() const { return patients.empty(); }
};

/// A volume's place in a catalogue.
struct Selection {
    const Patient *patient = nullptr;
    const Study *study = nullptr;
    const Series *series = nullptr;
    const VolumeEntry *volume = nullptr;
};

/// Every volume, in the catalogue's order.
std::vector<Selection> selections(const Catalogue &catalogue);

/// What becomes of holes of several slices: the longest run is taken, or the whole with its holes
/// interpolated.
enum class Holes { split, fill };

/// The volume with most voxels; single images come after stacks, other files after DICOM series,
/// sets of images after every volume.
/// *Throws* Error{unusable} if there is none.
Selection defaultSelection(const Catalogue &catalogue, Holes holes = Holes::split);

/// A series by its UID or number, its volume as of `defaultSelection`. *Throws* Error{unusable},
/// also where several series have the number.
Selection selectSeries(const Catalogue &catalogue, const std::string &numberOrUid,
                       Holes holes = Holes::split);

/// Volume `number` of the selection's series, counted from 1 as `info` does.
/// *Throws* Error{unusable} if there is none.
Selection selectVolume(const Selection &selection, int number);

} // namespace pellucid::dicom
