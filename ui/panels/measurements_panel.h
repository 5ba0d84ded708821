// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include <glm/vec3.hpp>

class QPushButton;
class QTreeWidget;

namespace pellucid::ui {

class Document;
class PlainLabel;

/// Lists the measurements of the open study with name and figure. A click shows a measurement, a
/// second click on its name renames it, Delete removes it.
class MeasurementsPanel : public QWidget {
    Q_OBJECT
public:
    explicit MeasurementsPanel(Document &document, QWidget *parent = nullptr);

    /// The button beside the panel's heading, which exports the table.
    QWidget *corner();
    void removeSelected();

signals:
    void exportRequested();
    /// The view in which a projected distance was measured.
    void viewRequested(const glm::dvec3 &right, const glm::dvec3 &up);

private:
    void showAll();
    void showSelected();
    void goTo(int index);
    void rename(int index, const QString &name);

    Document &m_document;
    QTreeWidget *m_list;
    PlainLabel *m_hint;
    QPushButton *m_export;
};

} // namespace pellucid::ui
