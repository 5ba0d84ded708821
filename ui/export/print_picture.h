// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QString>

class QPagedPaintDevice;

namespace pellucid::ui {

/// A picture on a page, with a line above it and one below.
struct PrintedPage {
    QImage picture;
    QString heading;
    QString footing;
};

/// Prints a page: the picture as large as fits, in the middle. Returns false if the device cannot
/// be painted on, such as a file in a folder that is gone.
bool print(const PrintedPage &page, QPagedPaintDevice &device);

} // namespace pellucid::ui
