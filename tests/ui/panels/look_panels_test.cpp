// SPDX-License-Identifier: GPL-3.0-or-later
// Transfer function, shading, radiograph and quality, each alone.
#include "tests/ui/panels/bench.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>

#include "core/classify/couch.h"
#include "ui/panels/curve_editor.h"
#include "ui/panels/quality_panel.h"
#include "ui/panels/radiograph_panel.h"
#include "ui/panels/shading_panel.h"
#include "ui/panels/transfer_function_panel.h"

namespace pellucid {

using namespace test;

class TransferFunctionPanelTest : public PanelBench<ui::TransferFunctionPanel> {
    Q_OBJECT
private slots:
    void init() { begin(); }

    void aDragOfAPointIsOneEdit() {
        dragMouse(&editor(), Qt::LeftButton, editor().handleAt(2).toPoint(), {0, 40});
        QVERIFY(function().weights[2] < 1.0);
        QCOMPARE(edits(), 1);
        undo();
        QCOMPARE(function().weights[2], 1.0);
    }

    void theWheelZoomsTheRangeAsOneEdit() {
        for (int step = 0; step < 6; ++step)
            turnWheel(&editor(), 1);
        QVERIFY(!function().isWhole());
        QVERIFY(function().high - function().low < 0.3);
        undo();
        QVERIFY(function().isWhole());
    }

    // Fat and muscle: 160 HU for all points.
    void aRangeIsTyped() {
        auto *low = find<QDoubleSpinBox>("curveLowBox"),
             *high = find<QDoubleSpinBox>("curveHighBox");
        QCOMPARE(low->value(), -900.0);
        QCOMPARE(high->value(), 2000.0);
        type(low, "-100");
        type(high, "60");
        QVERIFY(std::abs(function().low - 800.0 / 2900.0) < 1e-12);
        QVERIFY(std::abs(function().high - 960.0 / 2900.0) < 1e-12);
        // A double-click on the axis shows all values again.
        QTest::mouseDClick(&editor(), Qt::LeftButton, {}, QPoint(100, editor().height() - 4));
        QVERIFY(function().isWhole());
    }

private:
    ui::CurveEditor &editor() { return *find<ui::CurveEditor>("curveEditor"); }
    const classify::TransferFunction &function() { return look().transferFunction; }
    static void type(QDoubleSpinBox *box, const QString &number) {
        box->selectAll();
        QTest::keyClicks(box, number);
        QTest::keyClick(box, Qt::Key_Return);
    }
};

class ShadingPanelTest : public PanelBench<ui::ShadingPanel> {
    Q_OBJECT
private slots:
    void init() { begin(); }

    void theCueFollowsItsSliderAsOneEdit() {
        panel().toggleCue();
        const double before = shading().cue.strength;
        QVERIFY(before > 0.0);
        dragSlider(find<QSlider>("cueSlider"), {-40, 0});
        QVERIFY(shading().cue.strength < before);
        QCOMPARE(edits(), 2);
        undo();
        QCOMPARE(shading().cue.strength, before);
    }

    void lightsAreAddedAndRemoved() {
        panel().addLight();
        panel().addLight();
        QCOMPARE(int(shading().lights.size()), 2);
        find<QPushButton>("removeLightButton")->click();
        QCOMPARE(int(shading().lights.size()), 1);
        find<QPushButton>("resetShadingButton")->click();
        QVERIFY(!shading().isLit());
    }

    void aLightStaysWithThePatientIfAsked() {
        panel().addLight();
        auto *const follows = find<QCheckBox>("followsViewerBox");
        QVERIFY(follows->isChecked());
        follows->click();
        ui::Pose turned = document().pose();
        turned.orientation = scene::viewOrientation(scene::StandardView::left);
        const auto before = shading();
        document().setPose(turned);
        QVERIFY(shading() == before); // only the sphere shows it elsewhere
    }

private:
    const shading::Shading &shading() { return document().scene().shading; }
};

class RadiographPanelTest : public PanelBench<ui::RadiographPanel> {
    Q_OBJECT
private slots:
    void init() { begin(); }

    // It shows what was measured of the picture before the user chooses.
    void theExposureIsShownUntilTheUserChooses() {
        scene::Exposure exposure;
        exposure.detail = 0.4;
        exposure.latitude = 0.2;
        document().setExposure(exposure);
        auto *const detail = find<QDoubleSpinBox>("detailValue");
        QCOMPARE(detail->value(), 0.4);
        QVERIFY(!document().scene().tone.detail);
        detail->setValue(0.0);
        QCOMPARE(*document().scene().tone.detail, 0.0);
        find<QPushButton>("automaticContrastButton")->click();
        QVERIFY(!document().scene().tone.detail && !document().scene().tone.latitude);
        undo();
        QCOMPARE(*document().scene().tone.detail, 0.0);
    }

    void sharpnessIsAPartOfTheImage() {
        find<QDoubleSpinBox>("sharpnessValue")->setValue(1.5);
        QCOMPARE(document().scene().image.detail, 1.5);
        undo();
        QVERIFY(document().scene().image == scene::ImageDefinition());
    }

    void theCouchIsLeftOut() {
        find<QCheckBox>("withoutCouchBox")->click();
        QVERIFY(classify::isWithoutCouch(look()));
        undo();
        QVERIFY(!classify::isWithoutCouch(look()));
    }
};

class QualityPanelTest : public PanelBench<ui::QualityPanel> {
    Q_OBJECT
private slots:
    void init() { begin(); }

    void aQualityIsATolerance() {
        auto *const quality = find<QComboBox>("qualityBox");
        QCOMPARE(quality->currentText(), QString("Standard"));
        quality->setCurrentIndex(quality->findText("Fine"));
        emit quality->activated(quality->currentIndex());
        QCOMPARE(find<QLineEdit>("toleranceEdit")->text(), QString("0.01 %"));
        QCOMPARE(document().scene().tolerance, 1e-4);
        undo();
        QCOMPARE(document().scene().tolerance, scene::Scene().tolerance);
        QCOMPARE(quality->currentText(), QString("Standard"));
    }

    void whatIsNoToleranceIsRefused() {
        auto *const tolerance = find<QLineEdit>("toleranceEdit");
        const QString before = tolerance->text();
        tolerance->setText("not a number");
        QTest::keyClick(tolerance, Qt::Key_Return);
        QCOMPARE(tolerance->text(), before);
        QVERIFY(find<QLabel>("planReasonLabel")->text().contains("not a number"));
        tolerance->setText("0,5");
        QTest::keyClick(tolerance, Qt::Key_Return);
        QCOMPARE(document().scene().tolerance, 0.005);
        QCOMPARE(find<QComboBox>("qualityBox")->currentText(), QString("Custom"));
    }

    void theSameChoiceIsRepeated() {
        QSignalSpy again(&panel(), &ui::QualityPanel::chosenAgain);
        auto *const kernel = find<QComboBox>("kernelBox");
        kernel->setCurrentIndex(kernel->findText("trilinear"));
        emit kernel->activated(kernel->currentIndex());
        QCOMPARE(again.size(), 0);
        emit kernel->activated(kernel->currentIndex());
        QCOMPARE(again.size(), 1);
        QCOMPARE(edits(), 1);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    using namespace pellucid;
    return test::runOnBench<TransferFunctionPanelTest, ShadingPanelTest, RadiographPanelTest,
                            QualityPanelTest>(argc, argv);
}

#include "look_panels_test.moc"
