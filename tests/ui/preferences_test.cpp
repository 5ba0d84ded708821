// SPDX-License-Identifier: GPL-3.0-or-later
// Preferences of the whole program: language, theme, shortcuts; and what a restart restores.
#include "tests/ui/workstation.h"

#include <QAccessible>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenuBar>
#include <QPushButton>
#include <QToolButton>
#include <QTreeWidget>
#include <QUndoView>

#include "ui/widgets/action_table.h"

namespace pellucid {

using namespace test;

class PreferencesTest : public Workstation {
    Q_OBJECT
private slots:
    void theLanguageChangesAtTheNextStart() {
        choose("languageBox", "zh_TW");
        QCOMPARE(mainWindow().menuBar()->actions().front()->text(), QString("&File"));
        restart();
        QCOMPARE(mainWindow().menuBar()->actions().front()->text(), QString::fromUtf8("檔案(&F)"));
        open(headPath());
        auto *const gallery = find<QListWidget>("presetGallery");
        clickItem(*gallery, *gallery->item(1)); // its name is Chinese
        settle();
        // No visible text is English. Words of three letters and more are names and units.
        const QStringList english = englishTexts();
        QVERIFY2(english.isEmpty(), qPrintable(english.join(" | ")));
        save("zh_TW");
        requireKeysInManual("manual_zh_TW.html");
        choose("languageBox", "en");
        restart();
        QCOMPARE(mainWindow().menuBar()->actions().front()->text(), QString("&File"));
    }

    void theToolBarShowsWhatIsChosen() {
        const auto *views = find<QToolButton>("viewsButton");
        QCOMPARE(views->toolButtonStyle(), Qt::ToolButtonIconOnly);
        choose("toolBarBox", int(ui::ToolBarStyle::words));
        QCOMPARE(views->toolButtonStyle(), Qt::ToolButtonTextOnly);
        choose("toolBarBox", int(ui::ToolBarStyle::icons));
        QCOMPARE(views->toolButtonStyle(), Qt::ToolButtonIconOnly);
    }

    void theThemeChangesAtRunTime() {
        open(headPath());
        choosePreset("Bone");
        const scene::Scene scene = document().scene();
        const int edits = document().undoStack()->count();
        const double dark = meanGrey(grab("studyPanel"));
        choose("themeBox", "light");
        QTRY_VERIFY(meanGrey(grab("studyPanel")) > dark + 100.0);
        settle();
        // Icons, which the button draws itself, follow too.
        QVERIFY(meanGrey(grab("toolBar")) > 120.0);
        // Pictures stay on black.
        const QImage pane = grab("axialView");
        QVERIFY(meanGrey(pane, QRect(4, pane.height() / 4, 10, 10)) < 3.0);
        save("light");
        QVERIFY(document().scene().look == scene.look);
        QCOMPARE(document().undoStack()->count(), edits);
        // It survives a restart.
        restart();
        QVERIFY(meanGrey(grab("studyPanel")) > dark + 100.0);
        choose("themeBox", "dark");
    }

    void shortcutsAreChangedTakenOverAndKept() {
        openPreferences();
        find<QLineEdit>("shortcutFilter")->setText("crop");
        auto *list = find<QTreeWidget>("shortcutList");
        QCOMPARE(list->topLevelItemCount(), 1);
        list->setCurrentItem(list->topLevelItem(0));
        auto *edit = find<QKeySequenceEdit>("shortcutEdit");
        QCOMPARE(edit->keySequence(), QKeySequence("K"));
        // The key of another action: the dialog names that action, which loses the key.
        edit->setKeySequence(QKeySequence("W"));
        emit edit->editingFinished();
        QVERIFY(find<QLabel>("shortcutConflict")->text().contains("Window"));
        QVERIFY(find<QAction>("windowToolAction")->shortcut().isEmpty());
        find<QDialog>("preferencesDialog")->close();
        QVERIFY(activate(mainWindow()));
        QTest::keyClick(&mainWindow(), Qt::Key_W);
        QVERIFY(find<QAction>("cropToolAction")->isChecked());
        restart();
        QCOMPARE(find<QAction>("cropToolAction")->shortcut(), QKeySequence("W"));
        QVERIFY(find<QAction>("windowToolAction")->shortcut().isEmpty());
        openPreferences();
        find<QPushButton>("defaultKeysButton")->click();
        QCOMPARE(find<QAction>("windowToolAction")->shortcut(), QKeySequence("W"));
        QCOMPARE(find<QAction>("cropToolAction")->shortcut(), QKeySequence("K"));
        restart();
        QCOMPARE(find<QAction>("cropToolAction")->shortcut(), QKeySequence("K"));
    }

