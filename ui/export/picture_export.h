// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>

#include <QImage>
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

/// The panes that can be exported.
struct Panes {
    std::array<MprView *, 3> planes;
    ProjectionView *projection;

    QWidget *of(Pane pane) const;
    /// The one with the keyboard's focus, otherwise the projection or, if it is hidden, the first
    /// that is not.
    Pane current() const;
};

/// `png`: as on the screen; `png16`: 16-bit grey, linear from the lower to the upper end of the
/// window; `npy`, `nrrd`: the values of the projection, single precision; `capture`: as on the
/// screen, a DICOM image of the open study; `frames`, `video`, `captureLoop`: as on the screen, one
/// turn around the patient. ExportDialog lists the formats in the same order.
enum class PictureFormat { png, png16, npy, nrrd, capture, frames, video, captureLoop };

struct PictureExport {
    Pane pane = Pane::projection;
    PictureFormat format = PictureFormat::png;
    int scale = 1; ///< pixels a side for one of the screen
    bool isAnnotated = true;
    int frameCount = 120;        ///< of a turn
    bool isDeidentified = false; ///< without the patient's identity and the study's date
    QString patient;             ///< as annotations name the patient; may be empty

    /// Whether its annotations name the patient.
    bool namesPatient() const {
        return isPicture() && isAnnotated && !isDeidentified && !patient.isEmpty();
    }
    /// Whether it has colors and annotations.
    bool isPicture() const {
        return format != PictureFormat::png16 && format != PictureFormat::npy &&
               format != PictureFormat::nrrd;
    }
    bool isTurn() const {
        return format == PictureFormat::frames || format == PictureFormat::video ||
               format == PictureFormat::captureLoop;
    }
    /// Whether it is a DICOM object of the open study.
    bool isCapture() const {
        return format == PictureFormat::capture || format == PictureFormat::captureLoop;
    }
};

/// The suffix of the file that is written, ".png" for example.
QString suffixOf(PictureFormat format);

/// The first file that is written: a turn has one for each frame.
QString firstFileOf(const PictureExport &what, const QString &path);

/// Why an export is impossible; none if it is possible.
std::optional<task::Reason> obstacle(const PictureExport &what, const Panes &panes,
                                     const Document &document);

/// Makes a picture of a pane with its annotations, as on the screen; may run on any thread. It
/// *throws* task::Error, task::Cancelled.
using PictureMaker = std::function<QImage(const task::Progress &)>;
/// A maker of the present picture. *Throws* Error{usage} with the obstacle. *Requires*: the format
/// is `png`.
PictureMaker pictureMaker(const PictureExport &what, const Panes &panes, const Document &document);

/// Writes a picture of a pane; may run on any thread. The file appears only when complete; a cancel
/// leaves no frames. It *throws* task::Error, task::Cancelled.
using PictureWriter = std::function<void(const task::Progress &)>;
/// A writer of the present picture. *Throws* Error{usage} with the obstacle, and if a file of an
/// open study would be replaced.
PictureWriter pictureWriter(const PictureExport &what, const Panes &panes, const Document &document,
                            const QString &path);

} // namespace pellucid::ui
