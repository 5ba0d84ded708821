// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>

#include "ui/panels/study_list.h"
#include "ui/studies/study_source.h"

class QLineEdit;
class QMenu;
class QPushButton;
class QTreeView;

namespace pellucid::ui {

class Document;
class PlainLabel;
class ServerSearch;

/// The open studies and those of the library, with search, sort order, a context menu, the running
/// import and the problem list. A search also asks the servers, after Enter or a rest.
class StudyPanel : public QWidget {
    Q_OBJECT
public:
    StudyPanel(Document &document, StudyLibrary &library, ServerSearch &servers,
               QWidget *parent = nullptr);

    /// The button beside the panel's heading, which imports.
    QWidget *corner();
    void focusSearch();

signals:
    void sourceActivated(int index);
    void libraryVolumeActivated(const pellucid::ui::StudyFacts &study,
                                const pellucid::ui::VolumeFacts &volume);
    /// `paths`: if empty, the user is asked for them.
    void importRequested(const QStringList &paths);
    void closeRequested(int index);
    /// Only servers have it, or have more of it.
    void retrieveRequested(const pellucid::ui::RemoteStudy &study);
    /// `files`: of a study; to this server.
    void sendRequested(const QStringList &files, const QString &server);
    void besideRequested(const pellucid::ui::StudySource &source);

protected:
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dropEvent(QDropEvent *event) override;

private:
    void activate(const QModelIndex &index);
    void showCurrent();
    void expandFew();
    void showEmpty();
    void showMenu(const QPoint &at);
    void openBeside(const QModelIndex &index);
    void showDetails(const QModelIndex &index);
    void importOpen(const StudyFacts &study);
    void remove(const StudyFacts &study);
    /// The open sources of a study.
    std::vector<int> sourcesOf(const StudyFacts &study) const;
    void close(const StudyFacts &study);
    void connectControls();
    QMenu *orderMenu();
    void searchServers(QWidget *asking);
    void showServers();
    void showLogins(const QStringList &locked);
    void addLogin(const QString &server);
    void addServersTo(QMenu &menu, const QModelIndex &index);

    Document &m_document;
    StudyLibrary &m_library;
    StudyList m_list;
    QLineEdit *m_search;
    QElapsedTimer m_sinceToggle; ///< since a study was expanded or collapsed
    QTreeView *m_tree;
    QPushButton *m_corner;
    PlainLabel *m_empty;
    ServerSearch &m_servers;
    PlainLabel *m_serverStates; ///< how the servers fare
    QWidget *m_logins;          ///< a button for each server that awaits one
    QMap<QString, QPushButton *> m_loginButtons;
    QTimer m_typing, m_resting;
};

} // namespace pellucid::ui