    void everyActionIsInTheShortcutListOnce() {
        QSet<QString> names;
        for (const auto *row : mainWindow().actions().listed()) {
            QVERIFY2(!names.contains(row->command.id), qPrintable(row->command.id));
            QVERIFY2(row->path.contains(" > "), qPrintable(row->command.id));
            QVERIFY2(!row->action->toolTip().isEmpty(), qPrintable(row->command.id));
            QVERIFY2(row->command.icon.isEmpty() != !row->action->icon().isNull(),
                     qPrintable(row->command.id));
            names << row->command.id;
        }
        for (const char *name : {"openFilesAction", "undoAction", "saveLookAction", "slabAction",
                                 "nextPhaseAction", "manualAction", "fullScreenAction"})
            QVERIFY2(names.contains(name), name);
        requireKeysInManual("manual.html");
        // No key is given twice.
        QHash<QString, QString> keys;
        for (const auto *row : mainWindow().actions().listed()) {
            const QString key = row->action->shortcut().toString(), name = row->command.id;
            if (key.isEmpty())
                continue;
            QVERIFY2(!keys.contains(key), qPrintable(key + ": " + name + ", " + keys[key]));
            keys[key] = name;
        }
    }

    void theLastStudyIsResumedWithItsView() {
        QVERIFY(!find<QWidget>("resumeButton")->isVisible());
        open(headPath());
        choosePreset("Bone");
        QTest::keyClick(projection(), Qt::Key_3, Qt::KeypadModifier);
        turnWheel(find<QWidget>("axialView"), 3);
        QTest::keyClick(&mainWindow(), Qt::Key_S);
        ui::Cut cut = document().cut();
        cut.axes = cut.axes.turned(mpr::Orientation::axial, 0.3);
        document().setCut(cut);
        settle();
        const scene::Scene scene = document().scene();
        const auto crosshair = document().crosshair();
        const QImage picture = projection()->picture();
        restart();
        QVERIFY(!document().volume());
        QVERIFY(find<QWidget>("resumeButton")->isVisible());
        find<QPushButton>("resumeButton")->click();
        settle();
        QVERIFY(document().scene().look == scene.look);
        QVERIFY(glm::distance(document().crosshair().mm, crosshair.mm) < 1e-6);
        QCOMPARE(document().cut().options.slab.thicknessMm, 10.0);
        QVERIFY(document().cut().axes == cut.axes);
        QVERIFY(std::abs(glm::dot(document().scene().camera.orientation,
                                  scene.camera.orientation)) > 1.0 - 1e-9);
        QVERIFY(changed(picture, projection()->picture()) < 0.01);
        // The file contains no name.
        QFile file(
            QString::fromStdString((m_folder / "data" / "pellucid" / "session.json").string()));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QVERIFY(!file.readAll().contains("Secret"));
    }

    void theHistoryGoesBackToAnyEdit() {
        open(headPath());
        const scene::Scene before = document().scene();
        choosePreset("Bone");
        find<QAction>("filmAction")->trigger();
        find<QDockWidget>("historyDock")->show();
        auto *history = find<QUndoView>("historyView");
        QCOMPARE(history->model()->rowCount(), 3); // with the state after opening
        QVERIFY(history->model()->index(1, 0).data().toString().contains("Bone"));
        const QRect row = history->visualRect(history->model()->index(0, 0));
        QTest::mouseClick(history->viewport(), Qt::LeftButton, {}, row.center());
        QVERIFY(document().scene().look == before.look);
        QVERIFY(!document().scene().tone.inverted);
        settle();
    }

    void theAboutDialogNamesTheLibraries() {
        find<QAction>("aboutAction")->trigger();
        QVERIFY(find<QLabel>("aboutWarning")->text().contains("Not for diagnostic use"));
        auto *libraries = find<QTreeWidget>("aboutLibraries");
        QStringList names;
        for (int n = 0; n < libraries->topLevelItemCount(); ++n) {
            const QTreeWidgetItem *item = libraries->topLevelItem(n);
            names << item->text(0);
            QVERIFY2(item->text(1).contains('.'), qPrintable(item->text(0)));
            QVERIFY2(!item->text(2).isEmpty(), qPrintable(item->text(0)));
        }
        for (const char *name : {"Qt", "DCMTK", "ITK", "FFTW", "libarchive"})
            QVERIFY2(names.contains(name), name);
        find<QDialog>("aboutDialog")->close();
    }

