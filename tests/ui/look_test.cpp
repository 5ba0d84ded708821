// SPDX-License-Identifier: GPL-3.0-or-later
// The panels of the look: quality, transfer function, classes, presets, cue and lights.
#include "tests/ui/workstation.h"

#include <filesystem>
#include <fstream>

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <QToolButton>

#include "ui/panels/curve_editor.h"
#include "ui/panels/depth_curve.h"
#include "ui/panels/light_sphere.h"

namespace pellucid {

using namespace test;

namespace {

// A plate below the head.
volume::Volume onCouch(const volume::Volume &head) {
    return head.visit([&](auto samples) {
        std::vector<std::int16_t> values(samples.begin(), samples.end());
        const volume::GridSize size = head.lattice().size();
        for (int k = 0; k < size.k; ++k)
            for (int j = size.j - 3; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i)
                    values[size.offsetOf(i, j, k)] = 400;
        return volume::Volume(head.lattice(), std::move(values), head.unit(), head.notes());
    });
}

} // namespace

class LookTest : public Workstation {
    Q_OBJECT
private slots:
    void qualityCanBeUndoneAndShowsItsCost() {
        open(headPath());
        const auto predicted = [&] {
            return find<QLabel>("predictedErrorLabel")->text().section(' ', -2, -2).toDouble();
        };
        const double standard = predicted();
        QVERIFY(standard > 0.0 && standard <= 0.11);
        const QString plan = find<QLabel>("planLabel")->text();
        QVERIFY(plan.startsWith("LS"));
        QVERIFY(find<QLabel>("frameTimeLabel")->text().endsWith("ms"));
        const QImage before = projection()->picture();

        auto *quality = find<QComboBox>("qualityBox");
        quality->setCurrentIndex(quality->findText("Fine"));
        emit quality->activated(quality->currentIndex());
        settle();
        QVERIFY(predicted() <= 0.01);
        QVERIFY(find<QLabel>("planLabel")->text() != plan);
        QCOMPARE(find<QLineEdit>("toleranceEdit")->text(), QString("0.01 %"));
        // A tenth of a percent is less than one of 256 grey levels.
        QVERIFY(changed(before, projection()->picture()) < 0.001);

        // A kernel that the user chose is used even if it misses the tolerance, which the panel
        // says.
        auto *kernel = find<QComboBox>("kernelBox");
        kernel->setCurrentIndex(kernel->findText("trilinear"));
        emit kernel->activated(kernel->currentIndex());
        settle();
        QVERIFY(find<QLabel>("planLabel")->text().startsWith("trilinear"));
        QVERIFY(predicted() > 1.0);
        QVERIFY(
            find<QLabel>("planReasonLabel")->text().startsWith("The error exceeds the tolerance"));
        save("quality_trilinear");

        auto *tolerance = find<QLineEdit>("toleranceEdit");
        tolerance->setText("not a number");
        QTest::keyClick(tolerance, Qt::Key_Return);
        QCOMPARE(tolerance->text(), QString("0.01 %")); // refused: the valid text is back
        QVERIFY(find<QLabel>("planReasonLabel")->text().contains("not a number"));

        // A cancelled preparation leaves the former plan; the same choice repeats it.
        kernel->setCurrentIndex(kernel->findText("nearest"));
        emit kernel->activated(kernel->currentIndex());
        jobs().cancel();
        QVERIFY(find<QLabel>("planLabel")->text().startsWith("trilinear"));
        emit kernel->activated(kernel->currentIndex());
        settle();
        QVERIFY(find<QLabel>("planLabel")->text().startsWith("nearest"));
        document().undoStack()->undo();
        document().undoStack()->undo();
        document().undoStack()->undo();
        QCOMPARE(document().scene().tolerance, scene::Scene().tolerance);
        QCOMPARE(quality->currentText(), QString("Standard"));
        settle();
        QCOMPARE(predicted(), standard);
    }

