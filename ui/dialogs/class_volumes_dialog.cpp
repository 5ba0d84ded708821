// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/class_volumes_dialog.h"

#include <algorithm>

#include <QClipboard>
#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QHeaderView>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include "core/files/atomic_file.h"
#include "core/files/table_cell.h"
#include "core/preprocess/segment_class.h"
#include "core/preprocess/step_cache.h"
#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/jobs/job_strip.h"
#include "ui/language/names.h"
#include "ui/language/number_text.h"
#include "ui/language/reasons.h"
#include "ui/settings/file_dialogs.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

enum Column { nameColumn, volumeColumn, meanColumn, deviationColumn, lowColumn, highColumn, count };

// Classes share the steps of others.
constexpr std::size_t stepsBytes = std::size_t(256) << 20;

std::vector<ClassVolumesDialog::Row> measured(const volume::Volume &volume,
                                              const std::vector<classify::TissueClass> &classes,
                                              std::shared_ptr<const segment::SegmentSet> loaded,
                                              const task::Progress &progress) {
    preprocess::StepCache steps(stepsBytes);
    preprocess::ClassRunner runner(steps, loaded);
    std::vector<ClassVolumesDialog::Row> rows;
    for (const classify::TissueClass &tissue : classes) {
        const double done = double(rows.size()) / double(classes.size());
        const segment::Segment segment =
            preprocess::segmentOf(volume, tissue, loaded.get(), runner,
                                  progress.part(done, done + 1.0 / double(classes.size())));
        rows.push_back(
            {tissue.name, segment.volumeMm3, measure::valuesOf(volume, *segment.coverage)});
    }
    return rows;
}

} // namespace

ClassVolumesDialog::ClassVolumesDialog(const Document &document, QWidget *parent)
    : QDialog(parent), m_document(document), m_table(new QTableWidget(0, count)),
      m_message(new PlainLabel), m_copy(new QPushButton(tr("Copy"))),
      m_save(new QPushButton(tr("Save as..."))) {
    setObjectName("classVolumesDialog");
    setWindowTitle(tr("Volumes of the classes"));
    setAttribute(Qt::WA_DeleteOnClose);
    const QString unit = unitText(document.volume()->unit());
    const auto heading = [&](const QString &name) {
        return unit.isEmpty() ? name : QString("%1, %2").arg(name, unit);
    };
    m_table->setObjectName("classVolumesTable");
    m_table->setAccessibleName(windowTitle());
    m_table->setHorizontalHeaderLabels({tr("Class"), tr("Volume, ml"), heading(tr("Mean")),
                                        heading(tr("SD")), heading(tr("Minimum")),
                                        heading(tr("Maximum"))});
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->verticalHeader()->hide();
    m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_table->horizontalHeader()->setSectionResizeMode(nameColumn, QHeaderView::Stretch);
    m_message->setProperty("role", "muted");
    m_message->setWordWrap(true);
    m_copy->setObjectName("copyVolumesButton");
    m_save->setObjectName("saveVolumesButton");
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    buttons->addButton(m_copy, QDialogButtonBox::ActionRole);
    buttons->addButton(m_save, QDialogButtonBox::ActionRole);
    auto *column = new QVBoxLayout(this);
    column->addWidget(m_message);
    column->addWidget(m_table, 1);
    column->addWidget(new JobStrip(m_jobs, "classVolumes"));
    column->addWidget(buttons);
    resize(620, 320);
    connect(m_copy, &QPushButton::clicked, this,
            [this] { QGuiApplication::clipboard()->setText(table('\t')); });
    connect(m_save, &QPushButton::clicked, this, &ClassVolumesDialog::save);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    // The table is of this look and this volume.
    document.whenever(Change::scene | Change::segments, this, [this](Changes changes) {
        if (changes & Change::volume)
            close();
        else if ((changes & Change::segments) || !(m_document.scene().look.classes == m_measured))
            measure();
    });
    measure();
}

ClassVolumesDialog::~ClassVolumesDialog() = default;

void ClassVolumesDialog::measure() {
    if (!m_document.volume())
        return;
    m_measured = m_document.scene().look.classes;
    m_message->setText(tr("Counts samples whose membership after all steps is 50 % or more."));
    classify::Look look = m_document.scene().look;
    for (classify::TissueClass &tissue : look.classes) // hidden ones, too
        tissue.weight = std::max(tissue.weight, 1.0);
    m_copy->setEnabled(false);
    m_save->setEnabled(false);
    m_jobs.start(
        tr("Measuring the classes"),
        [this, volume = *m_document.volume(), classes = classify::visibleClasses(look),
         loaded = m_document.segments()](const Job &job) {
            const auto rows = measured(volume, classes, loaded, job.progress());
            job.deliver([this, rows] { showRows(rows); });
        },
        [this](const Outcome &outcome) {
            if (outcome.kind == Outcome::Kind::failed)
                m_message->setText(translated(*outcome.reason));
        });
}

void ClassVolumesDialog::showRows(const std::vector<Row> &rows) {
    m_table->setRowCount(int(rows.size()));
    for (int n = 0; n < int(rows.size()); ++n) {
        const Row &row = rows[std::size_t(n)];
        const auto figure = [&](double measure::RegionValues::*what) {
            return row.values ? numberText(*row.values.*what, 5) : QString::fromUtf8("–");
        };
        const QString texts[count] = {translatedName(row.name),
                                      numberText(row.volumeMm3 / 1000.0, 5),
                                      figure(&measure::RegionValues::mean),
                                      figure(&measure::RegionValues::standardDeviation),
                                      figure(&measure::RegionValues::minimum),
                                      figure(&measure::RegionValues::maximum)};
        for (int c = 0; c < count; ++c) {
            auto *item = new QTableWidgetItem(texts[c]);
            if (c != nameColumn)
                item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            m_table->setItem(n, c, item);
        }
    }
    m_copy->setEnabled(!rows.empty());
    m_save->setEnabled(!rows.empty());
}

QString ClassVolumesDialog::table(QChar separator) const {
    QStringList lines;
    for (int row = -1; row < m_table->rowCount(); ++row) {
        QStringList cells;
        for (int c = 0; c < count; ++c) {
            const QTableWidgetItem *const item =
                row < 0 ? m_table->horizontalHeaderItem(c) : m_table->item(row, c);
            std::string cell = item->text().toStdString();
            if (row >= 0 && c == nameColumn)
                cell = files::tableCell(cell);
            cells << QString::fromStdString(separator == ',' ? files::csvField(cell)
                                                             : files::tabbedField(cell));
        }
        lines << cells.join(separator);
    }
    return lines.join(separator == ',' ? "\r\n" : "\n") + (separator == ',' ? "\r\n" : "\n");
}

void ClassVolumesDialog::save() {
    const QString path =
        askForSavePath(this, tr("Save the volumes"), "volumes.csv", tr("Table (*.csv)"));
    if (path.isEmpty())
        return;
    try {
        m_document.requireOther({path.toStdString()});
        files::AtomicFile file(path.toStdString());
        file.write(table(',').toStdString());
        file.commit();
        emit saved(path);
    } catch (const task::Error &error) {
        emit failed(error.reason(), path);
    }
}

} // namespace pellucid::ui
