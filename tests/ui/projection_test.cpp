// SPDX-License-Identifier: GPL-3.0-or-later
// The projection: its center of rotation, the part of the volume that it shows, and the comparison
// of looks.
#include "tests/ui/workstation.h"

#include <QDialog>
#include <QLabel>
#include <QListWidget>
#include <QProcess>
#include <QSpinBox>
#include <QToolButton>

#include "core/scene/positioner_angles.h"
#include "ui/document/commands.h"
#include "ui/panels/study_panel.h"
#include "ui/views/mpr_view.h"

namespace pellucid {

using namespace test;

class ProjectionTest : public Workstation {
    Q_OBJECT
private slots:
    void init() {
        Workstation::init();
        open(headPath());
    }

    void turningAboutTheCrosshairLeavesItInPlace() {
        ui::Document &document = mainWindow().document();
        QTest::keyClick(projection(), Qt::Key_1, Qt::KeypadModifier);
        document.setCrosshair({document.volume()->lattice().center().mm + glm::dvec3(40, -30, 25)});
        const glm::dvec2 before = onPicture(document.crosshair());
        drag({60, 25});
        QVERIFY(glm::distance(onPicture(document.crosshair()), before) > 5.0); // about the middle
        QTest::keyClick(&mainWindow(), Qt::Key_O);
        QVERIFY(find<QAction>("orbitCrosshairAction")->isChecked());
        const glm::dvec2 now = onPicture(document.crosshair());
        drag({-130, 70});
        QVERIFY(glm::distance(onPicture(document.crosshair()), now) < 1e-6);
        turnWheel(projection(), 1); // no longer fitted: a standard view would be fitted, too
        const glm::dvec2 zoomed = onPicture(document.crosshair());
        QTest::keyClick(projection(), Qt::Key_3, Qt::KeypadModifier);
        QVERIFY(glm::distance(onPicture(document.crosshair()), zoomed) < 1e-6);
        settle();
        save("orbit_crosshair");
    }

    // The document has the pose; only the camera depends on the pane.
    void aResizeKeepsThePoseAndChangesNothingElse() {
        find<QAction>("twoByTwoAction")->trigger();
        turnWheel(projection(), 1);
        drag({40, 10});
        settle();
        ui::Document &document = mainWindow().document();
        const ui::Pose pose = document.pose();
        QVERIFY(pose.zoom > 1.1);
        const scene::Camera before = document.scene().camera;
        const QImage picture = projection()->picture();
        const int edits = document.undoStack()->count();
        const ChangeCount edited(document, ui::Change::scene | ui::Change::pose);
        QTest::mouseDClick(projection(), Qt::LeftButton); // fills the window
        QTRY_VERIFY(document.scene().camera.height > before.height);
        settle();
        QVERIFY(document.pose() == pose);
        // The shorter side shows as much of the patient as before.
        const auto shownMm = [](const scene::Camera &camera) {
            return std::min(camera.width, camera.height) * camera.pixelMm;
        };
        QVERIFY(std::abs(shownMm(document.scene().camera) - shownMm(before)) < 1e-6);
        QTest::mouseDClick(projection(), Qt::LeftButton);
        QTRY_VERIFY(document.scene().camera == before);
        settle();
        QVERIFY(projection()->picture() == picture);
        QVERIFY(document.pose() == pose);
        QCOMPARE(document.undoStack()->count(), edits);
        QCOMPARE(edited.count(), 0);
    }

    // Even if the pane has another size by then.
    void everyStudyComesBackWithItsOwnZoom() {
        ui::Document &document = mainWindow().document();
        turnWheel(projection(), 1);
        turnWheel(projection(), 1);
        const ui::Pose head = document.pose();
        QVERIFY(head.zoom > 1.2);
        find<QAction>("chestPhantomAction")->trigger();
        QTRY_VERIFY(document.currentSource() == 1);
        settle();
        QVERIFY(document.pose().isFitted); // of its own
        QVERIFY(document.pose().orientation == ui::Pose().orientation);
        const int height = document.scene().camera.height;
        find<QAction>("twoByTwoAction")->trigger();
        QTRY_VERIFY(document.scene().camera.height < height);
        turnWheel(projection(), -1);
        const ui::Pose chest = document.pose();
        QVERIFY(chest.zoom < head.zoom);
        auto *studies = find<ui::StudyPanel>("studyPanel");
        emit studies->sourceActivated(0);
        QVERIFY(document.pose() == head);
        settle();
        emit studies->sourceActivated(1);
        QVERIFY(document.pose() == chest);
        settle();
    }