    void aChangedWeightIsShownUndoneSavedAndRestored() {
        open(headPath());
        auto *editor = find<ui::CurveEditor>("curveEditor");
        const QImage before = projection()->picture();
        // The segment under the mouse gets a frame, and its weight is shown.
        const QImage calm = editor->grab().toImage();
        const QPoint handle = editor->handleAt(1).toPoint();
        moveMouse(editor, handle);
        QTRY_VERIFY(changed(calm, editor->grab().toImage()) > 0.005);
        // Bone and the brain are dense: the second of six segments is skin and fat, the third
        // water.
        dragMouse(editor, Qt::LeftButton, editor->handleAt(2).toPoint(), {0, 200});
        const auto &weights = document().scene().look.transferFunction.weights;
        QCOMPARE(weights[2], 0.0);
        QCOMPARE(document().undoStack()->count(), 1); // one drag, one step
        settle();
        QVERIFY(changed(before, projection()->picture()) > 0.02);
        save("transfer_function");
        // A typed weight, and a double-click that resets it.
        auto *weight = find<QDoubleSpinBox>("weightBox");
        weight->setFocus();
        weight->selectAll();
        QTest::keyClicks(weight, "1.45");
        QTest::keyClick(weight, Qt::Key_Return);
        QCOMPARE(weights[2], 1.45);
        QTest::mouseDClick(editor, Qt::LeftButton, Qt::NoModifier, editor->handleAt(2).toPoint());
        QCOMPARE(weights[2], 1.0);
        find<QAction>("undoAction")->trigger();
        find<QAction>("undoAction")->trigger();
        QCOMPARE(weights[2], 0.0);
        // More points describe the same curve.
        find<QSpinBox>("pointsBox")->setValue(9);
        QCOMPARE(int(weights.size()), 9);
        settle();
        find<QAction>("undoAction")->trigger();
        QCOMPARE(int(weights.size()), 6);
        // Copied, reset and pasted.
        QTest::mouseClick(find<QPushButton>("copyCurveButton"), Qt::LeftButton);
        QTest::mouseClick(find<QPushButton>("resetCurveButton"), Qt::LeftButton);
        QVERIFY(document().scene().look == classify::Look());
        QTest::mouseClick(find<QPushButton>("pasteCurveButton"), Qt::LeftButton);
        QCOMPARE(weights[2], 0.0);
        // Two clicks keep the look.
        QTest::mouseClick(find<QPushButton>("saveLookButton"), Qt::LeftButton);
        QTest::mouseClick(find<QPushButton>("confirmLookButton"), Qt::LeftButton);
        auto *gallery = find<QListWidget>("presetGallery");
        QCOMPARE(int(gallery->findItems("Custom look 1", Qt::MatchExactly).size()), 1);
        while (document().undoStack()->canUndo())
            find<QAction>("undoAction")->trigger();
        settle();
        QVERIFY(changed(before, projection()->picture()) < 0.001);
        takeTheLookAgain(before);
    }

    void theRadiographPanelSetsTheContrast() {
        open(headPath());
        const auto automatic = document().exposure();
        QVERIFY(automatic.has_value());
        auto *const detail = find<QDoubleSpinBox>("detailValue");
        QVERIFY(std::abs(detail->value() - automatic->detail) < 0.006); // shown before it is chosen
        const QImage before = projection()->picture();
        detail->setValue(0.0);
        find<QDoubleSpinBox>("latitudeValue")->setValue(0.0);
        settle();
        QCOMPARE(document().exposure()->detail, 0.0);
        QCOMPARE(document().exposure()->latitude, 0.0);
        QVERIFY(changed(before, projection()->picture()) > 0.1);
        // Faster than frames, and with moves between them: the last value is shown.
        for (int n = 1; n <= 30; ++n) {
            detail->setValue(0.03 * n);
            QTest::keyClick(projection(), n % 2 == 0 ? Qt::Key_Left : Qt::Key_Right);
            QTest::qWait(n % 7);
        }
        settle();
        QCOMPARE(document().exposure()->detail, 0.9);
        find<QPushButton>("automaticContrastButton")->click();
        settle();
        QVERIFY(!document().scene().tone.detail && !document().scene().tone.latitude);
        QVERIFY(changed(before, projection()->picture()) < 0.001);
        // A linear filter is a part of the image itself.
        find<QDoubleSpinBox>("sharpnessValue")->setValue(1.5);
        settle();
        QCOMPARE(document().scene().image.detail, 1.5);
        QVERIFY(changed(before, projection()->picture()) > 0.02);
        while (document().undoStack()->canUndo())
            find<QAction>("undoAction")->trigger();
        settle();
        QVERIFY(document().scene().image == scene::ImageDefinition());
        QVERIFY(changed(before, projection()->picture()) < 0.001);
    }

