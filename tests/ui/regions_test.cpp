// SPDX-License-Identifier: GPL-3.0-or-later
// Regions marked by hand: connected with a click, painted, cut, combined; presets that ask for a
// point.
#include "tests/ui/workstation.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTimer>

#include "core/preprocess/class_region.h"
#include "core/preprocess/step_cache.h"
#include "ui/views/mpr_view.h"

namespace pellucid {

using namespace test;
using classify::RegionUse;
using classify::StepKind;

class RegionsTest : public Workstation {
    Q_OBJECT
private slots:
    void aClickFindsWhatIsConnectedWhileItIsDragged() {
        open(headPath());
        choose("connectedToolAction");
        auto *const plane = axial();
        const QPoint at = plane->rect().center();
        const QImage before = plane->grab().toImage();
        QTest::mousePress(plane, Qt::LeftButton, {}, at);
        found();
        const double narrow = marking().tint()->volumeMl;
        QVERIFY(narrow > 0.0);
        QVERIFY(changed(before, plane->grab().toImage()) > 0.001);
        moveMouse(plane, at - QPoint(0, 150), Qt::LeftButton);
        found();
        const double wide = marking().tint()->volumeMl;
        QVERIFY2(wide > 1.02 * narrow, "dragged up, more values belong to it");
        QVERIFY(document().scene().look.classes.empty()); // until the release
        save("region_preview");
        QTest::mouseRelease(plane, Qt::LeftButton, {}, at - QPoint(0, 150));
        settle();
        const auto &classes = document().scene().look.classes;
        QCOMPARE(classes.size(), std::size_t(2)); // the volume stays
        QCOMPARE(QString::fromStdString(classes[1].name), QString("Region"));
        QCOMPARE(document().selectedClass(), 1);
        found();
        QCOMPARE(marking().tint()->volumeMl, wide);
        QVERIFY(colorfulness(projection()->picture()) > 1.0);
        save("region_connected");

        // Removed from the volume, and back by undo.
        use(RegionUse::remove);
        find<QComboBox>("regionClassBox")->setCurrentIndex(1);
        emit find<QComboBox>("regionClassBox")->activated(1);
        const QImage whole = projection()->picture();
        QTest::mouseClick(plane, Qt::LeftButton, {}, at);
        settle();
        QCOMPARE(classes[0].steps.back().kind, StepKind::difference);
        QCOMPARE(classes[1].steps.back().kind, StepKind::difference);
        QVERIFY(changed(whole, projection()->picture()) > 0.01);
        document().undoStack()->undo();
        settle();
        QVERIFY(changed(whole, projection()->picture()) < 0.001);
        // Escape drops a region that is being chosen.
        QTest::mousePress(plane, Qt::LeftButton, {}, at);
        QTest::keyClick(plane, Qt::Key_Escape);
        QVERIFY(!marking().candidate());
        const int edits = document().undoStack()->index();
        QTest::mouseRelease(plane, Qt::LeftButton, {}, at);
        QCOMPARE(document().undoStack()->index(), edits);
    }