    void theZoomHasLimits() {
        ui::Document &document = mainWindow().document();
        for (int n = 0; n < 40; ++n)
            turnWheel(projection(), 1);
        QCOMPARE(document.pose().zoom, ui::maxZoom);
        settle();
        const scene::Camera &camera = document.scene().camera; // every pixel is computed
        QCOMPARE(projection()->picture().size(), QSize(camera.width, camera.height));
        for (int n = 0; n < 60; ++n)
            turnWheel(projection(), -1);
        QCOMPARE(document.pose().zoom, ui::minZoom);
        QTest::keyClick(projection(), Qt::Key_0, Qt::KeypadModifier);
        QVERIFY(document.pose().isFitted);
        QVERIFY(document.pose().orientation == ui::Pose().orientation);
        settle();
    }

    // The shadow of the head fills the pane, whatever the view, and does not move while it turns.
    void theViewFitsTheBody() {
        ui::Document &document = mainWindow().document();
        QTest::keyClick(projection(), Qt::Key_R);
        settle();
        const auto shadow = [this] {
            const QImage picture = projection()->picture();
            QRect area;
            for (int y = 0; y < picture.height(); ++y)
                for (int x = 0; x < picture.width(); ++x)
                    if (qGray(picture.pixel(x, y)) > 8)
                        area |= QRect(x, y, 1, 1);
            return std::pair(area, picture.rect());
        };
        for (const int key : {Qt::Key_1, Qt::Key_3, Qt::Key_7}) {
            QTest::keyClick(projection(), key, Qt::KeypadModifier);
            settle();
            const auto [area, pane] = shadow();
            QVERIFY(pane.adjusted(4, 4, -4, -4).contains(area));
            const double share = std::max(double(area.width()) / pane.width(),
                                          double(area.height()) / pane.height());
            QVERIFY2(share > 0.8, qPrintable(QString::number(share)));
        }
        QTest::keyClick(projection(), Qt::Key_1, Qt::KeypadModifier);
        const double zoom = document.pose().zoom;
        drag({200, 0});
        QCOMPARE(document.pose().zoom, zoom);
        QVERIFY(document.pose().isFitted);
        // Another layout fits it again; a view that was zoomed by hand keeps its own zoom.
        find<QAction>("twoByTwoAction")->trigger();
        settle();
        QVERIFY(shadow().second.contains(shadow().first));
        turnWheel(projection(), 1);
        QVERIFY(!document.pose().isFitted);
        QTest::keyClick(projection(), Qt::Key_R);
        QVERIFY(document.pose().isFitted);
        find<QAction>("onePlusThreeAction")->trigger();
        settle();
    }

    // A turntable: dragging sideways turns about the long axis, up and down to the poles. Alt
    // rolls.
    void aDragKeepsThePatientUpright() {
        ui::Document &document = mainWindow().document();
        QTest::keyClick(projection(), Qt::Key_R);
        const auto axes = [&] { return document.scene().camera.axes(); };
        for (const QPoint &delta : {QPoint(90, 40), QPoint(-250, 60), QPoint(30, -170)}) {
            drag(delta);
            QVERIFY(std::abs(axes()[0].z) < 1e-9);
            QVERIFY(axes()[1].z >= 0.0);
        }
        drag({0, 3000});
        QVERIFY(axes()[2].z > 0.999999); // from above, and no further
        drag({0, -3000});
        QVERIFY(axes()[2].z < -0.999999);
        QTest::keyClick(projection(), Qt::Key_R);
        find<QAction>("freeRotationAction")->trigger();
        drag({120, 80});
        drag({-20, 90});
        QVERIFY(std::abs(axes()[0].z) > 0.01);
        find<QAction>("freeRotationAction")->trigger();
        QTest::keyClick(projection(), Qt::Key_R);
        settle();
    }

