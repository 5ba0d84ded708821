// SPDX-License-Identifier: GPL-3.0-or-later
// The study library as a person uses it: import, search, order, open, details, remove.
#include "tests/support/dicom_writer.h"
#include "tests/ui/studies_window.h"
#include "ui/studies/study_facts.h"

#include <filesystem>
#include <fstream>

#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class StudiesTest : public StudiesWindow {
    Q_OBJECT
private slots:
    void initTestCase() {
        StudiesWindow::initTestCase();
        writeChests();
    }
    void importedStudiesAreThereAfterARestart() {
        import(m_folder / "three", false);
        QCOMPARE(rows(), QStringList({"Miller Ann", "Miller Bob", "Zhang Wei"}));
        QVERIFY(!document().volume()); // importing opens nothing
        restart();
        QCOMPARE(rows(), QStringList({"Miller Ann", "Miller Bob", "Zhang Wei"}));
        click(volumeRow("Miller Bob"));
        settle();
        QVERIFY(document().volume());
        QCOMPARE(document().volume()->lattice().size().k, 24);
        QVERIFY(!tree()->currentIndex().data(Qt::DecorationRole).value<QImage>().isNull());
        save("library");
    }

    void recentStudiesOfTheLibraryShowNoName() {
        import(m_folder / "head", false);
        click(volumeRow("Secret Name"));
        settle();
        for (const QString &kept : QSettings().value("recentPaths").toStringList())
            QVERIFY(!kept.contains("Secret"));
        restart();
        QPushButton *recent = nullptr;
        for (auto *link : find<QWidget>("startPage")->findChildren<QPushButton *>())
            if (link->isVisible() && link->text().contains("2026-01-01"))
                recent = link;
        QVERIFY(recent != nullptr);
        QVERIFY(!recent->text().contains("Secret"));
        QTest::mouseClick(recent, Qt::LeftButton);
        settle();
        QCOMPARE(document().volume()->lattice().size().k, 80);
    }

    void theListIsSearchedAndSorted() {
        import(m_folder / "three", false);
        auto *search = find<QLineEdit>("studySearch");
        mainWindow().setFocus();
        QTest::keyClick(&mainWindow(), Qt::Key_F, Qt::ControlModifier);
        QVERIFY(search->hasFocus());
        QTest::keyClicks(search, "miller b");
        QTRY_COMPARE(rows(), QStringList({"Miller Bob"}));
        QTest::keyClick(search, Qt::Key_A, Qt::ControlModifier);
        QTest::keyClicks(search, "nobody");
        QTRY_COMPARE(rows(), QStringList());
        search->clear();
        QTRY_COMPARE(rows().size(), 3);
        find<QAction>("lastAddedFirstAction")->trigger();
        QCOMPARE(rows().size(), 3);
        find<QAction>("byNameAction")->trigger();
        QCOMPARE(rows(), QStringList({"Miller Ann", "Miller Bob", "Zhang Wei"}));
        // The open study stays listed, whether or not the search finds it.
        open(headPath());
        QCOMPARE(rows().front(), QString("Secret Name"));
        search->setText("zhang");
        QTRY_COMPARE(rows(), QStringList({"Secret Name", "Zhang Wei"}));
        search->setText("secret");
        QTRY_COMPARE(rows(), QStringList({"Secret Name"}));
    }

    void anOpenStudyIsAddedAndThenListedOnce() {
        open(headPath());
        choose(volumeRow("Secret Name"), "addStudyAction");
        QTRY_VERIFY(dialog("importDialog") != nullptr);
        acceptImport(false);
        QCOMPARE(rows(), QStringList({"Secret Name"}));
        QVERIFY(list().study(list().index(0, 0)).libraryId != 0);
        QVERIFY(tree()->currentIndex().isValid()); // still the open one
        choose(volumeRow("Secret Name"), "closeStudyAction");
        QTRY_VERIFY(!document().volume());
        QCOMPARE(rows(), QStringList({"Secret Name"}));
        restart();
        QCOMPARE(rows(), QStringList({"Secret Name"}));
    }

    void aCopiedStudyOutlivesItsDiscAndIsRemovedWithItsFiles() {
        const fs::path disc = m_folder / "disc";
        fs::copy(m_folder / "head", disc);
        import(disc, true);
        fs::remove_all(disc);
        click(volumeRow("Secret Name"));
        settle();
        QVERIFY(document().volume());
        const fs::path copies = m_folder / "data" / "pellucid" / "library" / "files";
        QVERIFY(!fs::is_empty(copies));
        choose(volumeRow("Secret Name"), "removeStudyAction");
        QTRY_VERIFY(dialog("removeStudyQuestion") != nullptr);
        auto *question = qobject_cast<QMessageBox *>(dialog("removeStudyQuestion"));
        QVERIFY(question->text().contains("80 files that were copied"));
        for (QAbstractButton *button : question->buttons())
            if (question->buttonRole(button) == QMessageBox::AcceptRole)
                QTest::mouseClick(button, Qt::LeftButton);
        QTRY_COMPARE(rows(), QStringList());
        QTRY_VERIFY(fs::is_empty(copies)); // by a job of its own
        // It was the open one: nothing is open now.
        QVERIFY(!document().volume());
        QVERIFY(find<QWidget>("startPage")->isVisible());
    }

    void aReferenceToAMissingDiscIsReported() {
        const fs::path disc = m_folder / "away";
        fs::copy(m_folder / "head", disc);
        import(disc, false);
        fs::remove_all(disc);
        click(volumeRow("Secret Name"));
        QTRY_VERIFY_WITH_TIMEOUT(problems().contains("cannot be found"), patienceMs);
        QVERIFY(!jobs().isRunning());
        QVERIFY(find<QWidget>("startPage")->isVisible());
    }

    void aZipIsOpenedAndImported() {
        const QString zip = QString::fromStdString((m_folder / "study.zip").string());
        QProcess packer;
        packer.setWorkingDirectory(headPath());
        packer.start("python3", {"-m", "zipfile", "-c", zip, "."});
        QVERIFY(packer.waitForFinished() && packer.exitCode() == 0);
        open(zip);
        QCOMPARE(document().volume()->lattice().size().k, 80);
        const fs::path sessions = m_folder / "cache" / "pellucid" / "sessions";
        QVERIFY(!fs::is_empty(sessions));
        // Unpacked files are deleted with the program: they are copied whatever the user chose.
        choose(volumeRow("Secret Name"), "addStudyAction");
        QTRY_VERIFY(dialog("importDialog") != nullptr);
        acceptImport(false);
        restart();
        QVERIFY(!fs::exists(sessions)); // with its last folder
        click(volumeRow("Secret Name"));
        settle();
        QCOMPARE(document().volume()->lattice().size().k, 80);
    }

    void problemsOfAnImportAreOneList() {
        const fs::path mixed = m_folder / "mixed";
        fs::copy(m_folder / "head", mixed);
        for (int n = 0; n < 12; ++n)
            std::ofstream(mixed / ("note" + std::to_string(n) + ".txt")) << "not an image, sorry";
        std::ofstream(mixed / "IM0").flush();
        import(mixed, false);
        QCOMPARE(find<QListWidget>("problemList")->count(), 2);
        QVERIFY(problems().contains("mixed: files that are not images: 12"));
        QCOMPARE(find<QLabel>("problemHeading")->text(), QString("PROBLEMS (1)"));
        QVERIFY(problems().contains("IM0: is empty"));
        QVERIFY(QApplication::activeModalWidget() == nullptr);
    }

    void anImportWithoutImagesIsReported() {
        fs::create_directories(m_folder / "empty");
        import(m_folder / "empty", false);
        QTRY_VERIFY(problems().contains("contains no usable images"));
        QCOMPARE(rows(), QStringList());
    }

    void theDetailsShowGeometryAndFiles() {
        open(headPath());
        choose(volumeRow("Secret Name"), "volumeDetailsAction");
        QTRY_VERIFY(dialog("studyDetails") != nullptr);
        QStringList texts;
        for (const QLabel *label : dialog("studyDetails")->findChildren<QLabel *>())
            texts << label->text();
        QVERIFY(texts.contains(headPath()));
        QVERIFY(texts.contains("80"));
        QVERIFY(texts.contains(QString::fromUtf8("80 × 96 × 96")));
        save("details");
        QVERIFY(
            dialog("studyDetails")
                ->grab()
                .save(qEnvironmentVariable("PELLUCID_ARTIFACTS", "/tmp") + "/study_details.png"));
        dialog("studyDetails")->close();
    }

    void aScoutIsAPictureInOnePane() {
        test::SeriesKnobs knobs;
        knobs.slices = 1;
        knobs.rows = 60;
        knobs.columns = 40;
        knobs.change = [](test::DicomWriter &w, int) {
            w.put({0x0008, 0x0008}, "CS", std::string("ORIGINAL\\PRIMARY\\LOCALIZER"));
            w.putNumbers({0x0020, 0x0037}, {1, 0, 0, 0, 0, -1}); // from the front
        };
        test::writeSeries(m_folder / "scout", knobs);
        const auto panes = [&] {
            QStringList shown;
            for (const char *name : {"axialView", "coronalView", "sagittalView", "projectionView"})
                if (find<QWidget>(name)->isVisible())
                    shown << name;
            return shown;
        };
        drop(mainWindow(), {QUrl::fromLocalFile(QString::fromStdString((m_folder / "scout")))});
        QTRY_COMPARE_WITH_TIMEOUT(panes(), QStringList{"coronalView"}, patienceMs);
        save("scout");
        open(headPath());
        QCOMPARE(panes().size(), 4);
        // A pane that the user has maximized stays for the next study.
        emit find<ui::MprView>("axialView")->maximizeRequested(find<QWidget>("axialView"));
        QCOMPARE(panes(), QStringList{"axialView"});
        drop(mainWindow(), {QUrl::fromLocalFile(headPath())});
        waitForVolume();
        QCOMPARE(panes(), QStringList{"axialView"});
    }

    void seriesOfPhasesAreOneRow() {
        const auto write = [&](const QString &folder, int number, const std::string &description,
                               const std::string &modality, double z) {
            test::SeriesKnobs knobs;
            knobs.rows = knobs.columns = 24;
            knobs.slices = 12;
            knobs.modality = modality;
            knobs.change = [&](test::DicomWriter &w, int k) {
                const std::string series = "1.2.826.0.1.3680043.8.498.77." + std::to_string(number);
                w.put({0x0020, 0x000E}, "UI", series);
                w.put({0x0008, 0x0018}, "UI", series + "." + std::to_string(k + 1));
                w.put({0x0008, 0x103E}, "LO", description);
                w.put({0x0020, 0x0011}, "IS", std::to_string(number));
                w.putNumbers({0x0020, 0x0032}, {-5.0, 7.0, z + 2.0 * k});
            };
            test::writeSeries(m_folder / folder.toStdString() / std::to_string(number), knobs);
        };
        const auto rowsOf = [&](const QString &folder) {
            restart();
            open(QString::fromStdString((m_folder / folder.toStdString()).string()));
            return list().rowCount(list().index(0, 0));
        };
        for (const int percent : {0, 30, 60})
            write("gated", 10 + percent, "CTA gated, " + std::to_string(percent) + "%", "CT", 0.0);
        QCOMPARE(rowsOf("gated"), 1);
        QCOMPARE(bench().study.phases.count(), 3);
        QVERIFY(bench().study.phases.label(1).contains("30%"));
        // A dynamic scan, and one of another place.
        for (const int n : {1, 2, 3})
            write("dynamic", n, "t1 dynamic", "MR", 0.0);
        write("dynamic", 4, "t1 dynamic", "MR", 100.0);
        QCOMPARE(rowsOf("dynamic"), 2);
        // Two kernels may have one description.
        for (const int n : {1, 2})
            write("kernels", n, "Chest", "CT", 0.0);
        QCOMPARE(rowsOf("kernels"), 2);
    }

    void descriptionsTellPhasesFromOtherNumbers_data() {
        QTest::addColumn<QString>("one");
        QTest::addColumn<QString>("other");
        QTest::addColumn<bool>("arePhases");
        const auto row = [](const char *one, const char *other, bool arePhases) {
            QTest::addRow("%s, %s", one, other) << one << other << arePhases;
        };
        row("CTA gated, 30%", "CTA gated, 60%", true);
        row("Low dose 40%", "Low dose 75%", true);
        row("SS40 40%", "SS40 75%", true);
        row("CTA 30% ASiR 40%", "CTA 60% ASiR 40%", true);
        row("ASiR 40% CTA 30%", "ASiR 40% CTA 60%", true);
        row("CTA phase 3", "CTA phase 4", true);
        row("Perfusion TP 1", "Perfusion TP 2", true);
        // Two strengths of one reconstruction are two pictures of one moment.
        row("Chest ASiR-V 30%", "Chest ASiR-V 60%", false);
        row("Chest (ASIR=30%)", "Chest (ASIR=60%)", false);
        row("Chest iDose 30%", "Chest iDose 50%", false);
        row("CTA 30% ASiR 40%", "CTA 30% ASiR 60%", false);
        row("http2 chest", "http3 chest", false);
        row("Chest B30", "Chest B70", false);
    }
    void descriptionsTellPhasesFromOtherNumbers() {
        QFETCH(QString, one);
        QFETCH(QString, other);
        ui::VolumeFacts a;
        a.seriesUid = "1";
        a.modality = "CT";
        a.description = one;
        ui::VolumeFacts b = a;
        b.seriesUid = "2";
        b.description = other;
        QTEST(ui::arePhases(a, b), "arePhases");
    }

    void aClosedStudyLeavesTheList() {
        open(headPath());
        choose(volumeRow("Secret Name"), "closeStudyAction");
        QTRY_COMPARE(rows(), QStringList());
        QVERIFY(!document().volume());
        open(headPath());
        QCOMPARE(rows(), QStringList({"Secret Name"}));
    }

    void aDropOnTheStudyListImports() {
        drop(*find<QWidget>("studyPanel"), {QUrl::fromLocalFile(headPath())});
        QTRY_VERIFY(dialog("importDialog") != nullptr);
        acceptImport(false);
        QCOMPARE(rows(), QStringList({"Secret Name"}));
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::StudiesTest>(argc, argv);
}

#include "studies_test.moc"
