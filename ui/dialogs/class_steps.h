// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QWidget>

#include "core/classify/look.h"

class QFormLayout;
class QListWidget;
class QMenu;
class QPushButton;

namespace pellucid::ui {

/// Edits the steps of a class: a list in their order, and the numbers of the selected one.
class ClassSteps : public QWidget {
    Q_OBJECT
public:
    /// `look`: the look of the class, and `name` its name there: classes that do not depend on it
    /// can be combined with it.
    ClassSteps(const classify::TissueClass &tissue, const classify::Look &look,
               QWidget *parent = nullptr);
    const std::vector<classify::Step> &steps() const { return m_steps; }

signals:
    void changed();

private:
    void fillMenu(QMenu &menu);
    void add(const classify::Step &step);
    void move(int by);
    void remove();
    void list(int selected);
    void showNumbers();

    classify::TissueClass m_tissue;
    classify::Look m_look;
    std::vector<classify::Step> m_steps;
    QListWidget *m_list;
    QPushButton *m_remove, *m_up, *m_down;
    QWidget *m_numbers = nullptr;
};

} // namespace pellucid::ui
