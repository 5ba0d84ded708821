// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <QString>

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
/// line, 16 bits; `npy`, `nrrd`: the values of the projection, single precision.
enum class PictureFormat { png, png16, npy, nrrd };

struct PictureExport {
    Pane pane = Pane::projection;
    PictureFormat format = PictureFormat::png;
    int scale = 1; ///< pixels for one of the screen, a side
    bool isAnnotated = true;
};

/// What an export cannot hold; empty if it can be made.
QString obstacle(const PictureExport &what, const Panes &panes, const Document &document);

/// Writes a picture of a pane; the file appears only when complete. *Throws* task::Error.
void writePicture(const PictureExport &what, const Panes &panes, const Document &document,
                  const QString &path);

} // namespace pellucid::ui
