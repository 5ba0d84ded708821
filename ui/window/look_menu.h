// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QList>
#include <QObject>

class QAction;
class QActionGroup;
class QKeySequence;
class QMenu;

namespace pellucid::ui {

class Document;
class LookDocks;
class ProjectionView;

/// The Look menu: actions of the docks on the right, and the brightness of the projection.
class LookMenu : public QObject {
    Q_OBJECT
public:
    LookMenu(QMenu &menu, Document &document, LookDocks &docks, ProjectionView &projection);

    /// The submenu of window presets.
    QMenu &windowMenu() { return *m_windowMenu; }

private:
    QAction *add(QMenu &menu, const QString &text, const char *name, const QKeySequence &key,
                 const std::function<void()> &run);
    void addReconstructions(QMenu &menu);
    void addShading(QMenu &menu, LookDocks &docks);
    void showScene();

    Document &m_document;
    QActionGroup *m_reconstructions;
    QAction *m_film, *m_cue, *m_couch;
    QList<QAction *> m_shadingActions;
    QMenu *m_windowMenu;
};

} // namespace pellucid::ui
