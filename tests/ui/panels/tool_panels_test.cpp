// SPDX-License-Identifier: GPL-3.0-or-later
// The bar of the region tools, measurements and problems, each alone.
#include "tests/ui/panels/bench.h"

#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QTreeWidget>

#include "core/decoding/client/reasons.h"
#include "core/files/reasons.h"
#include "ui/document/commands.h"
#include "ui/panels/measurements_panel.h"
#include "ui/panels/problem_list.h"
#include "ui/panels/region_bar.h"

namespace pellucid {

using namespace test;

class RegionBarTest : public PanelBench<ui::RegionBar> {
    Q_OBJECT
private slots:
    void init() { begin(); }

    void eachToolShowsItsOptions() {
        QVERIFY(!panel().isVisible());
        const struct {
            ui::RegionTool tool;
            const char *shown, *hidden;
        } cases[] = {{ui::RegionTool::connected, "regionLeakBox", "regionBallBox"},
                     {ui::RegionTool::paint, "regionBallBox", "regionUseBox"},
                     {ui::RegionTool::scissors, "regionSlabBox", "regionBallBox"}};
        for (const auto &c : cases) {
            document().marking().setTool(c.tool);
            QVERIFY(panel().isVisible());
            QVERIFY2(find<QWidget>(c.shown)->isVisible(), c.shown);
            QVERIFY2(!find<QWidget>(c.hidden)->isVisible(), c.hidden);
        }
        document().marking().setTool(ui::RegionTool::none);
        QVERIFY(!panel().isVisible());
    }
};

class MeasurementsPanelTest : public PanelBench<ui::MeasurementsPanel> {
    Q_OBJECT
private slots:
    void init() {
        begin();
        const measure::Measurement distance{
            measure::Kind::distance, "", {{0, 0, 0}, {30, 40, 0}}, {}};
        document().undoStack()->push(new ui::EditMeasurements(document(), {distance}, "Distance"));
    }

    void itListsNamesAndRemoves() {
        auto *const list = find<QTreeWidget>("measurementList");
        QCOMPARE(list->topLevelItemCount(), 1);
        QVERIFY2(list->topLevelItem(0)->text(1).contains("50"),
                 qPrintable(list->topLevelItem(0)->text(1)));
        list->topLevelItem(0)->setText(0, "Width");
        QCOMPARE(document().measurements()[0].name, std::string("Width"));
        document().selectMeasurement(0);
        panel().removeSelected();
        QVERIFY(document().measured().empty());
        undo();
        QCOMPARE(list->topLevelItemCount(), 1);
        undo();
        QVERIFY(document().measurements()[0].name.empty());
    }
};

class ProblemListTest : public PanelBench<ui::ProblemList> {
    Q_OBJECT
private slots:
    void init() { begin(); }

    // Many files with one reason share a row; clearing empties the list.
    void sameReasonsShareARow() {
        std::vector<dicom::Skipped> problems;
        for (int n = 0; n < 50; ++n)
            problems.push_back({"/a/" + std::to_string(n) + ".txt", task::because::isNotDicom});
        problems.push_back({"/a/b.dcm", task::because::hasNoPixels});
        document().addProblems(problems);
        auto *const list = find<QListWidget>("problemList");
        QCOMPARE(list->count(), 2);
        QVERIFY(list->item(0)->text().contains("50"));
        find<QPushButton>("clearProblemsButton")->click();
        QCOMPARE(list->count(), 0);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    using namespace pellucid;
    return test::runOnBench<RegionBarTest, MeasurementsPanelTest, ProblemListTest>(argc, argv);
}

#include "tool_panels_test.moc"
