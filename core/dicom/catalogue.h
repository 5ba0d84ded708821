// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/decoding/client/reasons.h"
#include "core/files/session_folder.h"
#include "core/task/reason.h"
#include "core/volume/volume.h"

namespace pellucid::dicom {

/// A file that is not used, and the reason.
struct Skipped {
    std::filesystem::path path;
    task::Reason reason; ///< `because::needsTooMuchMemory` does not mean that the file is bad
    bool isHuge = false; ///< can be used on request, see `ScanOptions`
};

/// One image plane: a file, or one frame of a multi-frame file.
struct FrameReference {
    std::filesystem::path path;
    int frame = 0;
    /// Digest of what the scan found there, see `digestOf`: loading refuses anything else.
    std::size_t digest = 0;
    bool operator==(const FrameReference &) const = default;
};

/// The positions of a stack's planes, and of the volume's slices.
struct StackGeometry {
    volume::Lattice lattice;
    /// For an uneven stack: the distance of every frame from the lattice's first slice along the
    /// slices' normal, mm. The lattice's slices are interpolated between them. Empty if every frame
    /// is a slice.
    std::vector<double> frameOffsetsMm;
};

/// `arriving`: more slices will come between these. Gaps mean nothing: a stack is neither split nor
/// refused because of them, and counts as evenly spaced. `remaining`: what is left of one volume.
/// Its images are not told apart.
enum class Slices { all, arriving, remaining };

/// Frames that make one volume or, without positions, a set of images.
struct VolumeEntry {
    /// Distinguishes it from the other volumes of its series; empty if it is the only one.
    std::vector<task::Reason> label;
    std::vector<FrameReference> frames; ///< in stack order
    StackGeometry geometry;
    bool placed = true; ///< false: images, not a volume
    /// Holes of several slices are interpolated; the runs between them are also separate volumes.
    bool fillsHoles = false;
    std::optional<task::Reason> notPlacedReason; ///< set if it is not placed
    volume::ValueUnit unit = volume::ValueUnit::none;
    double valueFactor = 1.0; ///< of the files' values, into the unit
    volume::VolumeNotes notes;
    std::filesystem::path volumeFile; ///< set instead of `frames` for a file of volumes
    int fileVolume = 0;               ///< the index of the volume in that file

    std::size_t voxels() const { return geometry.lattice.size().count(); }
};

/// A volume's label in English.
std::string labelText(const std::vector<task::Reason> &label);

/// A file of a series. Its UID identifies copies of one instance; a NRRD file has none.
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

/// A segmentation or an RT structure set, which belongs to the volumes of its study.
struct SegmentationFile {
    std::filesystem::path path;
    std::string description, modality;
};

struct Study {
    std::string uid, date, description;
    std::vector<Series> series;
    std::vector<SegmentationFile> segmentations;
};

struct Patient {
    std::string id, name, birthDate, sex;
    std::vector<Study> studies;
    /// Stands for the volume files, which name no patient.
    bool isOfVolumeFiles = false;
};

/// An archive, and the folder with its files, which exists as long as they may be loaded.
struct Unpacked {
    std::shared_ptr<const files::SessionFolder> folder;
    std::filesystem::path archive;
};

/// The result of a scan.
struct Catalogue {
    std::vector<Patient> patients;
    std::vector<Skipped> skipped;
    /// The unpacked archives, kept as long as their files may be loaded.
    std::vector<Unpacked> unpacked;
    /// The path to show to users: for a file from an archive, one within the archive, since the
    /// unpacked file is temporary.
    std::filesystem::path named(const std::filesystem::path &file) const;
    /// The archive that a file is in, or nothing.
    std::optional<std::filesystem::path> archiveOf(const std::filesystem::path &file) const;

    bool empty() const { return patients.empty(); }
};

/// The unused files to tell the user about. Texts and programs beside images are no problem: they
/// are one entry, which names their folder and number.
std::vector<Skipped> problemsOf(const Catalogue &catalogue);

/// A volume's position in a catalogue.
struct Selection {
    const Patient *patient = nullptr;
    const Study *study = nullptr;
    const Series *series = nullptr;
    const VolumeEntry *volume = nullptr;
};

/// All volumes, in the catalogue's order.
std::vector<Selection> selections(const Catalogue &catalogue);

/// What to do about holes of several slices: take the longest run, or the whole stack with
/// interpolated holes.
enum class Holes { split, fill };

/// The volume with the most voxels. Stacks precede single images, DICOM series other files, and
/// volumes sets of images. *Throws* Error{unusable} if there is none.
Selection defaultSelection(const Catalogue &catalogue, Holes holes = Holes::split);

/// A series by its UID or number, with its volume chosen as by `defaultSelection`. *Throws*
/// Error{unusable}, also if several series have the number.
Selection selectSeries(const Catalogue &catalogue, const std::string &numberOrUid,
                       Holes holes = Holes::split);

/// Volume `number` of the selection's series, counted from 1 as in the output of `info`. *Throws*
/// Error{unusable} if there is none.
Selection selectVolume(const Selection &selection, int number);

} // namespace pellucid::dicom
