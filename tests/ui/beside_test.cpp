// SPDX-License-Identifier: GPL-3.0-or-later
// Two studies side by side: they move together and can be matched by hand.
#include "tests/ui/studies_window.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include "ui/beside/study_beside.h"
#include "ui/dialogs/display_window_dialog.h"

namespace pellucid {

using namespace test;

class BesideTest : public StudiesWindow {
    Q_OBJECT
private slots:
    void initTestCase() {
        StudiesWindow::initTestCase();
        writeChests();
    }
    // The steps follow each other beside one study; the first that fails ends the test.
    void aPriorIsShownBesideAndMovesAlong() {
        using Step = void (BesideTest::*)();
        for (const Step step :
             {&BesideTest::openAPrior, &BesideTest::turnTheProjections, &BesideTest::resizeThePanes,
              &BesideTest::turnAboutTheCrosshairs, &BesideTest::movePlanesAndWindows,
              &BesideTest::chooseALookAndALayout, &BesideTest::matchByHand,
              &BesideTest::actOnTheStudyInFocus, &BesideTest::cancelAnotherStudy,
              &BesideTest::closeThePrior}) {
            (this->*step)();
            if (QTest::currentTestFailed())
                return;
        }
    }

private:
    void openAPrior() {
        open(headPath());
        import(m_folder / "three", false);
        const scene::Camera camera = now().scene().camera;
        choose(volumeRow("Zhang Wei"), "openBesideAction");
        settleBeside();
        QVERIFY(find<QLabel>("studyHeading")->isVisible());
        QVERIFY(find<QLabel>("besideName")->text().contains("Zhang Wei"));
        QCOMPARE(now().scene().camera.orientation, camera.orientation); // the open one led
        QCOMPARE(now().scene().camera.panMm, camera.panMm);
    }

    // Either projection turns the other.
    void turnTheProjections() {
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(), {60, 20});
        QVERIFY(prior().scene().camera.orientation == now().scene().camera.orientation);
        dragMouse(other(), Qt::LeftButton, other()->rect().center(), {-90, 0});
        QVERIFY(prior().scene().camera.orientation == now().scene().camera.orientation);
        QVERIFY(std::abs(prior().scene().camera.pixelMm - now().scene().camera.pixelMm) < 1e-9);
    }

    // The open study keeps its zoom, and the other one follows its scale.
    void resizeThePanes() {
        turnWheel(projection(), 1);
        const ui::Pose pose = now().pose();
        const ChangeCount moved(now(), ui::Change::pose);
        for (const int wider : {160, -160}) {
            const int width = now().scene().camera.width;
            mainWindow().resize(mainWindow().width() + wider, mainWindow().height());
            QTRY_VERIFY(now().scene().camera.width != width);
            QTRY_VERIFY(std::abs(prior().scene().camera.pixelMm - now().scene().camera.pixelMm) <
                        1e-9);
            requirePlanesAlike();
        }
        QVERIFY(now().pose() == pose);
        QCOMPARE(moved.count(), 0);
    }

    // Each turns about its own crosshair, and both are at the same place of the pictures.
    void turnAboutTheCrosshairs() {
        find<QAction>("orbitCrosshairAction")->trigger();
        auto *axial = find<QWidget>("axialView");
        const QPoint to = axial->rect().center() + QPoint(40, 50);
        QMouseEvent move(QEvent::MouseMove, to, axial->mapToGlobal(to), Qt::NoButton, {},
                         Qt::ShiftModifier);
        QCoreApplication::sendEvent(axial, &move);
        for (QWidget *turned : {projection(), other()}) {
            dragMouse(turned, Qt::LeftButton, turned->rect().center(), {50, -30});
            const auto onPicture = [](ui::Document &document) {
                const scene::Camera &view = document.scene().camera;
                const glm::dvec3 at =
                    document.crosshair().mm - document.volume()->lattice().center().mm;
                return glm::dvec2(glm::dot(view.axes()[0], at), glm::dot(view.axes()[1], at)) -
                       view.panMm;
            };
            QVERIFY(glm::length(onPicture(now())) > 10.0);
            QVERIFY(glm::distance(onPicture(now()), onPicture(prior())) < 1e-6);
        }
        find<QAction>("orbitCrosshairAction")->trigger();
    }

    // Windowing either study is one step to undo.
    void movePlanesAndWindows() {
        const glm::dvec3 before = apart();
        turnWheel(find<QWidget>("axialView"), 2);
        QVERIFY(glm::distance(apart(), before) < 1e-6);
        turnWheel(find<QWidget>("beside_axialView"), -1);
        QVERIFY(glm::distance(apart(), before) < 1e-6);
        find<ui::MprView>("axialView")->moveView({2.5, {12.0, -7.0}});
        requirePlanesAlike();
        find<ui::MprView>("beside_coronalView")->moveView({0.7, {}});
        requirePlanesAlike();
        QTest::keyClick(&mainWindow(), Qt::Key_S);
        QVERIFY(prior().cut() == now().cut());
        const auto window = now().displayWindow();
        dragMouse(find<QWidget>("beside_coronalView"), Qt::LeftButton, {60, 60}, {40, -20});
        QVERIFY(!(now().displayWindow() == window));
        QVERIFY(prior().displayWindow() == now().displayWindow());
        find<QAction>("undoAction")->trigger();
        QVERIFY(now().displayWindow() == window);
        QVERIFY(prior().displayWindow() == window);
    }

