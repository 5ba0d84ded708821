// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>

#include <QObject>
#include <QStringList>

#include "core/task/reason.h"
#include "ui/export/picture_export.h"
#include "ui/studies/study_source.h"
#include "ui/views/viewer.h"

class QMenu;
class QWidget;

namespace pellucid::ui {

struct Workbench;

/// The File menu: opens and saves studies, scenes, pictures and measurements.
class FileMenu : public QObject {
    Q_OBJECT
public:
    FileMenu(QMenu &menu, QWidget &window, Workbench &bench, const Panes &panes);

    /// The study that copying, printing and the header are for, if it is not always the open one.
    void setFocused(std::function<Viewer()> focused) { m_focused = std::move(focused); }
    void chooseFiles();
    void chooseFolder();
    void chooseSegmentations();
    void chooseSubtrahend();
    /// Asks how to import and, if there are no paths, what.
    void importPaths(const QStringList &paths);
    void exportMeasurements();

signals:
    void besideRequested(const pellucid::ui::StudySource &source);
    void pathsChosen(const QStringList &paths);
    void serversRequested();
    void phantomChosen(const QString &kind);
    void recentForgotten();
    void preferencesRequested();
    void quitRequested();
    void messageShown(const QString &text);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    void savePicture();
    void reportSaved(const QString &path);
    void exportPicture();
    void copyPicture();
    void printPicture();
    /// Makes a picture of the current pane in the background and passes it to `use`.
    void withPicture(int scale, const QString &title,
                     const std::function<void(const QImage &)> &use);
    /// The files of the open volume; none if it has no DICOM headers.
    QStringList headerFiles() const;
    void showHeader();
    void saveScene();
    void saveSegments();
    void openScene();
    /// Runs `what` and reports a task::Error that it throws.
    void attempt(const std::function<void()> &what);

    const Document &focusedDocument() const;
    Panes focusedPanes() const;

    QWidget &m_window;
    Workbench &m_bench;
    Panes m_panes;
    std::function<Viewer()> m_focused;
};

} // namespace pellucid::ui