    // The cube turns to the side that is clicked; the angles beside it open their dialog.
    void theCubeAndTheAnglesTurnTheView() {
        ui::Document &document = mainWindow().document();
        QTest::keyClick(projection(), Qt::Key_R);
        settle();
        const QPoint cube(58, projection()->height() - 72);
        const auto angles = [&] {
            return scene::positionerAngles(document.scene().camera.orientation);
        };
        QTest::mouseClick(projection(), Qt::LeftButton, {},
                          cube + QPoint(20, 0)); // edge to the left
        QVERIFY(std::abs(angles().primaryDeg - 45.0) < 1e-6);
        QVERIFY(std::abs(angles().secondaryDeg) < 1e-6);
        QTest::keyClick(projection(), Qt::Key_R);
        QTest::mouseClick(projection(), Qt::LeftButton, {}, cube + QPoint(0, -20));
        QVERIFY(std::abs(angles().secondaryDeg - 45.0) < 1e-6);
        settle();
        QTest::mouseClick(projection(), Qt::LeftButton, {},
                          QPoint(20, projection()->height() - 22));
        auto *const dialog = find<QDialog>("angleDialog");
        QVERIFY(dialog->isVisible());
        auto *const primary = find<QSpinBox>("primaryAngleBox");
        auto *const secondary = find<QSpinBox>("secondaryAngleBox");
        QCOMPARE(secondary->text(), QString::fromUtf8("CRA 45°"));
        primary->selectAll();
        QTest::keyClicks(primary, "rao 30");
        QTest::keyClick(primary, Qt::Key_Return);
        secondary->selectAll();
        QTest::keyClicks(secondary, "-20");
        QTest::keyClick(secondary, Qt::Key_Return);
        QVERIFY(dialog->isVisible());
        QVERIFY(std::abs(angles().primaryDeg + 30.0) < 1e-6);
        QVERIFY(std::abs(angles().secondaryDeg + 20.0) < 1e-6);
        QCOMPARE(primary->text(), QString::fromUtf8("RAO 30°"));
        auto *const list = find<QListWidget>("commonAnglesList");
        clickItem(*list, *list->item(9)); // spider
        QVERIFY(std::abs(angles().primaryDeg - 45.0) < 1e-6);
        QVERIFY(std::abs(angles().secondaryDeg + 30.0) < 1e-6);
        settle();
        save("angles");
        dialog->close();
        QTest::keyClick(projection(), Qt::Key_R);
        settle();
    }

    void theCropBoxIsDraggedInAPlaneAndUndone() {
        const QImage whole = projection()->picture();
        auto *axial = find<ui::MprView>("axialView");
        QTest::keyClick(&mainWindow(), Qt::Key_K);
        QVERIFY(find<QAction>("cropToolAction")->isChecked());
        // Dragging the left side of the box to the middle removes the patient's right half.
        const volume::Lattice &lattice = mainWindow().document().volume()->lattice();
        const auto at = [&](double column) {
            return axial->mapping()
                .positionOf(lattice.patient(
                    volume::VoxelPoint{{column, 0.5 * lattice.size().j, 0.5 * lattice.size().k}}))
                .toPoint();
        };
        const QImage before = grab("axialView");
        const QPoint from = at(-0.5), to = at(47.5);
        dragMouse(axial, Qt::LeftButton, from, to - from);
        const classify::CropBox crop = mainWindow().document().scene().crop;
        QVERIFY2(std::abs(crop.low.x - 0.5) < 0.03, qPrintable(QString::number(crop.low.x)));
        QCOMPARE(crop.high, glm::dvec3(1.0));
        QCOMPARE(crop.low.y, 0.0);
        QVERIFY(changed(before, grab("axialView")) > 0.03); // dimmed
        settle();
        const QImage half = projection()->picture();
        const int w = half.width(), h = half.height();
        // The left of the picture is empty. The right is unchanged except for the brightness, which
        // is measured again.
        QVERIFY(meanGrey(half, QRect(0, h / 4, w / 2 - 12, h / 2)) < 2.0);
        QVERIFY(meanGrey(half, QRect(w / 2, h / 4, w / 4, h / 2)) > 20.0);
        save("crop");
        find<QAction>("undoAction")->trigger();
        settle();
        QVERIFY(changed(whole, projection()->picture()) < 0.001);
        find<QAction>("redoAction")->trigger();
        QTest::keyClick(&mainWindow(), Qt::Key_K, Qt::ShiftModifier);
        QVERIFY(mainWindow().document().scene().crop.isWhole());
        settle();
        QVERIFY(changed(whole, projection()->picture()) < 0.001);
    }