    void chooseALookAndALayout() {
        clickPreset(mainWindow(), "Bone");
        settle();
        QVERIFY(prior().scene().look == now().scene().look);
        settleBeside();
        save("beside");
        QTest::mouseDClick(find<QWidget>("beside_axialView"), Qt::LeftButton, {}, {50, 80});
        QVERIFY(find<QWidget>("axialView")->isVisible());
        QVERIFY(!projection()->isVisible());
        QTest::mouseDClick(find<QWidget>("axialView"), Qt::LeftButton, {}, {50, 80});
        QVERIFY(other()->isVisible());
    }

    // The studies are unlinked, moved and linked again.
    void matchByHand() {
        const glm::dvec3 before = apart();
        QTest::mouseClick(find<QToolButton>("linkButton"), Qt::LeftButton);
        QVERIFY(!find<QAction>("linkStudiesAction")->isChecked());
        // The keypad turns the projection that has the keyboard.
        const auto orientation = now().scene().camera.orientation;
        QTest::keyClick(other(), Qt::Key_7, Qt::KeypadModifier);
        QVERIFY(prior().scene().camera.orientation ==
                scene::viewOrientation(scene::StandardView::top));
        QVERIFY(now().scene().camera.orientation == orientation);
        turnWheel(find<QWidget>("beside_axialView"), 1);
        const glm::dvec3 matched = apart();
        QVERIFY(glm::distance(matched, before) > 0.5);
        find<QAction>("linkStudiesAction")->trigger();
        turnWheel(find<QWidget>("axialView"), 1);
        QVERIFY(glm::distance(apart(), matched) < 1e-6);
    }

    // Measures, display windows and the menus of the panes are those of the study in focus.
    void actOnTheStudyInFocus() {
        find<QAction>("linkStudiesAction")->trigger();
        auto *plane = find<ui::MprView>("beside_axialView");
        plane->setFocus();
        const auto window = now().displayWindow();
        QTest::keyClick(plane, Qt::Key_2);
        QVERIFY(!(prior().displayWindow() == window));
        QVERIFY(now().displayWindow() == window);
        QTest::keyClick(plane, Qt::Key_W, Qt::ShiftModifier);
        auto *dialog = find<ui::DisplayWindowDialog>("displayWindowDialog");
        QVERIFY(&dialog->document() == &prior());
        dialog->findChild<QDoubleSpinBox *>("windowWidthBox")->setValue(777.0);
        QCOMPARE(prior().displayWindow().width, 777.0);
        QVERIFY(now().displayWindow() == window);
        dialog->close();
        plane->setFocus();
        QTest::keyClick(plane, Qt::Key_M);
        dragMouse(plane, Qt::LeftButton, plane->rect().center(), {40, 0});
        QCOMPARE(prior().measured().size(), std::size_t(1));
        QVERIFY(now().measured().empty());
        QVERIFY(std::abs(*prior().measured()[0].result.lengthMm -
                         40.0 * plane->devicePixelRatioF() * plane->plane().pixelMm) < 1e-6);
        QTest::keyClick(plane, Qt::Key_W);
        find<QAction>("linkStudiesAction")->trigger();
    }

    // The former study comes back in the pose that the leader has now, and the leader stays as it
    // is.
    void cancelAnotherStudy() {
        QTRY_VERIFY(!beside()->jobs().isRunning());
        choose(volumeRow("Miller Ann"), "openBesideAction");
        QVERIFY(beside()->jobs().isRunning());
        ui::Pose pose = now().pose();
        pose.orientation = scene::viewOrientation(scene::StandardView::left);
        pose.panMm = {7.0, -3.0};
        now().setPose(pose);
        const glm::dvec3 crosshair = now().crosshair().mm;
        beside()->jobs().cancel();
        settleBeside();
        QTRY_COMPARE(prior().pose().orientation, pose.orientation);
        QVERIFY(find<QLabel>("besideName")->text().contains("Zhang Wei"));
        QVERIFY(now().pose() == pose);
        QVERIFY(now().crosshair().mm == crosshair);
    }

    void closeThePrior() {
        QTest::mouseClick(find<QToolButton>("closeBesideButton"), Qt::LeftButton);
        QTRY_VERIFY(mainWindow().findChild<ui::StudyBeside *>("studyBeside") == nullptr);
        QVERIFY(mainWindow().findChild<ui::DisplayWindowDialog *>() == nullptr);
        QVERIFY(
            find<QLabel>("studyHeading")->text().contains(QString::fromUtf8("·"))); // the banner
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(), {60, 20});
        settle();
    }

    // Head and chest have one scale, and the crosshair is at the same place in both.
    void requirePlanesAlike() {
        for (const char *name : {"axialView", "coronalView", "sagittalView"}) {
            auto *here = find<ui::MprView>(name);
            auto *there = find<ui::MprView>(qPrintable(QString("beside_%1").arg(name)));
            QVERIFY(std::abs(here->plane().pixelMm / there->plane().pixelMm - 1.0) < 1e-9);
            const QPointF a = here->mapping().positionOf(now().crosshair()) -
                              QRectF(here->rect()).center(),
                          b = there->mapping().positionOf(prior().crosshair()) -
                              QRectF(there->rect()).center();
            QVERIFY((a - b).manhattanLength() < 1.0);
        }
    }
    ui::StudyBeside *beside() { return find<ui::StudyBeside>("studyBeside"); }
    ui::ProjectionView *other() { return find<ui::ProjectionView>("beside_projectionView"); }
    ui::Document &now() { return mainWindow().document(); }
    ui::Document &prior() { return beside()->document(); }
    // The distance of the crosshairs. *Units*: mm.
    glm::dvec3 apart() { return prior().crosshair().mm - now().crosshair().mm; }
    void settleBeside() {
        QTRY_VERIFY_WITH_TIMEOUT(other()->showsWhatIsAskedFor() && !beside()->jobs().isRunning(),
                                 patienceMs);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::BesideTest>(argc, argv);
}

#include "beside_test.moc"