    // A screen reader says what each control is for.
    void everyControlThatTakesTheKeyboardHasAName() {
        open(headPath());
        choosePreset("Bone");
        QStringList nameless;
        for (QWidget *widget : mainWindow().findChildren<QWidget *>()) {
            // The edit line of a spin box has the name of the box.
            if (!widget->isVisible() || widget->objectName() == "qt_spinbox_lineedit" ||
                widget->focusPolicy() == Qt::NoFocus ||
                widget->inherits("QAbstractScrollArea") ==
                    (qobject_cast<QAbstractItemView *>(widget) == nullptr))
                continue;
            QAccessibleInterface *accessible = QAccessible::queryAccessibleInterface(widget);
            if (accessible == nullptr || accessible->text(QAccessible::Name).isEmpty())
                nameless << QString(widget->metaObject()->className()) + " " + widget->objectName();
        }
        QVERIFY2(nameless.isEmpty(), qPrintable(nameless.join(", ")));
    }

private:
    // The manual's table of keys is written by `./dev accept-pictures`.
    void requireKeysInManual(const char *page) {
        QString rows;
        for (const auto *row : mainWindow().actions().listed())
            if (!row->defaultKey.isEmpty())
                rows +=
                    QString("<tr><td>%1</td><td>%2</td></tr>\n")
                        .arg(row->path.toHtmlEscaped(),
                             row->defaultKey.toString(QKeySequence::NativeText).toHtmlEscaped());
        QFile file(QString(PELLUCID_SOURCE "/resources/manual/") + page);
        QVERIFY(file.open(QIODevice::ReadOnly));
        QString text = QString::fromUtf8(file.readAll());
        file.close();
        const QString begin = "<!-- keys -->\n", end = "<!-- end of keys -->";
        const auto from = text.indexOf(begin) + begin.size(), to = text.indexOf(end);
        if (qEnvironmentVariableIsSet("PELLUCID_ACCEPT_BASELINES")) {
            text.replace(from, to - from, rows);
            QVERIFY(file.open(QIODevice::WriteOnly));
            file.write(text.toUtf8());
            return;
        }
        QVERIFY2(text.mid(from, to - from) == rows,
                 "the keys of the manual are others: ./dev accept-pictures");
    }

    void choose(const char *box, const QVariant &value) {
        openPreferences();
        auto *choice = find<QComboBox>(box);
        const bool isOther = choice->currentData() != value;
        choice->setCurrentIndex(choice->findData(value));
        emit choice->activated(choice->currentIndex());
        if (choice->objectName() == "languageBox")
            QCOMPARE(find<QLabel>("languageNote")->isVisible(), isOther);
        find<QDialog>("preferencesDialog")->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QVERIFY(activate(mainWindow()));
    }

    QStringList englishTexts() {
        static const QRegularExpression word("[A-Za-z]{3,}");
        // Names, units and terms that are not translated.
        static const QRegularExpression proper(
            "Secret|Name|Cobb|SUV|DICOMDIR|DICOM|NRRD|NIfTI|MetaImage|Pellucid|MIP|MinIP|CPU|GPU|"
            "AVX\\d?|"
            "SSE\\d?|EMU\\d+|"
            "NEON|"
            "OpenGL|Esc|Ctrl|Shift|Keypad|Slicer|png|json|csv|PNG|CSV|NumPy|ZIP|FFTW|UID|Del|Home|"
            "End|"
            "test|tmp|pellucid");
        QStringList found;
        const auto look = [&](QString text, const QString &where) {
            if (text.contains('/')) // a path
                return;
            text.remove(proper);
            if (word.match(text).hasMatch())
                found << where + ": " + text;
        };
        for (const QAction *action : mainWindow().findChildren<QAction *>())
            // Edits keep the language in which they were made.
            if (!action->objectName().isEmpty() && action != find<QAction>("undoAction")) {
                look(action->text(), action->objectName());
                look(action->toolTip(), action->objectName());
            }
        for (const QWidget *widget : mainWindow().findChildren<QWidget *>()) {
            const QString where = widget->objectName();
            // Kernels and steps have the names that the command line takes.
            if (where == "kernelBox" || where == "classRange")
                continue;
            look(widget->toolTip(), where);
            look(widget->accessibleName(), where);
            if (const auto *label = qobject_cast<const QLabel *>(widget))
                look(label->text(), where);
            else if (const auto *button = qobject_cast<const QAbstractButton *>(widget))
                look(button->text(), where);
            else if (const auto *combo = qobject_cast<const QComboBox *>(widget))
                for (int n = 0; n < combo->count(); ++n)
                    look(combo->itemText(n), where);
            else if (const auto *list = qobject_cast<const QListWidget *>(widget))
                for (int n = 0; n < list->count(); ++n)
                    look(list->item(n)->text(), where);
        }
        return found;
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::PreferencesTest>(argc, argv);
}

#include "preferences_test.moc"