    void escapeCancelsADragOfTheCropBox() {
        auto *axial = find<ui::MprView>("axialView");
        QTest::keyClick(&mainWindow(), Qt::Key_K);
        const volume::Lattice &lattice = mainWindow().document().volume()->lattice();
        const QPoint edge = axial->mapping()
                                .positionOf(lattice.patient(volume::VoxelPoint{
                                    {-0.5, 0.5 * lattice.size().j, 0.5 * lattice.size().k}}))
                                .toPoint();
        QTest::mousePress(axial, Qt::LeftButton, Qt::NoModifier, edge);
        QMouseEvent move(QEvent::MouseMove, edge + QPoint(50, 0),
                         axial->mapToGlobal(edge + QPoint(50, 0)), Qt::NoButton, Qt::LeftButton,
                         Qt::NoModifier);
        QCoreApplication::sendEvent(axial, &move);
        QTest::keyClick(axial, Qt::Key_Escape);
        QTest::mouseRelease(axial, Qt::LeftButton, Qt::NoModifier, edge + QPoint(50, 0));
        QVERIFY(mainWindow().document().scene().crop.isWhole());
        QVERIFY(!mainWindow().document().undoStack()->canUndo());
    }

    void aHeldKeyShowsTheFormerLookBesideThePresentOne() {
        QTest::keyPress(&mainWindow(), Qt::Key_Q);
        QVERIFY(!projection()->isComparing()); // nothing was before
        QTest::keyRelease(&mainWindow(), Qt::Key_Q);
        const QImage xRay = grab("projectionView");
        choosePreset("Bone");
        const QImage bone = grab("projectionView");
        // The gallery has the keyboard now, and would search for the letter.
        auto *gallery = find<QListWidget>("presetGallery");
        gallery->setFocus();
        QTest::keyPress(gallery, Qt::Key_Q);
        QVERIFY(projection()->isComparing());
        settle(); // the former look is made, too
        const QImage both = grab("projectionView");
        // The left half shows the middle of the former look, the right half that of the present
        // one.
        const int w = both.width(), h = both.height();
        const QRect area(0, h / 4, w / 2 - 4, h / 2), middle(w / 4, h / 4, w / 2 - 4, h / 2);
        QVERIFY(changed(both.copy(area), xRay.copy(middle)) < 0.05);
        QVERIFY(changed(both.copy(area.translated(w / 2, 0)), bone.copy(middle)) < 0.05);
        QVERIFY(changed(both.copy(area), bone.copy(middle)) > 0.1);
        save("compare");
        // It follows a view that turns, by the keypad wherever the keyboard is.
        const auto window = mainWindow().document().displayWindow();
        QTest::keyClick(find<QWidget>("axialView"), Qt::Key_3, Qt::KeypadModifier);
        QVERIFY(mainWindow().document().displayWindow() == window);
        settle();
        QVERIFY(changed(both.copy(area), grab("projectionView").copy(area)) > 0.05);
        QTest::keyRelease(&mainWindow(), Qt::Key_Q);
        QVERIFY(!projection()->isComparing());
        QVERIFY(changed(both, grab("projectionView")) > 0.05);
    }

    // Played as phases, they would seem to be in one place.
    void stacksInDifferentFramesOfReferenceAreNoPhases() {
        writePhases("spaces", false);
        open(QString::fromStdString((m_folder / "spaces").string()));
        const auto &sources = mainWindow().document().sources();
        QCOMPARE(std::count_if(sources.begin(), sources.end(),
                               [](const auto &s) { return s.volume.size.k == 40; }),
                 3);
        QVERIFY(!find<QWidget>("phaseBar")->isVisible());
    }

    // The frame of a phase stays on the screen until the next one has its own; what is measured of
    // it meanwhile belongs to no engine.
    void aPhaseIsLeftWhileItsPictureIsMeasured() {
        writePhases("left", true);
        open(QString::fromStdString((m_folder / "left").string()));
        ui::Document &document = mainWindow().document();
        scene::Camera part = document.scene().camera;
        part.pixelMm /= 8.0;
        part.panMm = {78.0, 60.0};
        document.setPose(document.poseOf(part), true);
        for (int n = 0; n < 12; ++n) {
            settle();
            QTest::qWait(300 + 20 * n); // the check begins after 300 ms
            const int now = document.currentSource();
            QTest::keyClick(&mainWindow(), Qt::Key_Period);
            QTRY_VERIFY_WITH_TIMEOUT(document.currentSource() != now, patienceMs);
        }
        settle();
    }

