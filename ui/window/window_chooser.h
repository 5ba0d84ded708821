// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include <QList>
#include <QObject>

#include "core/volume/volume.h"

class QAction;
class QComboBox;
class QKeySequence;
class QMenu;

namespace pellucid::ui {

class Document;

/// The display windows of the planes, as a menu with keys and as a box that shows the current one:
/// the automatic window, the file's windows, and the user's list. The last row of both opens the
/// dialog that sets width and center and edits the list.
class WindowChooser : public QObject {
    Q_OBJECT
public:
    /// Fills a menu and a box, which it does not own.
    WindowChooser(Document &document, QMenu &menu, QComboBox &box);
    /// The study that keys and menu act on, if it is not always `document`.
    void setTarget(std::function<Document &()> target) { m_target = std::move(target); }

private:
    void showWindows();
    void showCurrent();
    void add(const volume::ValueWindow &window, const QKeySequence &key);
    void addAutomatic();
    void addDialog();
    void choose(volume::ValueWindow window);
    void openDialog();

    Document &m_document;
    QMenu &m_menu;
    QComboBox &m_box;
    Document &target() const { return m_target ? m_target() : m_document; }

    std::function<Document &()> m_target;
    QList<QAction *> m_rows; ///< of the box, in order
};

} // namespace pellucid::ui
