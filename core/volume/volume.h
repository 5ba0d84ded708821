// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/task/reason.h"
#include "core/volume/lattice.h"
#include "core/volume/value_unit.h"
#include "core/volume/value_window.h"

namespace pellucid::volume {

/// Slices from `first` to `last`, both included.
struct SliceRange {
    int first = 0, last = 0;
    bool operator==(const SliceRange &) const = default;
};

/// Where the distance between pixels is that a file states. Projections magnify the patient.
enum class SpacingPlace {
    patient,
    detector,   ///< lengths in the patient are smaller
    magnified,  ///< the detector's, divided by an estimated magnification
    geometry,   ///< corrected for the projection at an assumed depth
    calibrated, ///< by an object of known size in the picture
};

/// "at the detector" and so on, in English; nothing for lengths in the patient.
inline std::string_view spacingPlaceName(SpacingPlace place) {
    switch (place) {
    case SpacingPlace::detector:
        return "at the detector";
    case SpacingPlace::magnified:
        return "magnification estimated";
    case SpacingPlace::geometry:
        return "corrected for magnification";
    case SpacingPlace::calibrated:
        return "calibrated";
    case SpacingPlace::patient:
        break;
    }
    return {};
}

/// The information from a volume's source that a viewer shows.
struct VolumeNotes {
    std::string title;    ///< series description or file name
    std::string modality; ///< DICOM modality, empty if unknown
    std::string bodyPart; ///< DICOM BodyPartExamined, empty if unknown
    /// Segmentations and other objects refer to the study and space by these; empty if unknown.
    std::string studyUid, frameOfReferenceUid;
    std::vector<ValueWindow> windows; ///< the file's own windows
    std::vector<task::Reason>
        warnings;                   ///< changes that the reader made to the geometry or the values
    std::vector<SliceRange> filled; ///< missing slices that were interpolated
    bool darkIsHigh = false;        ///< shown inverted, as MONOCHROME1 and PET are
    bool isLocalizer = false;       ///< pictures for planning a scan, not to be projected
    bool isDifference = false;      ///< of two volumes: 0 means no change
    bool lossy = false;             ///< lossy compression at some point
    bool placed = true;             ///< false: images without positions, not a volume
    bool hasSpacing = true;         ///< false: nothing says how large a pixel is; a "mm" is a pixel
    bool hasDepth = true;           ///< false: nothing says how thick a slice is
    SpacingPlace spacingPlace = SpacingPlace::patient;
};

/// Samples on a lattice. An immutable value, shared and cheap to copy.
class Volume {
public:
    template <class T> using Samples = std::shared_ptr<const std::vector<T>>;

    Volume() : Volume(Lattice(), std::vector<float>(1, 0.0F), ValueUnit::none) {}
    /// *Shape*: one sample per lattice point, columns fastest, then rows, then slices. Floats may
    /// be NaN or infinite.
    Volume(Lattice lattice, std::vector<std::int16_t> samples, ValueUnit unit,
           VolumeNotes notes = {});
    Volume(Lattice lattice, std::vector<float> samples, ValueUnit unit, VolumeNotes notes = {});

    const Lattice &lattice() const { return m_lattice; }
    ValueUnit unit() const { return m_unit; }
    const VolumeNotes &notes() const { return *m_notes; }
    bool isFloat() const { return std::holds_alternative<Samples<float>>(m_samples); }
    /// The samples if they are floats, else null.
    const float *floats() const {
        const auto *const samples = std::get_if<Samples<float>>(&m_samples);
        return samples == nullptr ? nullptr : (*samples)->data();
    }
    std::size_t bytes() const;

    /// Calls f with a span of the stored samples, int16 or float.
    template <class F> decltype(auto) visit(F &&f) const {
        return std::visit(
            [&](const auto &samples) -> decltype(auto) { return f(std::span(*samples)); },
            m_samples);
    }
    /// The value of a sample of the lattice.
    double value(VoxelIndex n) const;
    /// A copy of the part in a box. *Requires*: the box is inside the lattice.
    Volume cropped(const VoxelBox &box) const;
    /// The same samples with other notes.
    Volume withNotes(VolumeNotes notes) const;

private:
    Lattice m_lattice;
    std::variant<Samples<std::int16_t>, Samples<float>> m_samples;
    ValueUnit m_unit;
    std::shared_ptr<const VolumeNotes> m_notes;
};

} // namespace pellucid::volume
