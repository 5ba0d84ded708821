// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

#include "core/volume/volume.h"

class QComboBox;
class QKeySequence;
class QMenu;

namespace pellucid::ui {

class Document;

/// The display windows of the planes, as a menu with keys and as a box that shows the current one:
/// the initial window, the presets, and the file's other windows.
class WindowChooser : public QObject {
    Q_OBJECT
public:
    /// Fills a menu and a box, which it does not own.
    WindowChooser(Document &document, QMenu &menu, QComboBox &box);

private:
    void addAutomatic();
    void showWindows();
    void showCurrent();
    void add(const volume::ValueWindow &window, const QKeySequence &key);

    Document &m_document;
    QMenu &m_menu;
    QComboBox &m_box;
};

} // namespace pellucid::ui
