// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/measurements_panel.h"

#include <cmath>

#include <QHeaderView>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <glm/geometric.hpp>

#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/measurement_text.h"
#include "ui/language/shown_text.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

MeasurementsPanel::MeasurementsPanel(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_list(new QTreeWidget), m_hint(new PlainLabel),
      m_export(new QPushButton(tr("Export"))) {
    setPanelBackground(*this, "measurementsPanel");
    m_list->setObjectName("measurementList");
    m_list->setAccessibleName(tr("Measurements"));
    m_list->setHeaderHidden(true);
    m_list->setRootIsDecorated(false);
    m_list->setColumnCount(2);
    m_list->setEditTriggers(QAbstractItemView::SelectedClicked | QAbstractItemView::EditKeyPressed);
    m_list->header()->setStretchLastSection(false);
    m_list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_list->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    m_hint->setText(
        tr("Drag distances, angles and regions in a plane. They are kept with the study."));
    m_hint->setProperty("role", "muted");
    m_hint->setWordWrap(true);
    m_export->setObjectName("exportMeasurementsButton");
    m_export->setProperty("role", "link");
    m_export->setToolTip(tr("Export the measurements as a table (CSV)"));
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(14, 0, 14, 8);
    column->addWidget(m_hint, 0, Qt::AlignTop);
    column->addWidget(m_list, 1);
    connect(m_export, &QPushButton::clicked, this, &MeasurementsPanel::exportRequested);
    connect(m_list, &QTreeWidget::itemClicked, this,
            [this](QTreeWidgetItem *item) { goTo(m_list->indexOfTopLevelItem(item)); });
    connect(m_list, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem *item) {
        rename(m_list->indexOfTopLevelItem(item), item->text(0));
    });
    document.whenever(Change::measurements, this, &MeasurementsPanel::showAll);
    document.whenever(Change::selection, this, &MeasurementsPanel::showSelected);
    showAll();
}

QWidget *MeasurementsPanel::corner() {
    return m_export;
}

void MeasurementsPanel::showAll() {
    const QSignalBlocker quiet(m_list);
    const auto &all = m_document.measured();
    // Reuse rows: a drag changes only their figures.
    while (m_list->topLevelItemCount() > int(all.size()))
        delete m_list->takeTopLevelItem(m_list->topLevelItemCount() - 1);
    while (m_list->topLevelItemCount() < int(all.size())) {
        auto *item = new QTreeWidgetItem(m_list);
        item->setFlags(item->flags() | Qt::ItemIsEditable);
        item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
    }
    for (std::size_t n = 0; n < all.size(); ++n) {
        const auto &[measurement, result] = all[n];
        QTreeWidgetItem *item = m_list->topLevelItem(int(n));
        item->setText(0, measurement.name.empty()
                             ? kindText(measurement)
                             : shownText(QString::fromStdString(measurement.name)));
        item->setText(1, mainFigure(result, *m_document.volume()));
        item->setToolTip(0, plainToolTip(kindText(measurement)));
        item->setToolTip(
            1, plainToolTip(allFigures(measurement, result, *m_document.volume()).join('\n')));
    }
    m_hint->setVisible(all.empty());
    m_list->setVisible(!all.empty());
    m_export->setEnabled(!all.empty());
    showSelected();
}

void MeasurementsPanel::showSelected() {
    const QSignalBlocker quiet(m_list);
    m_list->setCurrentItem(m_list->topLevelItem(m_document.selectedMeasurement()));
}

void MeasurementsPanel::goTo(int index) {
    m_document.selectMeasurement(index);
    const measure::Measurement &m = m_document.measured()[std::size_t(index)].measurement;
    if (m.isProjected) {
        emit viewRequested(m.axes.right, m.axes.up);
        return;
    }
    glm::dvec3 middle(0.0);
    for (const glm::dvec3 &p : m.pointsMm)
        middle += p / double(m.pointsMm.size());
    m_document.setCrosshair({middle});
    // A region drawn on a turned plane is visible only on a plane of that orientation.
    for (const mpr::Orientation o : mpr::allOrientations)
        if (std::abs(glm::dot(m_document.cut().axes.scrollAxis(o), m.axes.toViewer())) > 0.999)
            return;
    Cut cut = m_document.cut();
    cut.axes = cut.axes.facing(m.axes);
    m_document.setCut(cut);
}

void MeasurementsPanel::rename(int index, const QString &name) {
    auto all = m_document.measurements();
    const std::string wanted = name.simplified().toStdString();
    if (wanted.empty() || wanted == all[std::size_t(index)].name) {
        showAll(); // restore the name
        return;
    }
    all[std::size_t(index)].name = wanted;
    m_document.undoStack()->push(new EditMeasurements(m_document, all, tr("Rename measurement")));
}

void MeasurementsPanel::removeSelected() {
    const int index = m_document.selectedMeasurement();
    if (index < 0)
        return;
    auto all = m_document.measurements();
    all.erase(all.begin() + index);
    m_document.selectMeasurement(-1);
    m_document.undoStack()->push(new EditMeasurements(m_document, all, tr("Delete measurement")));
}

} // namespace pellucid::ui
