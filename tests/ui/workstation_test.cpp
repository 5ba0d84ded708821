// SPDX-License-Identifier: GPL-3.0-or-later
// The workstation as a person uses it: drops, drags, wheels and keys on the real window.
#include "tests/ui/workstation.h"

#include <filesystem>
#include <fstream>

#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QToolButton>
#include <QTreeView>

#include "ui/document/commands.h"
#include "ui/opening/kept_studies.h"
#include "ui/panels/study_panel.h"
#include "ui/views/mpr_view.h"

namespace pellucid {

using namespace test;

class WorkstationTest : public Workstation {
    Q_OBJECT
private slots:
    void theStartPageComesFirstAndTheTitleHidesThePatient() {
        QVERIFY(find<QWidget>("startPage")->isVisible());
        QVERIFY(!find<QWidget>("paneArea")->isVisible());
        open(headPath());
        QVERIFY(!find<QWidget>("startPage")->isVisible());
        QVERIFY(!mainWindow().windowTitle().contains("Secret"));
        // The open series is the selected row.
        QVERIFY(document().currentSource() == 0);
        QVERIFY(find<QTreeView>("seriesTree")->currentIndex().isValid());
    }

    void everyPaneShowsTheVolume() {
        open(headPath());
        for (const char *name : {"axialView", "coronalView", "sagittalView", "projectionView"}) {
            const QImage pane = grab(name);
            QVERIFY2(meanGrey(pane) > 8.0, name);
            // The corner away from texts is outside the patient.
            QVERIFY2(meanGrey(pane, QRect(4, pane.height() / 4, 10, 10)) < 3.0, name);
        }
        // Radiological convention on the head: the nose is up in the axial pane, at the left in the
        // sagittal.
        const QImage sagittal = grab("sagittalView");
        const int w = sagittal.width(), h = sagittal.height();
        QVERIFY(meanGrey(sagittal, QRect(w / 8, h * 6 / 10, w / 4, h / 5)) > 5.0);
    }

    void orbitingTurnsThePictureAndTheLetters() {
        open(headPath());
        const QImage before = grab("projectionView");
        const auto camera = document().scene().camera;
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(),
                  {197, 0}); // 90 degrees
        settle();
        QVERIFY(changed(before, grab("projectionView")) > 0.02);
        // Dragging to the right brings the patient's right side, at image left, to the front.
        const glm::dmat3 axes = document().scene().camera.axes();
        QVERIFY2(axes[2].x < -0.9, "the viewer is now at the patient's right");
        QVERIFY(!(document().scene().camera == camera));
        // Looking is not undoable.
        QVERIFY(!document().undoStack()->canUndo());
        QTest::keyClick(projection(), Qt::Key_1, Qt::KeypadModifier);
        QVERIFY(glm::dot(document().scene().camera.axes()[2], glm::dvec3(0, -1, 0)) > 0.999);
    }

    void thePlanesScrollAndTheCrosshairIsLinked() {
        open(headPath());
        const QImage before = grab("axialView");
        const QImage coronal = grab("coronalView");
        const double z = document().crosshair().mm.z;
        turnWheel(find<QWidget>("axialView"), 1);
        QVERIFY(document().crosshair().mm.z > z);
        turnWheel(find<QWidget>("axialView"), 1);
        turnWheel(find<QWidget>("axialView"), 1);
        QVERIFY(changed(before, grab("axialView")) > 0.005);
        QVERIFY(changed(coronal, grab("coronalView")) > 0.0005); // its crosshair line moved
        QTest::keyClick(find<QWidget>("axialView"), Qt::Key_Home);
        const auto &lattice = document().volume()->lattice();
        QVERIFY(std::abs(document().crosshair().mm.z - lattice.origin().mm.z) < 1e-6);
    }

    void windowingIsUndoneInOneStep() {
        open(headPath());
        const auto before = document().displayWindow();
        const QImage picture = grab("axialView");
        dragMouse(find<QWidget>("axialView"), Qt::LeftButton, {150, 150}, {80, -60});
        QVERIFY(document().displayWindow().width > before.width);
        QVERIFY(document().displayWindow().center > before.center);
        QVERIFY(changed(picture, grab("axialView")) > 0.02);
        QCOMPARE(document().undoStack()->count(), 1);
        find<QAction>("undoAction")->trigger();
        QVERIFY(document().displayWindow() == before);
        // A preset by its key, and back.
        QTest::keyClick(&mainWindow(), Qt::Key_4);
        QCOMPARE(document().displayWindow().width, 1500.0);
        find<QAction>("undoAction")->trigger();
        QVERIFY(document().displayWindow() == before);
    }

