// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include <QList>
#include <QObject>

#include "core/volume/volume.h"

class QAction;
class QComboBox;
class QKeySequence;
class QMenu;

namespace pellucid::ui {

class ActionTable;
class Document;

/// The display windows of the planes, as a menu with keys and as a box that shows the current one:
/// the automatic window, the file's windows, and the user's list. The last row of both opens the
/// dialog.
class WindowChooser : public QObject {
    Q_OBJECT
public:
    /// `target`: the study that keys and menu act on; the list is for the unit of `document`.
    WindowChooser(Document &document, std::function<Document &()> target, QObject *parent);
    /// Fills a menu and a box, which it does not own. The menu begins and ends with actions of the
    /// table.
    void show(QMenu &menu, QComboBox &box, const ActionTable &actions);

    void chooseAutomatic();
    void invert();
    /// Opens the dialog that sets width and center and edits the list.
    void openDialog();

private:
    void showWindows();
    void showCurrent();
    void add(const volume::ValueWindow &window, const QKeySequence &key);
    void addRow(QAction &action, const QString &text);
    void choose(volume::ValueWindow window);

    Document &m_document;
    std::function<Document &()> m_target;
    QMenu *m_menu = nullptr;
    QComboBox *m_box = nullptr;
    const ActionTable *m_actions = nullptr;
    QList<QAction *> m_rows; ///< of the box, in order
};

} // namespace pellucid::ui
