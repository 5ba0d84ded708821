// SPDX-License-Identifier: GPL-3.0-or-later
// The planes: slabs, turning, cine and measurements.
#include "tests/ui/workstation.h"

#include <fstream>

#include <QDoubleSpinBox>
#include <QPushButton>
#include <QTableWidget>
#include <QToolButton>
#include <QTreeWidget>

#include "core/volume/statistics.h"
#include "ui/document/measurement_store.h"
#include "ui/document/reasons.h"
#include "ui/views/cine.h"
#include "ui/views/mpr_view.h"

namespace pellucid {

using namespace test;

class PlanesTest : public Workstation {
    Q_OBJECT
private slots:
    void init() {
        Workstation::init();
        open(headPath());
    }

    void aSlabIsSwitchedThickenedAndShown() {
        settle();
        QImage thin = grab("coronalView");
        const auto rests = [&] {
            const QImage former = std::exchange(thin, grab("coronalView"));
            return changed(former, thin) == 0.0;
        };
        QTRY_VERIFY(rests()); // the panes have taken their places
        key(Qt::Key_S);
        QCOMPARE(cut().options.slab, (mpr::Slab{10.0, mpr::SlabMode::mean}));
        QVERIFY(find<QToolButton>("slabButton")->isChecked());
        QVERIFY(changed(thin, grab("coronalView")) > 0.02);
        find<QAction>("maximumSlabAction")->trigger();
        const QImage maximum = grab("coronalView");
        find<QAction>("minimumSlabAction")->trigger();
        QVERIFY(meanGrey(maximum) > meanGrey(grab("coronalView")) + 5.0);
        key(Qt::Key_BracketRight);
        QCOMPARE(cut().options.slab.thicknessMm, 15.0);
        key(Qt::Key_BracketLeft);
        key(Qt::Key_BracketLeft);
        QCOMPARE(cut().options.slab.thicknessMm, 5.0);
        save("slab");
        key(Qt::Key_S);
        QCOMPARE(cut().options.slab.thicknessMm, 0.0);
        QCOMPARE(changed(thin, grab("coronalView")), 0.0);
        key(Qt::Key_S); // and back to what it was
        QCOMPARE(cut().options.slab, (mpr::Slab{5.0, mpr::SlabMode::minimum}));
    }

    void nearestInterpolationShowsTheSamples() {
        const QImage linear = grab("coronalView");
        find<QAction>("nearestPlanesAction")->trigger();
        QVERIFY(changed(linear, grab("coronalView")) > 0.005);
        find<QAction>("linearPlanesAction")->trigger();
        QCOMPARE(changed(linear, grab("coronalView")), 0.0);
    }

    void turningACrosshairTurnsTheOtherPlanes() {
        auto *axial = find<ui::MprView>("axialView");
        key(Qt::Key_C);
        const QImage before = grab("coronalView");
        // The dot on the line of the coronal plane, right of the crosshair, up by some 20 degrees.
        const QPoint at = crosshair(axial);
        const int reach = int(0.36 * std::min(axial->width(), axial->height()));
        dragMouse(axial, Qt::LeftButton, at + QPoint(reach, 0),
                  QPoint(int(reach * (std::cos(0.35) - 1.0)), -int(reach * std::sin(0.35))));
        const mpr::PlaneAxes axes = cut().axes;
        QCOMPARE(axes.of(mpr::Orientation::axial), mpr::standardAxes(mpr::Orientation::axial));
        // The patient's left moves to the front: the dot went up.
        const glm::dvec3 right = axes.of(mpr::Orientation::coronal).right;
        QVERIFY(std::abs(std::atan2(-right.y, right.x) - 0.35) < 0.02);
        QVERIFY(changed(before, grab("coronalView")) > 0.05);
        QCOMPARE(crosshair(axial), at); // turned about, not moved
        save("oblique");
        key(Qt::Key_C, Qt::ShiftModifier);
        QVERIFY(cut().axes.areStandard());
        QTRY_COMPARE_WITH_TIMEOUT(changed(before, grab("coronalView")), 0.0, patienceMs);
    }