    void oneCommandRemovesTheCouch() {
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{96, 96, 80}});
        dicom::writeCtSeries(m_folder / "couch",
                             onCouch(phantom::makePhantom(phantom::Kind::head, lattice)), {},
                             dicom::TransferSyntax::explicitLittle);
        open(QString::fromStdString((m_folder / "couch").string()));
        auto *const command = find<QAction>("removeCouchAction");
        auto *const box = find<QCheckBox>("withoutCouchBox");
        QVERIFY(command->isChecked() && box->isChecked()); // it opens that way
        QCOMPARE(document().undoStack()->count(), 0);
        const QImage without = projection()->picture();
        command->trigger();
        settle();
        QVERIFY(!command->isChecked() && !box->isChecked());
        QVERIFY(document().scene().look.classes.empty());
        QVERIFY(changed(projection()->picture(), without) > 0.02);
        QTest::mouseClick(box, Qt::LeftButton, {}, QPoint(8, box->height() / 2));
        settle();
        QVERIFY(command->isChecked());
        QVERIFY(changed(projection()->picture(), without) < 0.001);
        // Every preset stays without it.
        choosePreset("Bone in relief");
        QVERIFY(command->isChecked());
        // The head alone is what a scan without a couch shows.
        open(headPath());
        QVERIFY(!command->isChecked()); // there is none
        command->trigger();
        settle();
        QVERIFY(changed(without, projection()->picture()) < 0.01);
        command->trigger();
        settle();
        QVERIFY(!command->isChecked());
        QVERIFY(document().scene().look.classes.empty());
        // Classes of a preset show the couch, and again only the patient.
        choosePreset("Bone over soft tissue");
        const classify::Look look = document().scene().look;
        QVERIFY(command->isChecked());
        command->trigger();
        settle();
        for (const classify::TissueClass &tissue : document().scene().look.classes)
            QVERIFY(tissue.steps.empty());
        command->trigger();
        settle();
        QVERIFY(document().scene().look == look);
        document().undoStack()->undo();
        QVERIFY(!command->isChecked());
    }

    void presetsShowColoredClassesWhoseWeightsChangeThePicture() {
        open(headPath());
        auto *gallery = find<QListWidget>("presetGallery");
        // The gallery shows pictures of the open study, and no MR presets for CT.
        const auto item = [&](const char *name) {
            const auto items = gallery->findItems(name, Qt::MatchExactly);
            return items.isEmpty() ? nullptr : items.front();
        };
        QVERIFY(item("MR: brain") == nullptr);
        QTRY_VERIFY_WITH_TIMEOUT(meanGrey(item("Bone")->icon().pixmap(60, 52).toImage()) > 3.0,
                                 patienceMs);
        choosePreset("Bone over soft tissue");
        const QImage colored = projection()->picture();
        QVERIFY2(colorfulness(colored) > 2.0, "bone is ivory, soft tissue blue");
        QCOMPARE(int(document().scene().look.classes.size()), 2);

        // The weight of soft tissue by its slider: the picture follows, one drag is one step.
        auto *slider = find<QSlider>("classSlider1");
        const int count = document().undoStack()->count();
        dragSlider(slider, {40, 0});
        QVERIFY(document().scene().look.classes[1].weight > 0.8);
        QCOMPARE(document().undoStack()->count(), count + 1);
        settle();
        QVERIFY(changed(colored, projection()->picture()) > 0.02);
        save("classes");
        // The dot hides it and brings it back as it was.
        const double weight = document().scene().look.classes[1].weight;
        QTest::mouseClick(find<QToolButton>("classEye1"), Qt::LeftButton);
        QCOMPARE(document().scene().look.classes[1].weight, 0.0);
        settle();
        QVERIFY2(colorfulness(projection()->picture()) < colorfulness(colored), "bone alone");
        QTest::mouseClick(find<QToolButton>("classEye1"), Qt::LeftButton);
        QCOMPARE(document().scene().look.classes[1].weight, weight);

        // A range is edited with a tint on the planes.
        const QImage plane = grab("axialView");
        QTest::mouseDClick(find<QWidget>("classRow0"), Qt::LeftButton, Qt::NoModifier, {40, 8});
        auto *dialog = find<QDialog>("classDialog");
        find<QDoubleSpinBox>("classLowBox")->setValue(-100.0);
        QTRY_VERIFY(colorfulness(grab("axialView")) > colorfulness(plane) + 2.0);
        save("class_tint");
        dialog->accept();
        QTRY_VERIFY(colorfulness(grab("axialView")) < colorfulness(plane) + 1.0);
        QCOMPARE(document().scene().look.classes[0].low, -100.0);
        settle();
        while (document().undoStack()->canUndo())
            find<QAction>("undoAction")->trigger();
        QVERIFY(document().scene().look == classify::Look());
        settle();
        QVERIFY(colorfulness(projection()->picture()) < 0.01);
    }

    void aDepthCueFollowsADragAndIsUndone() {
        open(headPath());
        const QImage plain = projection()->picture();
        auto *kind = find<QComboBox>("cueBox");
        auto *slider = find<QSlider>("cueSlider");
        QVERIFY(!slider->isEnabled());
        const auto choose = [&](int index) {
            kind->setCurrentIndex(index);
            emit kind->activated(index);
            settle();
        };
        choose(1);
        QVERIFY(slider->isEnabled());
        QCOMPARE(shading().cue.kind, shading::CueKind::linear);
        const QImage linear = projection()->picture();
        QVERIFY(changed(plain, linear) > 0.05);
        // One drag is one step.
        const int count = document().undoStack()->count();
        dragSlider(slider, {-30, 0});
        QVERIFY(shading().cue.strength < 0.8);
        QCOMPARE(document().undoStack()->count(), count + 1);
        settle();
        QVERIFY(changed(linear, projection()->picture()) > 0.01);
        choose(2);
        QCOMPARE(shading().cue.kind, shading::CueKind::sine);
        // A curve has values to drag.
        auto *curve = find<ui::DepthCurve>("depthCurve");
        QVERIFY(!curve->isVisible());
        choose(3);
        QVERIFY(curve->isVisible());
        find<QDoubleSpinBox>("cueValue")->setValue(1.0);
        settle();
        QCOMPARE(shading().cue.curve, (std::vector<double>{0.0, 2.0, 0.0}));
        save("depth_curve");
        const QImage slab = projection()->picture();
        dragMouse(curve, Qt::LeftButton, curve->handleAt(2).toPoint(), {0, -40});
        QVERIFY(shading().cue.curve[2] > 1.5);
        settle();
        QVERIFY(changed(slab, projection()->picture()) > 0.01);
        find<QSpinBox>("curveValuesBox")->setValue(5);
        QCOMPARE(int(shading().cue.curve.size()), 5);
        settle();
        while (document().undoStack()->canUndo())
            find<QAction>("undoAction")->trigger();
        settle();
        QVERIFY(shading() == shading::Shading());
        QVERIFY(changed(plain, projection()->picture()) < 0.001);
        QVERIFY(!find<QAction>("depthCueAction")->isChecked());
        find<QAction>("depthCueAction")->trigger();
        QCOMPARE(shading().cue.kind, shading::CueKind::linear);
    }

    void lightsAreAddedDraggedColoredAndRemoved() {
        open(headPath());
        const QImage plain = projection()->picture();
        find<QAction>("addLightAction")->trigger();
        QCOMPARE(int(shading().lights.size()), 1);
        settle();
        const QImage lit = projection()->picture();
        QVERIFY(changed(plain, lit) > 0.05);
        save("light");
        dragALight();
        fixTheLightToThePatient();
        moveWeightsUnderLight();
        if (QTest::currentTestFailed())
            return;
        // Three colors make a colored picture. A saved look contains its lights.
        find<QPushButton>("addLightButton")->click();
        find<QPushButton>("addLightButton")->click();
        QCOMPARE(int(shading().lights.size()), 3);
        find<QPushButton>("removeLightButton")->click();
        QCOMPARE(int(shading().lights.size()), 2);
        settle();
        const shading::Shading kept = shading();
        QTest::mouseClick(find<QPushButton>("saveLookButton"), Qt::LeftButton);
        find<QLineEdit>("lookNameEdit")->setText("Lit by a test");
        QTest::keyClick(find<QLineEdit>("lookNameEdit"), Qt::Key_Return);
        find<QPushButton>("resetShadingButton")->click();
        QVERIFY(shading() == shading::Shading());
        settle();
        QVERIFY(changed(plain, projection()->picture()) < 0.001);
        choosePreset("Lit by a test");
        QVERIFY(shading() == kept);
        choosePreset("Body in three lights");
        QCOMPARE(int(shading().lights.size()), 3);
        QVERIFY(colorfulness(projection()->picture()) > 2.0);
        save("three_lights");
    }