    void reconstructionAndFilmAreUndoableEditsOfTheScene() {
        open(headPath());
        const QImage before = grab("projectionView");
        find<QAction>("filmAction")->trigger();
        settle();
        QVERIFY(meanGrey(grab("projectionView")) > meanGrey(before) + 40.0);
        find<QAction>("bandLimitedAction")->trigger();
        QVERIFY(document().scene().image.reconstruction == scene::Reconstruction::bandLimited);
        find<QAction>("undoAction")->trigger();
        find<QAction>("undoAction")->trigger();
        QVERIFY(document().scene().tone == scene::Tone());
        QVERIFY(!find<QAction>("filmAction")->isChecked());
    }

    void anEditWithoutEffectIsNotInTheHistory() {
        open(headPath());
        QUndoStack &edits = *document().undoStack();
        find<QAction>("filmAction")->trigger();
        find<QAction>("undoAction")->trigger();
        const ChangeCount edited(document(), ui::Change::scene);
        const auto nothing = [](scene::Scene &) {};
        QVERIFY(!ui::editScene(document(), "Nothing", ui::noDrag, nothing));
        // Looking is no edit either.
        QVERIFY(!ui::editScene(document(), "View", ui::noDrag, [](scene::Scene &scene) {
            scene.camera.panMm = {50.0, 0.0};
        }));
        find<QAction>("cubicAction")->trigger(); // as it is
        find<QAction>("automaticToneAction")->trigger();
        QCOMPARE(edits.count(), 1);
        QVERIFY(edits.canRedo()); // an edit would have cleared the edits to redo
        QCOMPARE(edited.count(), 0);
        QVERIFY(ui::editScene(document(), "Film", ui::noDrag,
                              [](scene::Scene &scene) { scene.tone.inverted = true; }));
        QCOMPARE(edits.count(), 1);
        QCOMPARE(edits.undoText(), QString("Film"));
        settle();
    }

    void aReopenedStudyAppearsAtOnceAsItWas() {
        open(headPath());
        choosePreset("Bone");
        QTest::keyClick(projection(), Qt::Key_3, Qt::KeypadModifier);
        settle();
        const QImage before = projection()->picture();
        find<QAction>("chestPhantomAction")->trigger();
        QTRY_VERIFY(document().currentSource() == 1);
        settle();
        QVERIFY(document().scene().look == classify::Look()); // a study of its own
        emit find<ui::StudyPanel>("studyPanel")->sourceActivated(0);
        QVERIFY(!jobs().isRunning());
        QVERIFY(!document().scene().look.classes.empty());
        settle();
        QVERIFY(changed(before, projection()->picture()) < 0.001);
    }

