// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/panels/bench.h"

#include <QAction>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSlider>
#include <QToolButton>

#include "core/presets/preset_library.h"
#include "ui/document/commands.h"
#include "ui/panels/classes_panel.h"

namespace pellucid {

using namespace test;
using classify::StepKind;

class ClassesPanelTest : public PanelBench<ui::ClassesPanel> {
    Q_OBJECT
private slots:
    void init() {
        begin();
        const auto library = presets::PresetLibrary::ofUser();
        ui::editLook(document(), "Preset", ui::noDrag, [&](classify::Look &look) {
            look = library.find("Bone over soft tissue")->preset.look;
        });
    }

    void theWeightFollowsTheSliderAsOneEdit() {
        const double before = look().classes[0].weight;
        const int count = edits();
        dragSlider(row(0)->findChild<QSlider *>(), {-20, 0});
        QVERIFY(look().classes[0].weight < before);
        QCOMPARE(edits(), count + 1);
        undo();
        QCOMPARE(look().classes[0].weight, before);
    }

    void theDotHidesAClassAndShowsItAgain() {
        auto *const dot = find<QToolButton>("classEye0");
        dot->click();
        QCOMPARE(int(classify::visibleClasses(look()).size()), 1);
        dot->click();
        QCOMPARE(int(classify::visibleClasses(look()).size()), 2);
    }

    void aClickSelectsAClass() {
        QTest::mouseClick(row(1), Qt::LeftButton, {}, QPoint(60, 8));
        QCOMPARE(document().selectedClass(), 1);
        QTest::mouseClick(row(0), Qt::LeftButton, {}, QPoint(60, 8));
        QCOMPARE(document().selectedClass(), 0);
    }

    void enterTakesANumberAndDoesNotCloseTheDialog() {
        QDialog *const dialog = openDialog(0);
        QVERIFY(dialog->isVisible());
        action(dialog, "step_grow")->trigger();
        auto *number = dialog->findChild<QDoubleSpinBox *>("stepNumber_mm");
        QVERIFY(number != nullptr);
        number->setFocus();
        number->selectAll();
        QTest::keyClicks(number, "4");
        QTest::keyClick(number, Qt::Key_Return);
        QVERIFY(dialog->isVisible());
        QCOMPARE(number->value(), 4.0);
        auto *name = dialog->findChild<QLineEdit *>("classNameEdit");
        name->setFocus();
        QTest::keyClick(name, Qt::Key_Return);
        QVERIFY(dialog->isVisible());
        dialog->findChild<QDialogButtonBox *>()->button(QDialogButtonBox::Ok)->click();
        const auto &steps = look().classes[0].steps;
        QVERIFY(!steps.empty() && steps.back().kind == StepKind::grow);
        QCOMPARE(steps.back().at("mm"), 4.0);
    }

    void theDialogShowsAClassAsAGraph() {
        QDialog *dialog = openDialog(1);
        auto *const list = dialog->findChild<QListWidget *>("classSteps");
        const int before = list->count();
        // Without the other class of the look.
        auto *const others = dialog->findChild<QMenu *>("step_without");
        QCOMPARE(others->actions().size(), 1);
        others->actions().front()->trigger();
        QCOMPARE(list->count(), before + 1);
        QCOMPARE(list->item(before)->text(), QString("without Bone"));
        action(dialog, "step_grow")->trigger();
        QCOMPARE(list->item(before + 1)->text(), QString("grown by 2 mm"));
        dialog->findChild<QDoubleSpinBox *>("stepNumber_mm")->setValue(1.5);
        QCOMPARE(list->item(before + 1)->text(), QString("grown by 1.5 mm"));
        // A step that changes values comes before those that find the region.
        action(dialog, "step_gaussian")->trigger();
        QCOMPARE(list->currentRow(), 0);
        QVERIFY(!dialog->findChild<QPushButton *>("stepDownButton")->isEnabled());
        dialog->findChild<QDoubleSpinBox *>("classEdgeBox")->setValue(0.75);
        dialog->accept();
        const auto operand = [&] {
            const auto &steps = look().classes[1].steps;
            return QString::fromStdString(steps[steps.size() - 2].operand.name);
        };
        QCOMPARE(look().classes[1].edge, 0.75);
        QCOMPARE(look().classes[1].steps.front().kind, StepKind::gaussian);
        QCOMPARE(operand(), QString("Bone"));
        // A renamed class stays in the step; a class cannot use one that depends on it.
        dialog = openDialog(0);
        QVERIFY(!dialog->findChild<QMenu *>("step_without")->isEnabled());
        dialog->findChild<QLineEdit *>("classNameEdit")->setText("Hard");
        dialog->accept();
        QCOMPARE(operand(), QString("Hard"));
    }

private:
    QWidget *row(int index) { return find<QWidget>(QString("classRow%1").arg(index)); }
    QDialog *openDialog(int index) {
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete); // a former one
        QTest::mouseDClick(row(index), Qt::LeftButton, {}, QPoint(40, 8));
        return find<QDialog>("classDialog");
    }
    static QAction *action(QDialog *dialog, const char *name) {
        return dialog->findChild<QAction *>(name);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::runOnBench<pellucid::ClassesPanelTest>(argc, argv);
}

#include "classes_panel_test.moc"