private:
    // The bright side follows the light over the sphere; one drag is one step.
    void dragALight() {
        auto *sphere = find<ui::LightSphere>("lightSphere");
        const int count = document().undoStack()->count();
        const QPoint from = sphere->handleAt(0).toPoint();
        dragMouse(sphere, Qt::LeftButton, from,
                  QPoint(sphere->width() / 2 + 30, sphere->height() / 2) - from);
        QCOMPARE(document().undoStack()->count(), count + 1);
        QVERIFY(shading().lights[0].direction.x > 0.7);
        QVERIFY(std::abs(shading().lights[0].direction.y) < 0.1);
        settle();
        const auto balance = [&] {
            const QImage picture = projection()->picture();
            const QSize half(picture.width() / 2, picture.height());
            return meanGrey(picture, {{half.width(), 0}, half}) - meanGrey(picture, {{}, half});
        };
        const double fromRight = balance();
        dragMouse(sphere, Qt::LeftButton, sphere->handleAt(0).toPoint(), {-60, 0});
        QVERIFY(shading().lights[0].direction.x < -0.7);
        settle();
        QVERIFY2(balance() < fromRight - 1.0, "the left is brighter in light from the left");
    }

    // A light that is fixed to the patient turns with the view.
    void fixTheLightToThePatient() {
        auto *sphere = find<ui::LightSphere>("lightSphere");
        QTest::mouseClick(find<QCheckBox>("followsViewerBox"), Qt::LeftButton);
        QCOMPARE(shading().lights[0].frame, shading::LightFrame::patient);
        const QPointF before = sphere->handleAt(0);
        projection()->showStandardView(scene::StandardView::back);
        QTRY_VERIFY((sphere->handleAt(0) - before).manhattanLength() > 30.0);
        QTest::mouseClick(find<QCheckBox>("followsViewerBox"), Qt::LeftButton);
        QCOMPARE(shading().lights[0].frame, shading::LightFrame::viewer);
        settle();
    }

    // A coarse picture follows the weights, then the full one arrives.
    void moveWeightsUnderLight() {
        const QImage beforeWeight = projection()->picture();
        for (int n = 0; n < 12; ++n)
            QTest::keyClick(find<ui::CurveEditor>("curveEditor"), Qt::Key_Up);
        settle();
        QVERIFY(changed(beforeWeight, projection()->picture()) > 0.0);
        for (int n = 1; n < 12; ++n)
            find<QAction>("undoAction")->trigger();
        find<QAction>("undoAction")->trigger();
        settle();
    }

    // After a restart the saved look is there and shows the same.
    void takeTheLookAgain(const QImage &before) {
        restart();
        open(headPath());
        auto *gallery = find<QListWidget>("presetGallery");
        const auto found = gallery->findItems("Custom look 1", Qt::MatchExactly);
        QCOMPARE(int(found.size()), 1);
        clickItem(*gallery, *found.front());
        QCOMPARE(document().scene().look.transferFunction.weights[2], 0.0);
        settle();
        QVERIFY(changed(before, projection()->picture()) > 0.02);
        find<QAction>("undoAction")->trigger();
        QVERIFY(document().scene().look == classify::Look());
    }

    const shading::Shading &shading() { return document().scene().shading; }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::LookTest>(argc, argv);
}

#include "look_test.moc"