    void aDistanceIsDrawnListedUndoneAndRestored() {
        auto *axial = find<ui::MprView>("axialView");
        key(Qt::Key_M);
        const QPoint from(60, 80), by(90, 40);
        dragMouse(axial, Qt::LeftButton, from, by);
        QCOMPARE(measured().size(), std::size_t(1));
        const double expected = std::hypot(90.0, 40.0) / axial->mapping().pixelsPerMm();
        QVERIFY(std::abs(*measured()[0].result.lengthMm - expected) < 1e-6 * expected);
        auto *list = find<QTreeWidget>("measurementList");
        QCOMPARE(list->topLevelItem(0)->text(0), QString("Distance 1"));
        QCOMPARE(list->topLevelItem(0)->text(1), QString("%1 mm").arg(expected, 0, 'f', 1));
        key(Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(measured().empty());
        key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        QCOMPARE(measured().size(), std::size_t(1));
        // An end point follows the drag, and one undo restores it. A click alone draws nothing.
        dragMouse(axial, Qt::LeftButton, from + by, QPoint(20, 10));
        QVERIFY(*measured()[0].result.lengthMm > expected + 1.0);
        QCOMPARE(measured().size(), std::size_t(1));
        key(Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(std::abs(*measured()[0].result.lengthMm - expected) < 1e-6 * expected);
        QTest::mouseClick(axial, Qt::LeftButton, {}, QPoint(200, 200));
        QCOMPARE(measured().size(), std::size_t(1));
        list->topLevelItem(0)->setText(0, "Skull");
        QCOMPARE(measured()[0].measurement.name, std::string("Skull"));

        restart();
        open(headPath());
        QCOMPARE(measured().size(), std::size_t(1));
        QCOMPARE(measured()[0].measurement.name, std::string("Skull"));
        QVERIFY(std::abs(*measured()[0].result.lengthMm - expected) < 1e-6 * expected);
        // The name of the file does not contain the patient's.
        for (const auto &entry :
             std::filesystem::directory_iterator(m_folder / "data" / "pellucid" / "measurements"))
            QVERIFY(entry.path().string().find("Secret") == std::string::npos);
    }

    void anAngleTakesADragAndAClick() {
        auto *sagittal = find<ui::MprView>("sagittalView");
        key(Qt::Key_A);
        dragMouse(sagittal, Qt::LeftButton, QPoint(60, 60), QPoint(0, 80));
        QVERIFY(measured().empty());
        QTest::mouseClick(sagittal, Qt::LeftButton, {}, QPoint(140, 140));
        QCOMPARE(measured().size(), std::size_t(1));
        QVERIFY(std::abs(*measured()[0].result.angleDegrees - 90.0) < 1e-6);
        // Esc drops an unfinished angle.
        dragMouse(sagittal, Qt::LeftButton, QPoint(160, 160), QPoint(0, 60));
        QTest::keyClick(sagittal, Qt::Key_Escape);
        QTest::mouseClick(sagittal, Qt::LeftButton, {}, QPoint(30, 200));
        QCOMPARE(measured().size(), std::size_t(1));
    }

    void regionsReportTheirValuesAndAreMovedAndExported() {
        auto *axial = find<ui::MprView>("axialView");
        key(Qt::Key_E);
        const QPoint middle(axial->width() / 2 + 30, axial->height() / 2 + 20);
        dragMouse(axial, Qt::LeftButton, middle - QPoint(20, 15), QPoint(40, 30));
        key(Qt::Key_B);
        dragMouse(axial, Qt::LeftButton, middle + QPoint(-70, -60), QPoint(40, 30));
        QCOMPARE(measured().size(), std::size_t(2));
        const double pixels = axial->mapping().pixelsPerMm();
        QVERIFY(std::abs(*measured()[1].result.areaMm2 - 1200.0 / (pixels * pixels)) < 1e-6);
        QVERIFY(measured()[0].result.values->areSamples);
        QVERIFY(measured()[0].result.values->count > 20);
        save("measurements");
        // A drag of the outline moves the whole region, with any tool.
        key(Qt::Key_W);
        const double mean = measured()[0].result.values->mean;
        dragMouse(axial, Qt::LeftButton, middle + QPoint(20, 0), QPoint(60, 60));
        QVERIFY(std::abs(*measured()[0].result.areaMm2 -
                         std::acos(-1.0) * 20 * 15 / (pixels * pixels)) < 1e-6);
        QVERIFY(measured()[0].result.values->mean != mean);
        key(Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(measured()[0].result.values->mean, mean);

        const QString table = QString::fromStdString((m_folder / "table.csv").string());
        ui::MeasurementStore(document()).exportTable(table);
        QFile file(table);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QByteArray text = file.readAll();
        QCOMPARE(text.count("\r\n"), qsizetype(3));
        QVERIFY2(text.contains("\"Ellipse 1\",ellipse,") && text.contains(",HU,"), text);
        // It is not drawn on another slice.
        axial->scroll(3);
        find<QTreeWidget>("measurementList")->setFocus();
        const QImage without = grab("axialView");
        document().selectMeasurement(1);
        key(Qt::Key_Delete);
        QCOMPARE(measured().size(), std::size_t(1));
        QCOMPARE(measured()[0].measurement.name, std::string("Ellipse 1"));
        QCOMPARE(changed(without, grab("axialView")), 0.0);
    }

    void aDistanceOnTheProjectionBelongsToItsView() {
        key(Qt::Key_M);
        QWidget *view = projection();
        const auto camera = document().scene().camera;
        dragMouse(view, Qt::LeftButton, QPoint(200, 300), QPoint(120, 0));
        QCOMPARE(measured().size(), std::size_t(1));
        QCOMPARE(measured()[0].measurement.kind, measure::Kind::distance);
        QVERIFY(measured()[0].measurement.isProjected);
        QVERIFY(std::abs(*measured()[0].result.lengthMm - 120.0 * camera.pixelMm) < 1e-6);
        QVERIFY(document().scene().camera == camera); // nothing turned
        save("projected_distance");
        const QImage shown = grab("projectionView");
        projection()->showStandardView(scene::StandardView::left);
        settle();
        // A click on its row restores the view.
        auto *list = find<QTreeWidget>("measurementList");
        QTest::mouseClick(list->viewport(), Qt::LeftButton, {},
                          list->visualItemRect(list->topLevelItem(0)).center());
        settle();
        QVERIFY(changed(shown, grab("projectionView")) < 0.01);
    }

    void unreadableMeasurementsAreKeptAndReported() {
        auto *axial = find<ui::MprView>("axialView");
        key(Qt::Key_M);
        dragMouse(axial, Qt::LeftButton, QPoint(60, 80), QPoint(90, 40));
        const auto folder = m_folder / "data" / "pellucid" / "measurements";
        QTRY_VERIFY(std::filesystem::exists(folder)); // it is written when the drag has ended
        const auto path = std::filesystem::directory_iterator(folder)->path();
        std::ofstream(path) << "{\"schema\": \"pellucid-measurements/1\"";
        restart();
        open(headPath());
        QVERIFY(measured().empty());
        QVERIFY(std::filesystem::exists(path.string() + ".unreadable"));
        const auto &problems = document().problems();
        QVERIFY(std::any_of(problems.begin(), problems.end(), [](const dicom::Skipped &p) {
            return p.reason.is(task::because::measurementsCannotBeRead);
        }));
    }

    void windowsAreOnKeysAndTyped() {
        const auto window = [&] { return document().displayWindow(); };
        key(Qt::Key_1);
        QCOMPARE(window().name, std::string("Brain"));
        key(Qt::Key_6);
        QCOMPARE(window().name, std::string("Stroke"));
        QCOMPARE(window().width, 40.0);
        key(Qt::Key_0);
        QCOMPARE(window().name, std::string("Auto"));
        const auto q = volume::quantiles(*document().volume(), {0.005, 0.995});
        QCOMPARE(window().width, q[1] - q[0]);
        key(Qt::Key_9); // the file's own
        QCOMPARE(window().width, 100.0);
        QCOMPARE(window().center, 40.0);
        // All numbers that are typed in the dialog are one edit; Enter does not close it.
        key(Qt::Key_W, Qt::ShiftModifier);
        auto *width = find<QDoubleSpinBox>("windowWidthBox");
        QCOMPARE(width->value(), 100.0);
        QTest::keyClicks(width, "250");
        QTest::keyClick(width, Qt::Key_Return);
        QVERIFY(find<QDialog>("displayWindowDialog")->isVisible());
        QCOMPARE(window().width, 250.0);
        QCOMPARE(window().center, 40.0);
        auto *center = find<QDoubleSpinBox>("windowCenterBox");
        center->selectAll();
        QTest::keyClicks(center, "-30");
        QTest::keyClick(center, Qt::Key_Return);
        QCOMPARE(window().center, -30.0);
        key(Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(window().width, 100.0);
        QCOMPARE(window().center, 40.0);
    }

    void theListOfWindowsIsEditedAndKept() {
        key(Qt::Key_W, Qt::ShiftModifier);
        auto *table = find<QTableWidget>("windowPresetTable");
        const int count = table->rowCount();
        find<QDoubleSpinBox>("windowWidthBox")->setValue(777.0);
        find<QPushButton>("addWindowPresetButton")->click();
        QCOMPARE(table->rowCount(), count + 1);
        table->item(count, 0)->setText("Stent");
        table->item(count, 2)->setText("a lot"); // not a number: it stays as it was
        QCOMPARE(table->item(count, 2)->text(), QString("40"));
        for (int n = 0; n < count; ++n)
            find<QPushButton>("windowPresetUpButton")->click();
        QCOMPARE(table->item(0, 0)->text(), QString("Stent"));
        save("windows");
        find<QDialog>("displayWindowDialog")->close();
        key(Qt::Key_2); // Brain, which was the first
        QCOMPARE(document().displayWindow().name, std::string("Brain"));
        restart();
        open(headPath());
        key(Qt::Key_1);
        QCOMPARE(document().displayWindow().name, std::string("Stent"));
        QCOMPARE(document().displayWindow().width, 777.0);
        key(Qt::Key_W, Qt::ShiftModifier);
        find<QPushButton>("defaultWindowPresetsButton")->click();
        QCOMPARE(find<QTableWidget>("windowPresetTable")->rowCount(), count);
        key(Qt::Key_1);
        QCOMPARE(document().displayWindow().name, std::string("Brain"));
    }

    void thePlanesAreInvertedAndUndone() {
        const QImage before = grab("axialView");
        key(Qt::Key_N);
        QVERIFY(document().displayWindow().isInverted);
        QVERIFY(changed(before, grab("axialView")) > 0.1);
        key(Qt::Key_1); // another window is inverted, too
        QVERIFY(document().displayWindow().isInverted);
        key(Qt::Key_Z, Qt::ControlModifier);
        key(Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(changed(before, grab("axialView")), 0.0);
    }

    void theSliceHasItsNumber() {
        auto *axial = find<ui::MprView>("axialView");
        const auto corner = [&] { return grab("axialView").copy(axial->width() - 80, 18, 78, 22); };
        axial->scrollToEnd(false);
        const QImage first = corner();
        axial->scroll(1);
        QVERIFY(changed(first, corner()) > 0.0);
        axial->scroll(-1);
        QCOMPARE(changed(first, corner()), 0.0);
    }

    void cinePlaysTheFocusedPane() {
        auto *axial = find<ui::MprView>("axialView");
        axial->setFocus();
        const auto before = document().crosshair().mm;
        key(Qt::Key_Space);
        QTRY_VERIFY(document().crosshair().mm.z > before.z);
        QVERIFY(document().crosshair().mm.x == before.x);
        QVERIFY(find<QAction>("playAction")->isChecked());
        // After the last slice it continues with the first.
        axial->scrollToEnd(true);
        const double last = document().crosshair().mm.z;
        QTRY_VERIFY(document().crosshair().mm.z < last - 20.0);
        key(Qt::Key_Space);
        QVERIFY(!find<QAction>("playAction")->isChecked());
        projection()->setFocus();
        const auto orientation = document().scene().camera.orientation;
        key(Qt::Key_Space);
        QTRY_VERIFY(document().scene().camera.orientation != orientation);
        // The head stays upright.
        QVERIFY(std::abs(document().scene().camera.axes()[1].z - 1.0) < 1e-9);
        key(Qt::Key_Space);
        settle();
    }

private:
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
        QTest::keyClick(&mainWindow(), key, modifiers);
    }
    const ui::Cut &cut() { return document().cut(); }
    const std::vector<ui::Measured> &measured() { return document().measured(); }
    QPoint crosshair(const ui::MprView *view) {
        return view->mapping().positionOf(document().crosshair()).toPoint();
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::PlanesTest>(argc, argv);
}

#include "planes_test.moc"
