// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>

#include <QString>

#include "core/task/progress.h"
#include "core/task/reason.h"

class QWidget;

namespace pellucid::ui {

class Document;
class MprView;
class ProjectionView;

/// The planes in the order of mpr::Orientation, and the projection.
enum class Pane { axial, coronal, sagittal, projection };

/// The panes that pictures are made of.
struct Panes {
    std::array<MprView *, 3> planes;
    ProjectionView *projection;

    QWidget *of(Pane pane) const;
};

/// `png`: as it looks; `png16`: grey from the lower to the upper end of the window, in a straight
/// line, 16 bits; `npy`, `nrrd`: the values of the projection, single precision; `capture`: as it
/// looks, a DICOM image of the open study; `frames`, `video`: once around the patient, as it looks.
enum class PictureFormat { png, png16, npy, nrrd, capture, frames, video };

struct PictureExport {
    Pane pane = Pane::projection;
    PictureFormat format = PictureFormat::png;
    int scale = 1; ///< pixels for one of the screen, a side
    bool isAnnotated = true;
    int frameCount = 120;        ///< of a turn
    bool isDeidentified = false; ///< a capture of nobody's

    /// Whether it shows colours and annotations.
    bool isPicture() const {
        return format != PictureFormat::png16 && format != PictureFormat::npy &&
               format != PictureFormat::nrrd;
    }
    bool isTurn() const {
        return format == PictureFormat::frames || format == PictureFormat::video;
    }
};

/// ".png", of the file that is written.
QString suffixOf(PictureFormat format);

/// The file that is written first: a turn has one for each frame.
QString firstFileOf(const PictureExport &what, const QString &path);

/// What an export cannot hold or make here; none if it can be made.
std::optional<task::Reason> obstacle(const PictureExport &what, const Panes &panes,
                                     const Document &document);

/// Writes a picture of a pane as it is now; run it on any thread. The file appears only when
/// complete; of frames that are cancelled none is left. It *throws* task::Error, task::Cancelled.
using PictureWriter = std::function<void(const task::Progress &)>;
/// *Throws* Error{usage} with the obstacle, also where a file of an open study would be replaced.
PictureWriter pictureWriter(const PictureExport &what, const Panes &panes, const Document &document,
                            const QString &path);

} // namespace pellucid::ui
