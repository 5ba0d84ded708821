// SPDX-License-Identifier: GPL-3.0-or-later
// What a person chooses for the whole program: language, theme, keys; and what is there again after
// the program has ended.
#include "tests/ui/workstation.h"

#include <array>

#include <QAccessible>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QFileDialog>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenuBar>
#include <QPointer>
#include <QPushButton>
#include <QScopeGuard>
#include <QToolButton>
#include <QTreeWidget>
#include <QUndoView>

#include "ui/opening/recent_paths.h"
#include "ui/settings/shortcuts.h"
#include "ui/window/workstation.h"

namespace pellucid {

using namespace test;

class PreferencesTest : public Workstation {
    Q_OBJECT
private slots:
    void init() {
        QSettings().clear();
        std::filesystem::remove_all(m_folder / "data");
        begin();
    }
    void cleanup() { m_program.reset(); }

    void theLanguageChangesAtRunTimeAndNothingIsLost() {
        openIn(headPath());
        choosePreset("Bone");
        dragMouse(find<QWidget>("axialView"), Qt::LeftButton, {150, 150}, {60, -30});
        const auto window = document().displayWindow();
        const scene::Scene scene = document().scene();
        const int edits = document().undoStack()->count();
        QVERIFY(edits >= 2);
        // From here its brightness would be another.
        QTest::keyClick(projectionOf(), Qt::Key_3, Qt::KeypadModifier);
        settleIn();
        const auto brightness = document().brightness();
        const QImage picture = projectionOf()->picture();
        choose("languageBox", "zh_TW");
        QTRY_COMPARE(window_().menuBar()->actions().front()->text(), QString::fromUtf8("檔案(&F)"));
        settleIn();
        QVERIFY(document().displayWindow() == window);
        QVERIFY(document().scene().look == scene.look);
        // Menus of another script may be a little higher: the pane is smaller then.
        const QImage now = projectionOf()->picture().scaled(picture.size());
        QVERIFY(changed(picture, now) < 0.05);
        QVERIFY(brightness && document().brightness() == brightness);
        QVERIFY(document().undoStack()->count() == edits);
        // Nothing that is seen is English: words of three letters and more are names and units.
        const QStringList english = englishTexts();
        QVERIFY2(english.isEmpty(), qPrintable(english.join(" | ")));
        grabAs("zh_TW");
        // Keys and undo go on as before.
        QTest::keyClick(&window_(), Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(!(document().displayWindow() == window));
        choose("languageBox", "en");
        QTRY_COMPARE(window_().menuBar()->actions().front()->text(), QString("&File"));
        settleIn();
    }

    void theThemeChangesAtRunTime() {
        openIn(headPath());
        const double dark = meanGrey(find<QWidget>("studyPanel")->grab().toImage());
        choose("themeBox", "light");
        QTRY_VERIFY(meanGrey(find<QWidget>("studyPanel")->grab().toImage()) > dark + 100.0);
        settleIn();
        // Pictures stay on black.
        const QImage pane = find<QWidget>("axialView")->grab().toImage();
        QVERIFY(meanGrey(pane, QRect(4, pane.height() / 4, 10, 10)) < 3.0);
        grabAs("light");
        // It is there after the program has ended.
        begin();
        QVERIFY(meanGrey(find<QWidget>("studyPanel")->grab().toImage()) > dark + 100.0);
        choose("themeBox", "dark");
    }

    void keysAreGivenTakenAndKept() {
        openDialog();
        find<QLineEdit>("shortcutFilter")->setText("crop");
        auto *list = find<QTreeWidget>("shortcutList");
        QCOMPARE(list->topLevelItemCount(), 1);
        list->setCurrentItem(list->topLevelItem(0));
        auto *edit = find<QKeySequenceEdit>("shortcutEdit");
        QCOMPARE(edit->keySequence(), QKeySequence("K"));
        // The key of another command: that one is named and has none then.
        edit->setKeySequence(QKeySequence("W"));
        emit edit->editingFinished();
        QVERIFY(find<QLabel>("shortcutConflict")->text().contains("Window"));
        QVERIFY(find<QAction>("windowToolAction")->shortcut().isEmpty());
        find<QDialog>("preferencesDialog")->close();
        QVERIFY(test::activate(window_()));
        QTest::keyClick(&window_(), Qt::Key_W);
        QVERIFY(find<QAction>("cropToolAction")->isChecked());
        begin();
        QCOMPARE(find<QAction>("cropToolAction")->shortcut(), QKeySequence("W"));
        QVERIFY(find<QAction>("windowToolAction")->shortcut().isEmpty());
        openDialog();
        find<QPushButton>("usualKeysButton")->click();
        QCOMPARE(find<QAction>("windowToolAction")->shortcut(), QKeySequence("W"));
        QCOMPARE(find<QAction>("cropToolAction")->shortcut(), QKeySequence("K"));
        begin();
        QCOMPARE(find<QAction>("cropToolAction")->shortcut(), QKeySequence("K"));
    }

    void everyCommandIsInTheListOnce() {
        QSet<QString> names;
        for (const ui::ShortcutEntry &entry : ui::shortcutEntries(window_())) {
            QVERIFY2(!names.contains(entry.name), qPrintable(entry.name));
            names << entry.name;
        }
        for (const char *name : {"openFilesAction", "undoAction", "saveLookAction", "slabAction",
                                 "nextPhaseAction", "manualAction", "fullScreenAction"})
            QVERIFY2(names.contains(name), name);
        // No key is given twice.
        QHash<QString, QString> keys;
        for (const ui::ShortcutEntry &entry : ui::shortcutEntries(window_())) {
            const QString key = entry.action->shortcut().toString();
            if (key.isEmpty())
                continue;
            QVERIFY2(!keys.contains(key), qPrintable(key + ": " + entry.name + ", " + keys[key]));
            keys[key] = entry.name;
        }
    }

    void whatWasOpenIsTakenUpAgainAsItWasLookedAt() {
        QVERIFY(!find<QWidget>("resumeButton")->isVisible());
        openIn(headPath());
        choosePreset("Bone");
        QTest::keyClick(projectionOf(), Qt::Key_3, Qt::KeypadModifier);
        turnWheel(find<QWidget>("axialView"), 3);
        QTest::keyClick(&window_(), Qt::Key_S);
        ui::Cut cut = document().cut();
        cut.axes = cut.axes.turned(mpr::Orientation::axial, 0.3);
        document().setCut(cut);
        settleIn();
        const scene::Scene scene = document().scene();
        const auto crosshair = document().crosshair();
        const QImage picture = projectionOf()->picture();
        begin();
        QVERIFY(!document().volume());
        QVERIFY(find<QWidget>("resumeButton")->isVisible());
        find<QPushButton>("resumeButton")->click();
        QTRY_VERIFY_WITH_TIMEOUT(document().volume() && !document().isPreview(), patienceMs);
        settleIn();
        QVERIFY(document().scene().look == scene.look);
        QVERIFY(glm::distance(document().crosshair().mm, crosshair.mm) < 1e-6);
        QCOMPARE(document().cut().options.slab.thicknessMm, 10.0);
        QVERIFY(document().cut().axes == cut.axes);
        QVERIFY(std::abs(glm::dot(document().scene().camera.orientation,
                                  scene.camera.orientation)) > 1.0 - 1e-9);
        QVERIFY(changed(picture, projectionOf()->picture()) < 0.01);
        // No name in the file.
        QFile file(
            QString::fromStdString((m_folder / "data" / "pellucid" / "session.json").string()));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QVERIFY(!file.readAll().contains("Secret"));
    }

    void whoDoesNotWantToBeRememberedIsNot() {
        openIn(headPath());
        QVERIFY(!QSettings().value("recentPaths").toStringList().isEmpty());
        openDialog();
        find<QCheckBox>("remembersBox")->click();
        find<QDialog>("preferencesDialog")->close();
        QVERIFY(QSettings().value("recentPaths").toStringList().isEmpty());
        openIn(headPath());
        begin();
        QVERIFY(!find<QWidget>("resumeButton")->isVisible());
        QVERIFY(QSettings().value("recentPaths").toStringList().isEmpty());
        QVERIFY(!std::filesystem::exists(m_folder / "data" / "pellucid" / "session.json"));
    }

    void aPathThatNamesThePatientIsNotAmongTheRecentOnes() {
        ui::StudyFacts study;
        study.patientName = QString::fromUtf8("M\u00FCller^J\u00F6rg=\u738B^\u5C0F");
        study.patientId = "A-4711";
        study.birthDate = "19500607";
        study.uid = "1.2";
        for (const char *of :
             {"/cd/MULLER_J", "/cd/MullerJorg", "/cd/x jorg", "/cd/a-4711/1", "/cd/A_4711_2",
              "/cd/1950-06-07", "/cd/07.06.1950", "/cd/CT19500607", "/cd/\u738B\u5C0F\u5148\u751F"})
            QVERIFY2(ui::namesPatient(QString::fromUtf8(of), study), of);
        for (const char *of : {"/cd/head", "/home/jo/4711", "/cd/1950", "/cd/fjorgen/j", "",
                               "/cd/\u738B\u5148\u751F"})
            QVERIFY2(!ui::namesPatient(QString::fromUtf8(of), study), of);
        QVERIFY(!ui::namesPatient("/cd", {}));
        study.patientName = QString::fromUtf8(
            "Xu^Ann=\uC774^\uC601"); // of Hangul, each letter three in Unicode's D
        QVERIFY(ui::namesPatient("/cd/xu-li", study));
        QVERIFY(ui::namesPatient(QString::fromUtf8("/cd/\uC774\uC601"), study));
        QVERIFY(!ui::namesPatient("/cd/anna", study));
        study.patientId = "001";
        QVERIFY(ui::namesPatient("/cd/001/a", study));
        QVERIFY(!ui::namesPatient("/cd/IM0001", study));
        study.patientName = "Home";
        QVERIFY(!ui::namesPatient(QDir::homePath() + "/scans", study));
        const ui::StudySource phantom = ui::phantomSource("head");
        QVERIFY(!ui::namesPatient("/phantoms", phantom.study));

        const auto named = m_folder / "of_SECRET";
        std::filesystem::copy(headPath().toStdString(), named);
        const auto isKept = [] {
            return !QSettings().value("recentPaths").toStringList().filter("SECRET").isEmpty();
        };
        openIn(QString::fromStdString(named.string()));
        QVERIFY(!isKept());
        openDialog();
        find<QCheckBox>("patientTitleBox")->click();
        find<QDialog>("preferencesDialog")->close();
        openIn(QString::fromStdString(named.string()));
        QVERIFY(isKept());
        openDialog();
        find<QCheckBox>("patientTitleBox")->click(); // chosen no more
        QVERIFY(!isKept());
    }

    // Qt's dialogs write down where they have been.
    void fileDialogsLeaveNoTrace() {
        const auto named = m_folder / "dialog_of_SECRET";
        std::filesystem::copy(headPath().toStdString(), named);
        const QString path = QString::fromStdString(named.string());
        const auto choose = [&] {
            // Once it is there, however long that takes.
            auto *waiting = new QTimer(this);
            waiting->start(20);
            connect(waiting, &QTimer::timeout, this, [path, waiting] {
                auto *dialog = qobject_cast<QFileDialog *>(QApplication::activeModalWidget());
                if (dialog == nullptr)
                    return;
                waiting->deleteLater();
                waiting->stop();
                dialog->setDirectory(path);
                dialog->findChild<QLineEdit *>("fileNameEdit")->setText(path);
                QMetaObject::invokeMethod(dialog, "accept");
            });
        };
        static constexpr std::array keys{"FileDialog/lastVisited", "FileDialog/history"};
        const auto values = [] {
            const QSettings ofQt(QSettings::UserScope, "QtProject");
            return std::array{ofQt.value(keys[0]), ofQt.value(keys[1])};
        };
        const auto trace = [&] {
            return values()[0].toString() + values()[1].toStringList().join(" ");
        };
        // The file is the user's, who runs this.
        const auto restore = qScopeGuard([before = values()] {
            QSettings ofQt(QSettings::UserScope, "QtProject");
            for (std::size_t n = 0; n < keys.size(); ++n)
                before[n].isValid() ? ofQt.setValue(keys[n], before[n]) : ofQt.remove(keys[n]);
        });
        choose();
        find<QAction>("openFolderAction")->trigger();
        settleIn();
        QVERIFY2(!trace().contains(path), qPrintable(trace()));
        choose();
        QFileDialog::getExistingDirectory(); // as without care
        QVERIFY(trace().contains(path));
    }

    void theTitleNamesThePatientOnlyWhereThatIsChosen() {
        openIn(headPath());
        QCOMPARE(window_().windowTitle(), QString("Pellucid"));
        openDialog();
        find<QCheckBox>("patientTitleBox")->click();
        QCOMPARE(window_().windowTitle(), QString("Secret Name - Pellucid"));
    }

    void theHistoryGoesBackToAnyEdit() {
        openIn(headPath());
        const scene::Scene before = document().scene();
        choosePreset("Bone");
        find<QAction>("filmAction")->trigger();
        find<QDockWidget>("historyDock")->show();
        auto *history = find<QUndoView>("historyView");
        QCOMPARE(history->model()->rowCount(), 3); // with how it was opened
        QVERIFY(history->model()->index(1, 0).data().toString().contains("Bone"));
        const QRect row = history->visualRect(history->model()->index(0, 0));
        QTest::mouseClick(history->viewport(), Qt::LeftButton, {}, row.center());
        QVERIFY(document().scene().look == before.look);
        QVERIFY(!document().scene().tone.inverted);
        settleIn();
    }

    void aboutNamesWhatTheProgramIsMadeOf() {
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

    // Who cannot see the screen hears what a control is for.
    void everyControlThatTakesTheKeyboardHasAName() {
        openIn(headPath());
        choosePreset("Bone");
        QStringList nameless;
        for (QWidget *widget : window_().findChildren<QWidget *>()) {
            // The edit line of a spin box speaks by the box.
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
    // As if the program had ended and been started again.
    void begin() {
        m_program.reset();
        m_program = std::make_unique<ui::Workstation>();
        window_().resize(1600, 1000);
        QVERIFY(QTest::qWaitForWindowExposed(&window_()));
        window_().activateWindow();
    }
    ui::MainWindow &window_() { return m_program->window(); }
    ui::Document &document() { return m_program->bench().document; }
    ui::ProjectionView *projectionOf() { return find<ui::ProjectionView>("projectionView"); }
    template <class T> T *find(const char *name) {
        T *found = window_().findChild<T *>(name);
        if (found == nullptr)
            qFatal("no %s", name);
        return found;
    }
    void settleIn() {
        QTRY_VERIFY_WITH_TIMEOUT(
            projectionOf()->showsFinalImage() && !m_program->bench().jobs.isRunning(), patienceMs);
    }
    void openIn(const QString &path) {
        drop(window_(), {QUrl::fromLocalFile(path)});
        settleIn();
    }
    void choosePreset(const QString &name) {
        clickPreset(window_(), name);
        settleIn();
    }
    void openDialog() {
        find<QAction>("preferencesAction")->trigger();
        QVERIFY(find<QDialog>("preferencesDialog")->isVisible());
    }
    void choose(const char *box, const QString &value) {
        openDialog();
        auto *choice = find<QComboBox>(box);
        const bool isOther = choice->currentData().toString() != value;
        const QPointer<QWidget> former = &window_();
        choice->setCurrentIndex(choice->findData(value));
        emit choice->activated(choice->currentIndex());
        // The window is made anew for it; the dialog stays, with what was chosen.
        if (isOther)
            QTRY_VERIFY_WITH_TIMEOUT(!former, patienceMs);
        auto *dialog = window_().findChild<QDialog *>("preferencesDialog");
        QVERIFY(dialog != nullptr && dialog->isVisible());
        QCOMPARE(dialog->findChild<QComboBox *>(box)->currentData().toString(), value);
        dialog->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        // Each time of the window that is there then.
        QTRY_VERIFY_WITH_TIMEOUT(window_().isVisible() && window_().windowHandle()->isExposed(),
                                 patienceMs);
        window_().resize(1600, 1000);
        QVERIFY(test::activate(window_()));
    }
    void grabAs(const QString &name) {
        if (const QString folder = qEnvironmentVariable("PELLUCID_ARTIFACTS"); !folder.isEmpty())
            QVERIFY(window_().grab().save(folder + "/workstation_" + name + ".png"));
    }

    QStringList englishTexts() {
        static const QRegularExpression word("[A-Za-z]{3,}");
        // Names, units and what has no other word.
        static const QRegularExpression proper(
            "Secret|Name|DICOMDIR|DICOM|NRRD|NIfTI|MetaImage|Pellucid|MIP|MinIP|CPU|GPU|AVX\\d?|"
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
        for (const QAction *action : window_().findChildren<QAction *>())
            // Edits keep the language in which they were made.
            if (!action->objectName().isEmpty() && action != find<QAction>("undoAction")) {
                look(action->text(), action->objectName());
                look(action->toolTip(), action->objectName());
            }
        for (const QWidget *widget : window_().findChildren<QWidget *>()) {
            const QString where = widget->objectName();
            // Kernels and steps are called by what one types.
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

    std::unique_ptr<ui::Workstation> m_program;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::PreferencesTest>(argc, argv);
}

#include "preferences_test.moc"
