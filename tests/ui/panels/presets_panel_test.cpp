// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/panels/bench.h"

#include <QAction>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>

#include "core/presets/preset_library.h"
#include "ui/panels/presets_panel.h"

namespace pellucid {

using namespace test;

class PresetsPanelTest : public PanelBench<ui::PresetsPanel> {
    Q_OBJECT
private slots:
    void init() { begin(); }

    void aClickShowsAPresetAsOneEdit() {
        clickPreset(panel(), "Bone over soft tissue");
        QCOMPARE(int(look().classes.size()), 2);
        QCOMPARE(edits(), 1);
        clickPreset(panel(), "Bone over soft tissue"); // it is shown already
        QCOMPARE(edits(), 1);
        undo();
        QVERIFY(look() == classify::Look());
        document().undoStack()->redo();
        QCOMPARE(gallery().currentItem()->text(), QString("Bone over soft tissue"));
    }

    void presetsAreThoseOfTheRegion() {
        QVERIFY(isListed("X-ray") && isListed("Head: bone") && isListed("Bone"));
        QVERIFY(!isListed("Chest: bone") && !isListed("Contrast vessels"));
        auto *const all = find<QPushButton>("allPresetsButton");
        all->click();
        QVERIFY(isListed("Chest: bone") && isListed("Contrast vessels"));
        all->click();
        QVERIFY(!isListed("Chest: bone"));
        document().closeVolume();
        openPhantom(document(), phantom::Kind::chest);
        QVERIFY(isListed("Chest: bone") && !isListed("Head: bone"));
    }

    void aSavedPresetIsFirstAndSelected() {
        clickPreset(panel(), "Bone");
        save("My bone, a name of two lines");
        QCOMPARE(gallery().item(0)->text(), QString("My bone, a name of two lines"));
        // It looks like the built-in one, but it is the one that was saved.
        QCOMPARE(gallery().currentRow(), 0);
        clickPreset(panel(), "Bone");
        QCOMPARE(gallery().currentItem()->text(), QString("Bone"));
    }

    void aPresetCannotTakeTheNameOfABuiltInOne() {
        panel().askForName();
        auto *name = find<QLineEdit>("lookNameEdit");
        name->setText("X-ray");
        QTest::keyClick(name, Qt::Key_Return);
        QVERIFY(find<QLabel>("presetMessage")->isVisible());
        QVERIFY(find<QLabel>("presetMessage")->text().contains("is built in"));
        QVERIFY(name->isVisible()); // the user can enter another name
        QTest::keyClick(name, Qt::Key_Escape);
        QVERIFY(!name->isVisible());
    }

    void deletingAPresetAsksAndIsUndone() {
        save("Mine");
        askToDelete(false);
        QVERIFY(isListed("Mine"));
        askToDelete(true);
        QVERIFY(!isListed("Mine"));
        QVERIFY(presets::PresetLibrary::ofUser().find("Mine") == nullptr);
        undo();
        QVERIFY(isListed("Mine"));
        QVERIFY(presets::PresetLibrary::ofUser().find("Mine") != nullptr);
        document().undoStack()->redo();
        QVERIFY(!isListed("Mine"));
    }

    void withoutAVolumeItSaysWhy() {
        document().closeVolume();
        QVERIFY(find<QLabel>("presetsEmpty")->isVisibleTo(&panel()));
        openPhantom(document());
        QVERIFY(!find<QLabel>("presetsEmpty")->isVisibleTo(&panel()));
    }

private:
    QListWidget &gallery() { return *find<QListWidget>("presetGallery"); }
    bool isListed(const QString &name) {
        return !gallery().findItems(name, Qt::MatchExactly).isEmpty();
    }
    void save(const QString &name) {
        panel().askForName();
        auto *edit = find<QLineEdit>("lookNameEdit");
        edit->selectAll();
        QTest::keyClicks(edit, name);
        QTest::keyClick(edit, Qt::Key_Return);
    }
    void askToDelete(bool deletes) {
        emit gallery().customContextMenuRequested(
            gallery().visualItemRect(gallery().item(0)).center());
        find<QAction>("removePresetAction")->trigger();
        find<QMenu>("presetMenu")->close();
        auto *question = find<QMessageBox>("removePresetQuestion");
        QVERIFY(question->isVisible());
        if (deletes)
            for (QAbstractButton *button : question->buttons())
                if (question->buttonRole(button) == QMessageBox::AcceptRole)
                    button->click();
        if (!deletes)
            QTest::keyClick(question, Qt::Key_Return); // the default keeps it
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::runOnBench<pellucid::PresetsPanelTest>(argc, argv);
}

#include "presets_panel_test.moc"
