// SPDX-License-Identifier: GPL-3.0-or-later
// The study library as a person uses it: import, search, order, open, details, remove.
#include "tests/ui/workstation.h"

#include <filesystem>
#include <fstream>

#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QRadioButton>
#include <QToolButton>
#include <QTreeView>

#include "ui/beside/study_beside.h"
#include "ui/panels/study_list.h"
#include "ui/window/file_menu.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class StudiesTest : public Workstation {
    Q_OBJECT
private slots:
    void initTestCase() {
        Workstation::initTestCase();
        for (const char *name : {"Miller^Ann", "Miller^Bob", "Zhang^Wei"}) {
            const auto lattice = phantom::phantomLattice(phantom::Kind::chest,
                                                         {.size = volume::GridSize{48, 48, 24}});
            dicom::writeCtSeries(m_folder / "three" / name,
                                 phantom::makePhantom(phantom::Kind::chest, lattice),
                                 {.patientName = name}, dicom::TransferSyntax::explicitLittle);
        }
    }

    // Each test has a library of its own.
    void init() {
        m_window.reset();
        fs::remove_all(m_folder / "data");
        restart();
    }

    void importedStudiesAreThereAfterARestart() {
        import(m_folder / "three", false);
        QCOMPARE(rows(), QStringList({"Miller Ann", "Miller Bob", "Zhang Wei"}));
        QVERIFY(!m_window->document().volume()); // importing opens nothing
        restart();
        QCOMPARE(rows(), QStringList({"Miller Ann", "Miller Bob", "Zhang Wei"}));
        click(volumeRow("Miller Bob"));
        settle();
        QVERIFY(m_window->document().volume());
        QCOMPARE(m_window->document().volume()->lattice().size().k, 24);
        QVERIFY(!tree()->currentIndex().data(Qt::DecorationRole).value<QImage>().isNull());
        save("library");
    }

    void aStudyOfTheLibraryIsAmongTheRecentOnesWithoutItsName() {
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
        QCOMPARE(m_window->document().volume()->lattice().size().k, 80);
    }

    void searchNarrowsTheListAndOrderTurnsIt() {
        import(m_folder / "three", false);
        auto *search = find<QLineEdit>("studySearch");
        m_window->setFocus();
        QTest::keyClick(m_window.get(), Qt::Key_F, Qt::ControlModifier);
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
        // Open studies that the library does not have are searched too.
        open(headPath());
        QCOMPARE(rows().front(), QString("Secret Name"));
        search->setText("zhang");
        QTRY_COMPARE(rows(), QStringList({"Zhang Wei"}));
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
        QVERIFY(m_window->document().volume());
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
        QVERIFY(!m_window->document().volume());
        QVERIFY(find<QWidget>("startPage")->isVisible());
    }

    void aReferenceToADiscThatIsAwaySaysSo() {
        const fs::path disc = m_folder / "away";
        fs::copy(m_folder / "head", disc);
        import(disc, false);
        fs::remove_all(disc);
        click(volumeRow("Secret Name"));
        QTRY_VERIFY_WITH_TIMEOUT(problems().contains("not there any more"), patienceMs);
        QVERIFY(!m_window->jobs().isRunning());
        QVERIFY(find<QWidget>("startPage")->isVisible());
    }

    void aZipIsOpenedAndImported() {
        const QString zip = QString::fromStdString((m_folder / "study.zip").string());
        QProcess packer;
        packer.setWorkingDirectory(headPath());
        packer.start("python3", {"-m", "zipfile", "-c", zip, "."});
        QVERIFY(packer.waitForFinished() && packer.exitCode() == 0);
        open(zip);
        QCOMPARE(m_window->document().volume()->lattice().size().k, 80);
        const fs::path sessions = m_folder / "cache" / "pellucid" / "sessions";
        QVERIFY(!fs::is_empty(sessions));
        // What an archive was unpacked to goes with the program: it is copied whatever is chosen.
        choose(volumeRow("Secret Name"), "addStudyAction");
        QTRY_VERIFY(dialog("importDialog") != nullptr);
        acceptImport(false);
        restart();
        QVERIFY(fs::is_empty(sessions));
        click(volumeRow("Secret Name"));
        settle();
        QCOMPARE(m_window->document().volume()->lattice().size().k, 80);
    }

    void problemsOfAnImportAreOneList() {
        const fs::path mixed = m_folder / "mixed";
        fs::copy(m_folder / "head", mixed);
        for (int n = 0; n < 12; ++n)
            std::ofstream(mixed / ("note" + std::to_string(n) + ".txt")) << "not an image, sorry";
        std::ofstream(mixed / "IM0").flush();
        import(mixed, false);
        QCOMPARE(m_window->document().problems().size(), std::size_t(13));
        QCOMPARE(find<QListWidget>("problemList")->count(), 2);
        QVERIFY(problems().contains("12 files: is not a DICOM file"));
        QVERIFY(problems().contains("IM0: is empty"));
        QVERIFY(QApplication::activeModalWidget() == nullptr);
    }

    void anImportThatFindsNothingSaysWhy() {
        fs::create_directories(m_folder / "empty");
        import(m_folder / "empty", false);
        QTRY_VERIFY(problems().contains("holds no usable images"));
        QCOMPARE(rows(), QStringList());
    }

    void detailsNameGeometryAndFiles() {
        open(headPath());
        choose(volumeRow("Secret Name"), "volumeDetailsAction");
        QTRY_VERIFY(dialog("studyDetails") != nullptr);
        QStringList said;
        for (const QLabel *label : dialog("studyDetails")->findChildren<QLabel *>())
            said << label->text();
        QVERIFY(said.contains(headPath()));
        QVERIFY(said.contains("80"));
        QVERIFY(said.contains(QString::fromUtf8("80 × 96 × 96")));
        save("details");
        QVERIFY(
            dialog("studyDetails")
                ->grab()
                .save(qEnvironmentVariable("PELLUCID_ARTIFACTS", "/tmp") + "/study_details.png"));
        dialog("studyDetails")->close();
    }

    void aClosedStudyLeavesTheList() {
        open(headPath());
        choose(volumeRow("Secret Name"), "closeStudyAction");
        QTRY_COMPARE(rows(), QStringList());
        QVERIFY(!m_window->document().volume());
        open(headPath());
        QCOMPARE(rows(), QStringList({"Secret Name"}));
    }

    void aDropOnTheStudiesImports() {
        drop(*find<QWidget>("studyPanel"), {QUrl::fromLocalFile(headPath())});
        QTRY_VERIFY(dialog("importDialog") != nullptr);
        acceptImport(false);
        QCOMPARE(rows(), QStringList({"Secret Name"}));
    }

    void aPriorStandsBesideAndMovesAlong() {
        open(headPath());
        import(m_folder / "three", false);
        const scene::Camera camera = m_window->document().scene().camera;
        choose(volumeRow("Zhang Wei"), "openBesideAction");
        auto *beside = find<ui::StudyBeside>("studyBeside");
        auto *other = find<ui::ProjectionView>("beside_projectionView");
        QTRY_VERIFY_WITH_TIMEOUT(other->showsFinalImage() && !beside->jobs().isRunning(),
                                 patienceMs);
        QVERIFY(find<QLabel>("studyHeading")->isVisible());
        QVERIFY(find<QLabel>("besideName")->text().contains("Zhang Wei"));
        ui::Document &open = m_window->document(), &prior = beside->document();
        QCOMPARE(open.scene().camera.orientation, camera.orientation); // the open one led
        QCOMPARE(open.scene().camera.panMm, camera.panMm);
        // The projection turns alike, from either side.
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(), {60, 20});
        QVERIFY(prior.scene().camera.orientation == open.scene().camera.orientation);
        dragMouse(other, Qt::LeftButton, other->rect().center(), {-90, 0});
        QVERIFY(prior.scene().camera.orientation == open.scene().camera.orientation);
        QVERIFY(std::abs(prior.scene().camera.pixelMm - open.scene().camera.pixelMm) < 1e-9);
        // About the crosshairs, each about its own, which are at the same place of the pictures.
        find<QAction>("orbitCrosshairAction")->trigger();
        auto *axial = find<QWidget>("axialView");
        const QPoint to = axial->rect().center() + QPoint(40, 50);
        QMouseEvent move(QEvent::MouseMove, to, axial->mapToGlobal(to), Qt::NoButton, {},
                         Qt::ShiftModifier);
        QCoreApplication::sendEvent(axial, &move);
        for (QWidget *turned :
             {static_cast<QWidget *>(projection()), static_cast<QWidget *>(other)}) {
            dragMouse(turned, Qt::LeftButton, turned->rect().center(), {50, -30});
            const auto onPicture = [](ui::Document &document) {
                const scene::Camera &view = document.scene().camera;
                const glm::dvec3 at =
                    document.crosshair().mm - document.volume()->lattice().center().mm;
                return glm::dvec2(glm::dot(view.axes()[0], at), glm::dot(view.axes()[1], at)) -
                       view.panMm;
            };
            QVERIFY(glm::length(onPicture(open)) > 10.0);
            QVERIFY(glm::distance(onPicture(open), onPicture(prior)) < 1e-6);
        }
        find<QAction>("orbitCrosshairAction")->trigger();
        // So do planes and windows, and the window of either is one step to undo.
        const glm::dvec3 apart = prior.crosshair().mm - open.crosshair().mm;
        turnWheel(find<QWidget>("axialView"), 2);
        QVERIFY(glm::distance(prior.crosshair().mm - open.crosshair().mm, apart) < 1e-6);
        turnWheel(find<QWidget>("beside_axialView"), -1);
        QVERIFY(glm::distance(prior.crosshair().mm - open.crosshair().mm, apart) < 1e-6);
        QTest::keyClick(m_window.get(), Qt::Key_S);
        QVERIFY(prior.cut() == open.cut());
        const auto before = open.displayWindow();
        dragMouse(find<QWidget>("beside_coronalView"), Qt::LeftButton, {60, 60}, {40, -20});
        QVERIFY(!(open.displayWindow() == before));
        QVERIFY(prior.displayWindow() == open.displayWindow());
        find<QAction>("undoAction")->trigger();
        QVERIFY(open.displayWindow() == before);
        QVERIFY(prior.displayWindow() == before);
        // And looks, and layouts.
        clickPreset(*m_window, "Bone");
        settle();
        QVERIFY(prior.scene().look == open.scene().look);
        QTRY_VERIFY_WITH_TIMEOUT(other->showsFinalImage() && !beside->jobs().isRunning(),
                                 patienceMs);
        save("beside");
        QTest::mouseDClick(find<QWidget>("beside_axialView"), Qt::LeftButton, {}, {50, 80});
        QVERIFY(find<QWidget>("axialView")->isVisible());
        QVERIFY(!projection()->isVisible());
        QTest::mouseDClick(find<QWidget>("axialView"), Qt::LeftButton, {}, {50, 80});
        QVERIFY(other->isVisible());
        // Matched by hand: unlinked, moved, linked again.
        QTest::mouseClick(find<QToolButton>("linkButton"), Qt::LeftButton);
        QVERIFY(!find<QAction>("linkStudiesAction")->isChecked());
        // The keypad turns the projection that has the keyboard.
        const auto orientation = open.scene().camera.orientation;
        QTest::keyClick(other, Qt::Key_7, Qt::KeypadModifier);
        QVERIFY(prior.scene().camera.orientation ==
                scene::viewOrientation(scene::StandardView::top));
        QVERIFY(open.scene().camera.orientation == orientation);
        turnWheel(find<QWidget>("beside_axialView"), 1);
        const glm::dvec3 matched = prior.crosshair().mm - open.crosshair().mm;
        QVERIFY(glm::distance(matched, apart) > 0.5);
        find<QAction>("linkStudiesAction")->trigger();
        turnWheel(find<QWidget>("axialView"), 1);
        QVERIFY(glm::distance(prior.crosshair().mm - open.crosshair().mm, matched) < 1e-6);
        QTest::mouseClick(find<QToolButton>("closeBesideButton"), Qt::LeftButton);
        QTRY_VERIFY(m_window->findChild<ui::StudyBeside *>("studyBeside") == nullptr);
        QVERIFY(!find<QLabel>("studyHeading")->isVisible());
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(), {60, 20});
        settle();
    }

private:
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
                // What is in a study is asked for when it is looked into.
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

    // By the menu of a row, as the right button opens it.
    void choose(const QModelIndex &row, const char *action) {
        emit tree()->customContextMenuRequested(middle(row));
        auto *menu = m_window->findChild<QMenu *>("studyMenu");
        QVERIFY(menu != nullptr);
        QAction *wanted = menu->findChild<QAction *>(action);
        QVERIFY2(wanted != nullptr, action);
        wanted->trigger();
        menu->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    QWidget *dialog(const char *name) { return m_window->findChild<QWidget *>(name); }

    void acceptImport(bool copies) {
        find<QRadioButton>(copies ? "copyButton" : "referButton")->click();
        QSignalSpy over(&m_window->library().jobs(), &ui::JobRunner::finished);
        QTest::mouseClick(find<QPushButton>("importNowButton"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(over.count() > 0, patienceMs);
        QTRY_VERIFY(dialog("importDialog") == nullptr);
    }

    void import(const fs::path &path, bool copies) {
        m_window->fileMenu().importPaths({QString::fromStdString(path.string())});
        QTRY_VERIFY(dialog("importDialog") != nullptr);
        acceptImport(copies);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::StudiesTest>(argc, argv);
}

#include "studies_test.moc"
