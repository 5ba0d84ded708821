// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QImage>
#include <QObject>
#include <QStringList>

class QWidget;

namespace pellucid::ui {

class ProjectionView;
class StudyPair;
struct Workbench;

/// Opens and saves studies, scenes, pictures and measurements. Copying, printing and the header are
/// for the study that has the focus.
class FileActions : public QObject {
    Q_OBJECT
public:
    FileActions(QWidget &window, Workbench &bench, StudyPair &pair);

    void chooseFiles();
    void chooseFolder();
    void chooseSegmentations();
    void chooseSubtrahend();
    /// Asks how to import and, if there are no paths, what.
    void importPaths(const QStringList &paths);
    void savePicture();
    void exportPicture();
    void copyPicture();
    void printPicture();
    /// The files of the volume; none if it has no DICOM headers.
    QStringList headerFiles() const;
    void showHeader();
    void saveScene();
    void openScene();
    void saveSegments();
    void exportMeasurements();

private:
    void reportSaved(const QString &path);
    /// Makes a picture of the current pane in the background and passes it to `use`.
    void withPicture(int scale, const QString &title,
                     const std::function<void(const QImage &)> &use);
    ProjectionView &projection() const;

    QWidget &m_window;
    Workbench &m_bench;
    StudyPair &m_pair;
};

} // namespace pellucid::ui