    void aBallPaintsAndErases() {
        open(headPath());
        choose("paintToolAction");
        auto *const plane = axial();
        const QPoint at = plane->rect().center();
        QCOMPARE(find<QDoubleSpinBox>("regionBallBox")->value(), 5.0);
        find<QDoubleSpinBox>("regionBallBox")->selectAll();
        QTest::keyClicks(find<QDoubleSpinBox>("regionBallBox"), "12.5");
        QCOMPARE(find<QDoubleSpinBox>("regionBallBox")->value(), 12.5);
        find<QDoubleSpinBox>("regionBallBox")->setValue(12.0);
        dragMouse(plane, Qt::LeftButton, at, {60, 0});
        settle();
        const auto &classes = document().scene().look.classes;
        QCOMPARE(classes.size(), std::size_t(2));
        QVERIFY(classes[1].isDrawn);
        found();
        const double painted = marking().tint()->volumeMl;
        const double pixelMm = 1.0 / plane->mapping().pixelsPerMm();
        const double expected =
            (3.14159 * 144.0 * 60.0 * pixelMm + 4.0 / 3.0 * 3.14159 * 1728.0) / 1000.0;
        QVERIFY2(std::abs(painted - expected) < 0.06 * expected,
                 qPrintable(QString("%1 %2").arg(painted).arg(expected)));
        QCOMPARE(document().undoStack()->index(), 1);
        find<QCheckBox>("eraseBox")->setChecked(true);
        QTest::mouseClick(plane, Qt::LeftButton, {}, at);
        settle();
        found();
        QVERIFY(marking().tint()->volumeMl < 0.9 * painted);
        QCOMPARE(classes[1].steps.size(), std::size_t(1)); // strokes in a row are one step
        save("region_painted");
        document().undoStack()->undo();
        settle();
        found();
        QCOMPARE(marking().tint()->volumeMl, painted);

        // In the projection the ball is at the densest sample.
        find<QCheckBox>("eraseBox")->setChecked(false);
        QTest::mouseClick(projection(), Qt::LeftButton, {}, projection()->rect().center());
        settle();
        found();
        QVERIFY(marking().tint()->volumeMl > painted);
    }

    void scissorsCutAlongTheLineOfSight() {
        open(headPath());
        choose("scissorsToolAction");
        QCOMPARE(find<QComboBox>("regionUseBox")->currentText(), QString("Remove the region"));
        const QImage whole = projection()->picture();
        const QPoint middle = projection()->rect().center();
        drawAround(projection(), middle - QPoint(60, 0), 50);
        settle();
        const auto &classes = document().scene().look.classes;
        QCOMPARE(classes.size(), std::size_t(1));
        QCOMPARE(classes[0].steps.back().kind, StepKind::scissors);
        const QImage cut = projection()->picture();
        // Seen along the cut, nothing is left of what was inside, and the rest is untouched.
        const qreal ratio = projection()->devicePixelRatioF();
        const QPoint inside = ((middle - QPoint(60, 0)) * ratio);
        QVERIFY(qGray(whole.pixel(inside)) > 40);
        QVERIFY(qGray(cut.pixel(inside)) < 8);
        save("region_scissors");
        // Only a slab about the crosshair: less is gone.
        document().undoStack()->undo();
        find<QDoubleSpinBox>("regionSlabBox")->setValue(20.0);
        drawAround(projection(), middle - QPoint(60, 0), 50);
        settle();
        QVERIFY(qGray(projection()->picture().pixel(inside)) > 20);
        document().undoStack()->undo();
        settle();
        QVERIFY(changed(whole, projection()->picture()) < 0.001);

        // Kept in one plane.
        use(RegionUse::keep);
        find<QDoubleSpinBox>("regionSlabBox")->setValue(0.0);
        drawAround(axial(), axial()->rect().center(), 40);
        settle();
        QVERIFY(document().scene().look.classes[0].steps.back().cuts.front().keeps);
        QVERIFY(changed(whole, projection()->picture()) > 0.02);
        // A click is no cut.
        const int edits = document().undoStack()->index();
        QTest::mouseClick(axial(), Qt::LeftButton, {}, axial()->rect().center());
        QCOMPARE(document().undoStack()->index(), edits);
    }

    void boneGoesWithACommandAndAClick() {
        open(headPath());
        const QImage whole = projection()->picture();
        find<QAction>("removeBoneAction")->trigger();
        QVERIFY(bar()->isVisible());
        QVERIFY(find<QCheckBox>("regionBoneBox")->isChecked());
        QTest::mouseClick(projection(), Qt::LeftButton, {}, projection()->rect().center());
        settle();
        const auto &classes = document().scene().look.classes;
        QCOMPARE(classes.size(), std::size_t(1));
        QCOMPARE(classes[0].steps.back().kind, StepKind::difference);
        QVERIFY(changed(whole, projection()->picture()) > 0.05);
        save("region_without_bone");
    }