    void phasesKeepLookViewAndBrightness() {
        writePhases("phases", true);
        open(QString::fromStdString((m_folder / "phases").string()));
        QVERIFY(find<QWidget>("phaseBar")->isVisible());
        QVERIFY(find<QLabel>("phaseLabel")->text().startsWith("Phase 1 of 3"));
        choosePreset("Bone");
        QTest::keyClick(projection(), Qt::Key_3, Qt::KeypadModifier);
        drag({30, 10});
        settle();
        ui::Document &document = mainWindow().document();
        const scene::Scene before = document.scene();
        const auto window = document.displayWindow();
        auto *axial = find<ui::MprView>("axialView");
        axial->moveView({1.7, {5.0, -3.0}});
        const QImage first = projection()->picture();
        QTest::keyClick(&mainWindow(), Qt::Key_Period);
        QTRY_VERIFY_WITH_TIMEOUT(find<QLabel>("phaseLabel")->text().startsWith("Phase 2 of 3"),
                                 patienceMs);
        settle();
        const QImage second = projection()->picture();
        QVERIFY(document.scene().look == before.look);
        QVERIFY(document.scene().camera == before.camera);
        QVERIFY(document.displayWindow() == window);
        QCOMPARE(axial->view().zoom, 1.7);
        // Denser bone under the brightness of the first phase is brighter.
        QVERIFY2(meanGrey(second) > meanGrey(first) + 1.0,
                 qPrintable(QString("%1 %2").arg(meanGrey(first)).arg(meanGrey(second))));
        save("phases");
        QTest::keyClick(&mainWindow(), Qt::Key_Comma);
        QVERIFY(!mainWindow().jobs().isRunning()); // it was kept
        settle();
        QVERIFY(changed(first, projection()->picture()) < 0.001);
        // Played: around, each loaded once.
        QTest::mouseClick(find<QToolButton>("playPhasesButton"), Qt::LeftButton);
        QSet<int> seen;
        QTRY_VERIFY_WITH_TIMEOUT((seen << document.currentSource()).size() == 3, patienceMs);
        const int now = document.currentSource();
        QTRY_VERIFY_WITH_TIMEOUT(document.currentSource() != now, patienceMs);
        QTest::keyClick(&mainWindow(), Qt::Key_Space, Qt::ShiftModifier);
        QVERIFY(!find<QToolButton>("playPhasesButton")->isChecked());
        settle();
        open(headPath());
        QVERIFY(!find<QWidget>("phaseBar")->isVisible());
    }

private:
    // One series with three temporal positions, its bone denser each time.
    // In the folder, each phase with a space of its own or all in one.
    void writePhases(const char *name, bool isOneSpace) {
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{48, 48, 40}});
        const volume::Volume head = phantom::makePhantom(phantom::Kind::head, lattice);
        for (int phase = 1; phase <= 3; ++phase) {
            std::vector<std::int16_t> samples;
            head.visit([&](const auto &from) {
                for (const auto value : from)
                    samples.push_back(
                        std::int16_t(value > 300 ? value + 250 * (phase - 1) : value));
            });
            const auto folder = m_folder / name / std::to_string(phase);
            dicom::writeCtSeries(folder,
                                 volume::Volume(lattice, samples, volume::ValueUnit::hounsfield),
                                 {.patientName = "Phases"}, dicom::TransferSyntax::explicitLittle);
            QStringList arguments{
                "-nb",
                "-m",
                "StudyInstanceUID=1.2.276.0.1",
                "-m",
                "SeriesInstanceUID=1.2.276.0.2",
                "-m",
                QString("FrameOfReferenceUID=1.2.276.0.3.%1").arg(isOneSpace ? 1 : phase),
                "-i",
                QString("TemporalPositionIdentifier=%1").arg(phase)};
            for (const auto &file : std::filesystem::directory_iterator(folder))
                arguments << QString::fromStdString(file.path().string());
            QCOMPARE(QProcess::execute("dcmodify", arguments), 0);
        }
    }
    glm::dvec2 onPicture(volume::PatientPoint point) const {
        const scene::Camera &camera = mainWindow().document().scene().camera;
        const glm::dmat3 axes = camera.axes();
        const glm::dvec3 d = point.mm - mainWindow().document().volume()->lattice().center().mm;
        return glm::dvec2(glm::dot(axes[0], d), glm::dot(axes[1], d)) - camera.panMm;
    }
    void drag(QPoint by) {
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(), by);
    }
    void choosePreset(const QString &name) {
        clickPreset(mainWindow(), name);
        settle();
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::ProjectionTest>(argc, argv);
}

#include "projection_test.moc"
