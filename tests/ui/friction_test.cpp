// SPDX-License-Identifier: GPL-3.0-or-later
// Small things that would stop or surprise a user: each as a person meets it, by clicks and keys.
#include "tests/support/dicom_writer.h"
#include "tests/ui/studies_window.h"

#include <QDesktopServices>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QScopeGuard>
#include <QScrollArea>
#include <QScrollBar>
#include <QToolBar>
#include <QToolButton>

#include "core/presets/preset_library.h"
#include "ui/opening/recent_paths.h"
#include "ui/panels/curve_editor.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class FrictionTest : public StudiesWindow {
    Q_OBJECT
private slots:
    void aSavedPresetIsFirstAndSelected() {
        open(headPath());
        choosePreset("Bone");
        saveLook("My bone, a name of two lines");
        auto *gallery = find<QListWidget>("presetGallery");
        QCOMPARE(gallery->item(0)->text(), QString("My bone, a name of two lines"));
        // It looks like the built-in one, but it is the one that was saved.
        QCOMPARE(gallery->currentRow(), 0);
        choosePreset("Bone");
        QCOMPARE(gallery->currentItem()->text(), QString("Bone"));
    }

    void deletingAPresetAsksAndIsUndone() {
        open(headPath());
        saveLook("Mine");
        const auto choose = [&](bool deletes) {
            auto *gallery = find<QListWidget>("presetGallery");
            emit gallery->customContextMenuRequested(
                gallery->visualItemRect(gallery->item(0)).center());
            find<QAction>("removePresetAction")->trigger();
            find<QMenu>("presetMenu")->close();
            auto *question = find<QMessageBox>("removePresetQuestion");
            QVERIFY(question->isVisible());
            QTest::keyClick(question, Qt::Key_Return); // the default keeps it
            QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
            if (!deletes)
                return;
            emit gallery->customContextMenuRequested(
                gallery->visualItemRect(gallery->item(0)).center());
            find<QAction>("removePresetAction")->trigger();
            find<QMenu>("presetMenu")->close();
            question = find<QMessageBox>("removePresetQuestion");
            for (QAbstractButton *button : question->buttons())
                if (question->buttonRole(button) == QMessageBox::AcceptRole)
                    button->click();
            QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        };
        choose(false);
        QVERIFY(hasPreset("Mine"));
        choose(true);
        QVERIFY(!hasPreset("Mine"));
        QVERIFY(presets::PresetLibrary::ofUser().find("Mine") == nullptr);
        find<QAction>("undoAction")->trigger();
        QVERIFY(hasPreset("Mine"));
        QVERIFY(presets::PresetLibrary::ofUser().find("Mine") != nullptr);
        find<QAction>("redoAction")->trigger();
        QVERIFY(!hasPreset("Mine"));
    }

    void enterTakesANumberAndDoesNotCloseTheClassDialog() {
        open(headPath());
        choosePreset("Bone over soft tissue");
        doubleClick(find<QWidget>("classRow0"));
        auto *dialog = find<QDialog>("classDialog");
        QVERIFY(dialog->isVisible());
        find<QAction>("step_grow")->trigger();
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
        // It does not cover the projection.
        const QRect shown(dialog->mapToGlobal(QPoint()), dialog->size());
        const QRect picture(projection()->mapToGlobal(QPoint()), projection()->size());
        QVERIFY(shown.intersected(picture).width() < picture.width() / 3);
        save("class_dialog_beside");
        dialog->findChild<QDialogButtonBox *>()->button(QDialogButtonBox::Ok)->click();
        settle();
        const auto &steps = document().scene().look.classes[0].steps;
        QVERIFY(!steps.empty() && steps.back().kind == classify::StepKind::grow);
        QCOMPARE(steps.back().at("mm"), 4.0);
    }

    void emptyPanelsSayWhy() {
        QVERIFY(find<QLabel>("presetsEmpty")->isVisibleTo(&mainWindow()));
        QVERIFY(find<QLabel>("studiesEmpty")->isVisible());
        open(headPath());
        QVERIFY(!find<QLabel>("presetsEmpty")->isVisibleTo(&mainWindow()));
        QVERIFY(!find<QLabel>("studiesEmpty")->isVisible());
    }

    void aSearchSaysNothingFoundAndKeepsWhatIsOpen() {
        open(headPath());
        auto *search = find<QLineEdit>("studySearch");
        search->setText("no such words");
        QTest::keyClick(search, Qt::Key_Return);
        auto *message = find<QLabel>("studiesEmpty");
        QVERIFY(message->isVisible());
        QCOMPARE(message->text(), QString("No other study found"));
        QCOMPARE(rows(), QStringList{"Secret Name"}); // which is open
        search->clear();
        QTest::keyClick(search, Qt::Key_Return);
        QVERIFY(!message->isVisible());
    }

    void nothingIsCutInALowWindow() {
        restart({1280, 720});
        for (const char *name : {"presets", "radiograph", "shading", "quality", "classes"})
            QVERIFY2(find<QDockWidget>(qPrintable(QString("%1Dock").arg(name)))
                         ->toggleViewAction()
                         ->isChecked(),
                     name);
        open(headPath());
        choosePreset("Bone over soft tissue");
        QVERIFY(mainWindow().minimumSizeHint().width() <= 1280);
        QVERIFY(mainWindow().minimumSizeHint().height() <= 690);
        auto *presets = find<QDockWidget>("presetsDock");
        QCOMPARE(mainWindow().tabifiedDockWidgets(presets).size(), 3);
        save("low_window");
        // Each panel of a tab shows all of itself.
        for (const char *name : {"radiograph", "shading", "quality"}) {
            auto *dock = find<QDockWidget>(qPrintable(QString("%1Dock").arg(name)));
            dock->raise();
            QCoreApplication::processEvents();
            auto *area = find<QScrollArea>(qPrintable(QString("%1PanelArea").arg(name)));
            QVERIFY(area->isVisible());
            QVERIFY2(area->verticalScrollBar()->maximum() == 0,
                     qPrintable(QString("%1: %2 of %3")
                                    .arg(name)
                                    .arg(area->verticalScrollBar()->maximum())
                                    .arg(area->widget()->height())));
            save(QString("low_window_%1").arg(name));
        }
        // In a higher window, they are stacked again.
        mainWindow().resize(1280, 1000);
        QTRY_VERIFY(mainWindow().tabifiedDockWidgets(presets).isEmpty());
        // A dock that the user has moved stays where it is.
        find<QDockWidget>("shadingDock")->setFloating(true);
        mainWindow().resize(1280, 720);
        QCoreApplication::processEvents();
        QVERIFY(mainWindow().tabifiedDockWidgets(presets).isEmpty());
        find<QAction>("resetLayoutAction")->trigger();
        QVERIFY(!find<QDockWidget>("shadingDock")->isFloating());
        QCOMPARE(mainWindow().tabifiedDockWidgets(presets).size(), 3);
    }

    void theCurveIsZoomedTypedAndUndone() {
        open(headPath());
        auto *editor = find<ui::CurveEditor>("curveEditor");
        const auto function = [&] { return document().scene().look.transferFunction; };
        turnWheelAt(editor, QPointF(editor->width() / 2.0, 40), 6);
        QVERIFY(!function().isWhole());
        QVERIFY(function().high - function().low < 0.3);
        settle();
        find<QAction>("undoAction")->trigger(); // one turn of the wheel is one edit
        QVERIFY(function().isWhole());
        // Fat and muscle: 160 HU for all points.
        auto *low = find<QDoubleSpinBox>("curveLowBox"),
             *high = find<QDoubleSpinBox>("curveHighBox");
        QCOMPARE(low->value(), -900.0);
        QCOMPARE(high->value(), 2000.0);
        low->selectAll();
        QTest::keyClicks(low, "-100");
        QTest::keyClick(low, Qt::Key_Return);
        high->selectAll();
        QTest::keyClicks(high, "60");
        QTest::keyClick(high, Qt::Key_Return);
        QVERIFY(std::abs(function().low - 800.0 / 2900.0) < 1e-12);
        QVERIFY(std::abs(function().high - 960.0 / 2900.0) < 1e-12);
        settle();
        const QImage plain = projection()->picture();
        // The left half at 0: fat vanishes and bone stays.
        for (int point = 0; point < 3; ++point)
            dragMouse(editor, Qt::LeftButton, editor->handleAt(point).toPoint(), {0, 60});
        settle();
        QVERIFY(function().weights[0] < 0.2 && function().weights[5] == 1.0);
        QVERIFY(changed(plain, projection()->picture()) > 0.01);
        save("curve_range");
        // A double-click on the axis shows all values again.
        QTest::mouseDClick(editor, Qt::LeftButton, {}, QPoint(100, editor->height() - 4));
        QVERIFY(function().isWhole());
    }

    void importListsAreShortened() {
        writeChests();
        find<QAction>("importAction")->trigger();
        auto *dialog = find<QDialog>("importDialog");
        QVERIFY(!dialog->findChild<QListWidget *>("importPaths")->isVisible());
        dialog->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        const QString a = QString::fromStdString((m_folder / "three" / "Miller^Ann").string());
        const QString b = QString::fromStdString((m_folder / "three" / "Zhang^Wei").string());
        mainWindow().files().importPaths({a, b});
        dialog = find<QDialog>("importDialog");
        auto *list = dialog->findChild<QListWidget *>("importPaths");
        QCOMPARE(list->count(), 2);
        list->item(0)->setSelected(true);
        list->setFocus();
        QTest::keyClick(list, Qt::Key_Delete);
        QCOMPARE(list->count(), 1);
        dialog->findChild<QPushButton *>("importNowButton")->click();
        QTRY_COMPARE_WITH_TIMEOUT(rows(), QStringList{"Zhang Wei"}, patienceMs);
    }

    void recentKeepsAPathThatNamesThePatientWithoutSayingSo() {
        const fs::path named = m_folder / "Secret Name";
        fs::copy(headPath().toStdString(), named);
        open(QString::fromStdString(named.string()));
        restart();
        // The settings do not name the patient, and neither does the page.
        for (const QString &key : QSettings().allKeys())
            QVERIFY2(!QSettings().value(key).toString().contains("Secret") &&
                         QSettings().value(key).toStringList().filter("Secret").isEmpty(),
                     qPrintable(key));
        QPushButton *link = nullptr;
        for (QPushButton *button : find<QWidget>("startPage")->findChildren<QPushButton *>()) {
            QVERIFY(!button->text().contains("Secret") && !button->toolTip().contains("Secret"));
            if (button->text() == "2026-01-01 CT")
                link = button;
        }
        QVERIFY(link != nullptr);
        link->click();
        settle();
        QCOMPARE(rows(), QStringList{"Secret Name"});
        // Forgotten is forgotten.
        find<QAction>("forgetRecentAction")->trigger();
        const fs::path kept = m_folder / "data" / "pellucid" / "recent";
        QVERIFY(!fs::exists(kept) || fs::is_empty(kept));
    }

    void warningsNameNoUid() {
        const std::string uid = "1.2.826.0.1.3680043.8.498.12345678901234567890";
        test::SeriesKnobs knobs;
        knobs.missing = {3};
        test::writeSeries(m_folder / "gap", knobs);
        for (const auto &file : fs::directory_iterator(m_folder / "gap"))
            fs::rename(file.path(),
                       m_folder / "gap" / (uid + "." + file.path().stem().string() + ".dcm"));
        open(QString::fromStdString((m_folder / "gap").string()));
        const auto &warnings = document().volume()->notes().warnings;
        QVERIFY(!warnings.empty());
        QString texts;
        for (const QString &text : ui::warningTexts(document().sources()[0].volume))
            texts += text + "\n";
        QVERIFY2(!texts.contains("3680043"), qPrintable(texts));
        save("warning_mark");
    }

    void tooltipsOfTheToolBarNameTheirKeys() {
        for (QAction *action : find<QToolBar>("toolBar")->actions()) {
            const QString key = action->shortcut().toString(QKeySequence::NativeText);
            if (!key.isEmpty())
                QVERIFY2(action->toolTip().endsWith("(" + key + ")"),
                         qPrintable(action->toolTip()));
        }
        QVERIFY(find<QToolBar>("toolBar")->actions().contains(find<QAction>("undoAction")));
        QVERIFY(
            find<QToolBar>("toolBar")->actions().contains(find<QAction>("exportPictureAction")));
        QVERIFY(!find<QToolBar>("toolBar")->actions().contains(find<QAction>("savePictureAction")));
        open(headPath());
        auto *views = find<QToolButton>("viewsButton");
        views->menu()->actions()[2]->trigger();
        settle();
        QCOMPARE(document().scene().camera.orientation,
                 scene::viewOrientation(scene::StandardView::left));
    }

    void theManualOpensInTheBrowser() {
        QDesktopServices::setUrlHandler("file", this, "openPage");
        const auto browser = qScopeGuard([] { QDesktopServices::unsetUrlHandler("file"); });
        QTest::keyClick(&mainWindow(), Qt::Key_F1);
        QVERIFY2(m_page.endsWith("/manual/manual.html"), qPrintable(m_page));
        QVERIFY(QFileInfo(m_page).isFile());
        QVERIFY(document().problems().empty());
    }

    void fileDialogsKeepTheirFolder() {
        open(headPath());
        const fs::path folder = m_folder / "pictures";
        fs::create_directory(folder);
        const auto accept = [&](const QString &name) {
            auto *waiting = new QTimer(this);
            waiting->start(20);
            connect(waiting, &QTimer::timeout, this, [this, name, waiting] {
                auto *dialog = qobject_cast<QFileDialog *>(QApplication::activeModalWidget());
                if (dialog == nullptr)
                    return;
                waiting->stop();
                waiting->deleteLater();
                m_openedIn = dialog->directory().absolutePath();
                dialog->findChild<QLineEdit *>("fileNameEdit")->setText(name);
                QMetaObject::invokeMethod(dialog, "accept");
            });
        };
        accept(QString::fromStdString((folder / "a.png").string()));
        find<QAction>("savePictureAction")->trigger();
        QTRY_VERIFY(fs::exists(folder / "a.png"));
        accept("b.png");
        find<QAction>("savePictureAction")->trigger();
        QTRY_VERIFY(fs::exists(folder / "b.png"));
        QCOMPARE(m_openedIn, QString::fromStdString(folder.string()));
    }

public slots:
    void openPage(const QUrl &page) { m_page = page.toLocalFile(); }

private:
    void saveLook(const QString &name) {
        find<QAction>("saveLookAction")->trigger();
        auto *edit = find<QLineEdit>("lookNameEdit");
        edit->selectAll();
        QTest::keyClicks(edit, name);
        QTest::keyClick(edit, Qt::Key_Return);
    }
    bool hasPreset(const QString &name) {
        return !find<QListWidget>("presetGallery")->findItems(name, Qt::MatchExactly).isEmpty();
    }
    static void doubleClick(QWidget *widget) {
        QTest::mouseDClick(widget, Qt::LeftButton, {}, QPoint(60, 8));
    }
    static void turnWheelAt(QWidget *widget, const QPointF &at, int steps) {
        for (int n = 0; n < steps; ++n) {
            QWheelEvent event(at, widget->mapToGlobal(at), {}, QPoint(0, 120), Qt::NoButton,
                              Qt::NoModifier, Qt::NoScrollPhase, false);
            QCoreApplication::sendEvent(widget, &event);
        }
    }

    QString m_openedIn, m_page;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::FrictionTest>(argc, argv);
}

#include "friction_test.moc"