    void stepsOfTheSelectedClassComeFromTheMenu() {
        open(headPath());
        QVERIFY(!find<QAction>("fillRegionAction")->isEnabled());
        choosePreset("Bone");
        QVERIFY(find<QAction>("fillRegionAction")->isEnabled());
        auto &classes = document().scene().look.classes;
        find<QAction>("fillRegionAction")->trigger();
        QCOMPARE(classes[0].steps.back().kind, StepKind::fill);
        find<QAction>("largestRegionAction")->trigger();
        QCOMPARE(classes[0].steps.back().kind, StepKind::largestComponent);
        QTimer::singleShot(0, [] {
            auto *const dialog = qobject_cast<QInputDialog *>(QApplication::activeModalWidget());
            QVERIFY(dialog != nullptr);
            dialog->setDoubleValue(3.5);
            dialog->accept();
        });
        find<QAction>("growRegionAction")->trigger();
        QCOMPARE(classes[0].steps.back().at("mm"), 3.5);
        settle();
    }

    void aPresetAsksForAPoint() {
        open(headPath());
        choose("connectedToolAction");
        use(RegionUse::newClass);
        QTest::mouseClick(axial(), Qt::LeftButton, {}, axial()->rect().center());
        settle();
        const classify::Look marked = document().scene().look;
        QTest::mouseClick(find<QPushButton>("saveLookButton"), Qt::LeftButton);
        find<QLineEdit>("lookNameEdit")->setText("Click me");
        QTest::keyClick(find<QLineEdit>("lookNameEdit"), Qt::Key_Return);
        QVERIFY(find<QLabel>("presetMessage")->text().contains("asks for new points"));
        choosePreset("X-ray");
        choose("windowToolAction");
        choosePreset("Click me");
        QVERIFY(find<QAction>("connectedToolAction")->isChecked());
        QVERIFY(bar()->isVisible());
        QVERIFY(marking().options().addsPoints);
        QVERIFY(find<QComboBox>("regionUseBox")->currentText() == "Add a point");
        QVERIFY(document().scene().look.classes[1].steps.front().points.empty());
        save("region_preset_asks");
        QTest::mouseClick(axial(), Qt::LeftButton, {}, axial()->rect().center());
        settle();
        QVERIFY(!marking().options().addsPoints);
        QVERIFY(document().scene().look.classes[1].steps == marked.classes[1].steps);
    }

private:
    ui::RegionMarking &marking() { return document().marking(); }
    QWidget *bar() { return find<QWidget>("regionBar"); }
    ui::MprView *axial() { return find<ui::MprView>("axialView"); }
    // The bar above the panes changes their size.
    void choose(const char *action) {
        find<QAction>(action)->trigger();
        settle();
    }
    QString artifact(const QString &name) {
        const QString folder = qEnvironmentVariable("PELLUCID_ARTIFACTS");
        return (folder.isEmpty() ? QString::fromStdString(m_folder.path().string()) : folder) +
               "/" + name;
    }
    void use(RegionUse wanted) {
        auto *const box = find<QComboBox>("regionUseBox");
        const int index = box->findData(int(wanted));
        box->setCurrentIndex(index);
        emit box->activated(index);
        QCOMPARE(ui::useOf(marking().options(), marking().tool()), wanted);
    }
    void found() {
        QTRY_VERIFY_WITH_TIMEOUT(!marking().isSearching() && marking().tint(), patienceMs);
    }
    void drawAround(QWidget *pane, const QPoint &middle, int radius) {
        const auto corner = [&](int n) {
            const double angle = n * 3.14159265 / 12.0;
            return middle + QPoint(int(radius * std::cos(angle)), int(radius * std::sin(angle)));
        };
        QTest::mousePress(pane, Qt::LeftButton, {}, corner(0));
        for (int n = 1; n < 24; ++n)
            moveMouse(pane, corner(n), Qt::LeftButton);
        QTest::mouseRelease(pane, Qt::LeftButton, {}, corner(23));
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::RegionsTest>(argc, argv);
}

#include "regions_test.moc"
