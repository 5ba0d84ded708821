// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

#include "core/volume/volume.h"

class QComboBox;
class QKeySequence;
class QMenu;

namespace pellucid::ui {

class Document;

/// The windows that the planes can be shown with, as a menu with its keys and as a box that shows
/// the current one: the volume's first, the presets, the file's others.
class WindowChooser : public QObject {
    Q_OBJECT
public:
    /// Fills a menu and a box that others own.
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