    void keptStudiesAreTrimmedSpectraFirstAndOldestFirst() {
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{32, 32, 32}});
        const auto volume = phantom::makePhantom(phantom::Kind::head, lattice);
        scene::Scene scene;
        scene.camera = scene::defaultCamera(lattice);
        const auto engine = prepare::prepareEngine(
            {scene, classify::ShownFields{{classify::densityField(volume, {-900, 2000})}, {}}});
        ui::KeptStudies kept;
        ui::KeptStudy study{
            .opened = {volume, {}, {}}, .preparedFor = ui::PreparedFor(), .engine = engine};
        for (study.source = 0; study.source < 3; ++study.source)
            kept.keep(study);
        const std::size_t one = volume.bytes() + engine.bytes;
        QCOMPARE(kept.bytes(), 3 * one);
        kept.trim(3 * one - 1);
        QCOMPARE(int(kept.count()), 3); // a spectrum was dropped
        QVERIFY(!kept.take(0)->engine);
        QVERIFY(kept.take(2)->engine);
        kept.trim(volume.bytes());
        QCOMPARE(int(kept.count()), 1);
        QVERIFY(!kept.take(1)->engine);
        QVERIFY(!kept.take(1));
        QCOMPARE(kept.bytes(), std::size_t(0));
    }

    void aPaneFillsTheWindowByDoubleClick() {
        open(headPath());
        auto *axial = find<QWidget>("axialView");
        const QSize before = axial->size();
        QTest::mouseDClick(axial, Qt::LeftButton);
        QVERIFY(axial->width() > 2 * before.width());
        QVERIFY(!projection()->isVisible());
        QTest::mouseDClick(axial, Qt::LeftButton);
        QCOMPARE(axial->size(), before);
        QVERIFY(projection()->isVisible());
    }

    void theReadoutNamesPositionAndValue() {
        open(headPath());
        auto *axial = find<QWidget>("axialView");
        moveMouse(axial, axial->rect().center());
        const QString text = find<QLabel>("cursorReadout")->text();
        QVERIFY2(text.contains("HU") && text.contains("mm"), qPrintable(text));
    }

    // The wheel scrolls a panel without changing the boxes that pass below it.
    void theWheelScrollsPastBoxesWithoutChangingThem() {
        open(headPath());
        auto *box = find<QComboBox>("reconstructionBox");
        const int before = box->currentIndex();
        const auto roll = [&] {
            const QPointF at(box->rect().center());
            QWheelEvent event(at, box->mapToGlobal(at), {}, {0, -120}, Qt::NoButton, Qt::NoModifier,
                              Qt::NoScrollPhase, false);
            QApplication::sendEvent(box, &event);
        };
        roll();
        QCOMPARE(box->currentIndex(), before);
        QVERIFY(!box->hasFocus());
        box->setFocus();
        roll();
        QVERIFY(box->currentIndex() != before);
    }

    void cancelTakesEffectAtOnce() {
        QSignalSpy progressed(&jobs(), &ui::JobRunner::progressed);
        drop(mainWindow(), {QUrl::fromLocalFile(headPath())});
        QVERIFY(progressed.wait(patienceMs)); // it is at work
        QElapsedTimer clock;
        clock.start();
        find<QPushButton>("jobCancel")->click();
        QVERIFY(!jobs().isRunning());
        QVERIFY2(clock.elapsed() < 100, "the promise is 100 ms");
        // No late result arrives: the thread has ended, and everything that it queued is handled.
        jobs().join();
        QCoreApplication::processEvents();
        QVERIFY(!document().volume());
        // The study can be opened again.
        open(headPath());
        QVERIFY(document().volume());
    }

    // A study whose first projection was cancelled has none to return to.
    void aCancelledPreparationIsRepeatedByF5() {
        mainWindow().openPaths({headPath()});
        QTRY_VERIFY_WITH_TIMEOUT(
            document().volume() && !document().isPreview() && jobs().isRunning(), patienceMs);
        QTest::keyClick(&mainWindow(), Qt::Key_Escape);
        QVERIFY(!jobs().isRunning());
        QCOMPARE(projection()->frames().planState(), ui::PlanState::cancelled);
        QTest::keyClick(&mainWindow(), Qt::Key_F5);
        QCOMPARE(projection()->frames().planState(), ui::PlanState::underway);
        settle();
        QCOMPARE(projection()->frames().planState(), ui::PlanState::holds);
    }

    // The picture, its name and the scene return together, and the cancel can be undone.
    void aCancelReturnsToWhatIsShown() {
        open(headPath());
        const double tolerance = document().scene().tolerance;
        ui::editScene(document(), "Tolerance", ui::noDrag,
                      [](scene::Scene &scene) { scene.tolerance = 1e-5; });
        QVERIFY(jobs().isRunning());
        QTest::keyClick(&mainWindow(), Qt::Key_Escape);
        QVERIFY(!jobs().isRunning());
        QCOMPARE(projection()->frames().planState(), ui::PlanState::holds);
        QCOMPARE(document().scene().tolerance, tolerance);
        document().undoStack()->undo();
        settle();
        QCOMPARE(document().scene().tolerance, 1e-5);
        QCOMPARE(projection()->frames().planState(), ui::PlanState::holds);
        QVERIFY(find<QLabel>("predictedErrorLabel")->text().section(' ', -2, -2).toDouble() <=
                1e-3);
    }

    // No full picture follows a coarse one after a cancel: the former look comes back.
    void aCancelledLookRestoresTheFormerPicture() {
        mainWindow().openPhantom("head");
        settle();
        const QImage former = projection()->picture();
        const classify::Look look = document().scene().look;
        ui::editScene(document(), "Bone", ui::noDrag, [](scene::Scene &scene) {
            scene.look.classes.push_back({.name = "Bone", .low = 200.0, .high = 3000.0});
        });
        QTRY_VERIFY_WITH_TIMEOUT(!projection()->frames().isFinal(), patienceMs);
        QTest::keyClick(&mainWindow(), Qt::Key_Escape);
        QVERIFY(document().scene().look == look);
        QTRY_VERIFY_WITH_TIMEOUT(projection()->frames().showsFinalImage(), patienceMs);
        QCOMPARE(projection()->frames().planState(), ui::PlanState::holds);
        QVERIFY(changed(former, projection()->picture()) < 0.001);
        document().undoStack()->undo();
        settle();
        QVERIFY(changed(former, projection()->picture()) > 0.02);
    }

    void aPictureKeepsItsBrightnessUntilTheNextArrives() {
        open(headPath());
        const double before = meanGrey(grab("projectionView"));
        QTest::keyClick(&mainWindow(), Qt::Key_D); // another kind of cue has a different brightness
        QVERIFY(std::abs(meanGrey(grab("projectionView")) - before) < 2.0);
        settle();
    }

    void resettingTheProjectionResetsItsWindowToo() {
        open(headPath());
        dragMouse(projection(), Qt::RightButton, QPoint(200, 200), QPoint(60, 30));
        QVERIFY(document().scene().tone.high.has_value());
        projection()->setFocus();
        QTest::keyClick(projection(), Qt::Key_R);
        QVERIFY(document().scene().tone == scene::Tone());
        QTest::keyClick(&mainWindow(), Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(document().scene().tone.high.has_value());
    }

    void thePhantomOpensFromTheStartPage() {
        find<QPushButton>("headPhantomButton")->click();
        settle();
        save("phantom");
        QVERIFY(meanGrey(grab("projectionView")) > 5.0);
        QCOMPARE(find<QTreeView>("seriesTree")->model()->rowCount(), 1);
    }

    void imagesWithoutPositionsOpenAsImages() {
        if (testData().isEmpty())
            QSKIP("PELLUCID_TEST_DATA is not set: the real series are absent");
        drop(mainWindow(), {QUrl::fromLocalFile(testData() + "/nasty_pydicom/image_dfl.dcm")});
        QTRY_VERIFY_WITH_TIMEOUT(document().volume() && !jobs().isRunning(), patienceMs);
        QVERIFY(!document().volume()->notes().placed);
        QVERIFY(meanGrey(grab("axialView")) > 5.0);
    }

    // Drop, wait, orbit, scroll, window, and look.
    void theChestCtOpensByDrop() {
        if (testData().isEmpty())
            QSKIP("PELLUCID_TEST_DATA is not set: the real series are absent");
        open(testData() + "/ct_chest_philips_64");
        save("chest");
        for (const char *name : {"axialView", "coronalView", "sagittalView", "projectionView"})
            QVERIFY2(meanGrey(grab(name)) > 10.0, name);
        // The lungs are darker than the mediastinum between them.
        const QImage front = grab("projectionView");
        const int w = front.width(), h = front.height();
        const double middle = meanGrey(front, QRect(w / 2 - 20, h / 2 - 20, 40, 40));
        const double lung = meanGrey(front, QRect(w * 38 / 100 - 20, h / 2 - 20, 40, 40));
        QVERIFY2(middle > lung + 30.0, "mediastinum over lung");
        // The heart is on the patient's left, at image right; at image left there is lung.
        const double heart = meanGrey(front, QRect(w * 56 / 100 - 12, h * 60 / 100 - 12, 24, 24));
        const double mirror = meanGrey(front, QRect(w * 44 / 100 - 12, h * 60 / 100 - 12, 24, 24));
        QVERIFY2(heart > mirror + 15.0, "the heart is on the patient's left");

        const QImage coronal = grab("coronalView"), axial = grab("axialView");
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(), {120, -40});
        settle();
        QVERIFY(changed(front, grab("projectionView")) > 0.05);
        for (int n = 0; n < 6; ++n)
            turnWheel(find<QWidget>("axialView"), 1);
        QVERIFY(changed(axial, grab("axialView")) > 0.02);
        QTest::keyClick(&mainWindow(), Qt::Key_5); // lung window
        QVERIFY(changed(coronal, grab("coronalView")) > 0.1);
        save("chest_turned");
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::WorkstationTest>(argc, argv);
}

#include "workstation_test.moc"
