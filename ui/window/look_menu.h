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

/// The menu of what is shown and how: the same as the docks at the right do, and the tone.
class LookMenu : public QObject {
    Q_OBJECT
public:
    LookMenu(QMenu &menu, Document &document, LookDocks &docks, ProjectionView &projection);

    /// Where the windows of the planes are listed.
    QMenu &windowMenu() { return *m_windowMenu; }

private:
    QAction *add(QMenu &menu, const QString &text, const char *name, const QKeySequence &key,
                 const std::function<void()> &run);
    void addReconstructions(QMenu &menu);
    void addShading(QMenu &menu, LookDocks &docks);
    void showScene();

    Document &m_document;
    QActionGroup *m_reconstructions;
    QAction *m_film, *m_cue;
    QList<QAction *> m_ofShading;
    QMenu *m_windowMenu;
};

} // namespace pellucid::ui
