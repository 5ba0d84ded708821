// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/ui/workstation.h"

#include <filesystem>

#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QRadioButton>
#include <QTreeView>

#include "ui/panels/study_list.h"
#include "ui/views/mpr_view.h"
#include "ui/window/file_actions.h"

namespace pellucid::test {

/// The fixture with three small chests to import, and the means to use the list of studies.
class StudiesWindow : public Workstation {
protected:
    // Writes them into the folder "three".
    void writeChests() const {
        for (const char *name : {"Miller^Ann", "Miller^Bob", "Zhang^Wei"}) {
            const auto lattice = phantom::phantomLattice(phantom::Kind::chest,
                                                         {.size = volume::GridSize{48, 48, 24}});
            dicom::writeCtSeries(m_folder / "three" / name,
                                 phantom::makePhantom(phantom::Kind::chest, lattice),
                                 {.patientName = name}, dicom::TransferSyntax::explicitLittle);
        }
    }

    QTreeView *tree() { return find<QTreeView>("seriesTree"); }
    ui::StudyList &list() { return *qobject_cast<ui::StudyList *>(tree()->model()); }

    QStringList rows() {
        QStringList names;
        for (int row = 0; row < list().rowCount(); ++row)
            names << list().index(row, 0).data().toString();
        return names;
    }

    QModelIndex volumeRow(const QString &patient) {
        for (int row = 0; row < list().rowCount(); ++row)
            if (list().index(row, 0).data() == patient) {
                tree()->expand(list().index(row, 0));
                // The volumes of a study are loaded when its row is expanded.
                (void)QTest::qWaitFor([&] { return list().rowCount(list().index(row, 0)) > 0; },
                                      patienceMs);
                return list().index(0, 0, list().index(row, 0));
            }
        qFatal("no study of %s", qPrintable(patient));
    }

    QString problems() {
        QStringList texts;
        auto *shown = find<QListWidget>("problemList");
        for (int n = 0; n < shown->count(); ++n)
            texts << shown->item(n)->text();
        return texts.join("\n");
    }

    QPoint middle(const QModelIndex &row) {
        tree()->scrollTo(row);
        return tree()->visualRect(row).center();
    }
    void click(const QModelIndex &row) {
        QTest::mouseClick(tree()->viewport(), Qt::LeftButton, Qt::NoModifier, middle(row));
    }

    // Chooses from the menu that a right click on a row opens.
    void choose(const QModelIndex &row, const char *action) {
        emit tree()->customContextMenuRequested(middle(row));
        auto *menu = mainWindow().findChild<QMenu *>("studyMenu");
        QVERIFY(menu != nullptr);
        QAction *wanted = menu->findChild<QAction *>(action);
        QVERIFY2(wanted != nullptr, action);
        wanted->trigger();
        menu->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    QWidget *dialog(const char *name) { return mainWindow().findChild<QWidget *>(name); }

    void acceptImport(bool copies) {
        find<QRadioButton>(copies ? "copyButton" : "referButton")->click();
        QSignalSpy over(&mainWindow().library().jobs(), &ui::JobRunner::finished);
        QTest::mouseClick(find<QPushButton>("importNowButton"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(over.count() > 0, patienceMs);
        QTRY_VERIFY(dialog("importDialog") == nullptr);
    }

    void import(const std::filesystem::path &path, bool copies) {
        mainWindow().files().importPaths({QString::fromStdString(path.string())});
        QTRY_VERIFY(dialog("importDialog") != nullptr);
        acceptImport(copies);
    }
};

} // namespace pellucid::test
