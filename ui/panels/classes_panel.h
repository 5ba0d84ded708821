// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QHash>
#include <QPointer>
#include <QWidget>

#include "core/scene/scene.h"
#include "ui/document/commands.h"

class QLabel;
class QPushButton;
class QScrollArea;
class QVBoxLayout;

namespace pellucid::ui {

class ClassDialog;
class ClassRow;
class Document;

/// The tissue classes of the look, with visibility, weight, range and color.
class ClassesPanel : public QWidget {
    Q_OBJECT
public:
    explicit ClassesPanel(Document &document, QWidget *parent = nullptr);

    /// The button beside the panel's heading.
    QWidget *corner();

private:
    void showScene();
    void change(const QString &what, const std::function<void(classify::Look &)> &edit,
                DragId drag = noDrag);
    void changeClass(int index, const QString &what,
                     const std::function<void(classify::TissueClass &)> &edit,
                     DragId drag = noDrag);
    void add(const classify::TissueClass &tissue);
    void showAddMenu();
    void setWeight(int index, double weight, DragId drag);
    void toggle(int index);
    void showMenu(int index, const QPoint &globalAt);
    void edit(int index);
    void chooseColor(int index);

    Document &m_document;
    QPushButton *m_add;
    QWidget *m_list;
    QVBoxLayout *m_rows;
    QLabel *m_empty;
    QScrollArea *m_area;
    std::vector<ClassRow *> m_shown;
    QPointer<ClassDialog> m_dialog;
    /// The former weights of hidden classes, by name.
    QHash<QString, double> m_hiddenWeight;
};

} // namespace pellucid::ui
