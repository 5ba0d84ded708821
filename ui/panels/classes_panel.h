// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <vector>

#include <QHash>
#include <QPointer>
#include <QWidget>

#include "core/scene/scene.h"
#include "core/segment/segmentation.h"
#include "ui/document/commands.h"

class QLineEdit;
class QMenu;
class QPushButton;
class QScrollArea;
class QVBoxLayout;

namespace pellucid::ui {

class ClassDialog;
class ClassGroup;
class ClassRow;
class Document;
class PlainLabel;

/// The tissue classes of the look, with visibility, weight, range and color. Classes of segments
/// are grouped by their file. A long list can be searched.
class ClassesPanel : public QWidget {
    Q_OBJECT
public:
    explicit ClassesPanel(Document &document, QWidget *parent = nullptr);

    /// The button beside the panel's heading.
    QWidget *corner();

signals:
    /// The user asks for the segments of these files, or to choose one if there are none.
    void segmentationRequested(const QStringList &paths);
    /// The sizes of the classes are wanted.
    void volumesRequested();

private:
    void showScene();
    /// Puts the rows below the headings of their groups, and hides those that are folded or do not
    /// match the search.
    void arrange();
    void place(const std::vector<QWidget *> &order);
    /// Makes as many rows as there are classes.
    void makeRows(std::size_t count);
    /// The file that a class's segment comes from, or null.
    const segment::Segmentation *fileOf(const classify::TissueClass &tissue) const;
    ClassGroup *groupFor(const segment::Segmentation &file);
    bool isFound(const classify::TissueClass &tissue) const;
    void toggleGroup(const ClassGroup &group);
    void change(const QString &what, const std::function<void(classify::Look &)> &edit,
                DragId drag = noDrag);
    void changeClass(int index, const QString &what,
                     const std::function<void(classify::TissueClass &)> &edit,
                     DragId drag = noDrag);
    void add(const classify::TissueClass &tissue);
    void showAddMenu();
    void addSegments(QMenu &menu);
    void setWeight(int index, double weight, DragId drag);
    void toggle(int index);
    void showMenu(int index, const QPoint &globalAt);
    void edit(int index);
    void chooseColor(int index);

    Document &m_document;
    QPushButton *m_add;
    QWidget *m_list;
    QVBoxLayout *m_rows;
    PlainLabel *m_empty;
    QLineEdit *m_search;
    QScrollArea *m_area;
    std::vector<ClassRow *> m_shown;
    std::vector<ClassGroup *> m_groups;
    QPointer<ClassDialog> m_dialog;
    int m_edited = -1; ///< index of the class in the dialog
    /// The former weights of hidden classes, by name.
    QHash<QString, double> m_hiddenWeight;
};

} // namespace pellucid::ui
