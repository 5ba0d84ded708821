// SPDX-License-Identifier: GPL-3.0-or-later
// Small things that would stop or surprise a user: each as a person meets it, by clicks and keys.
#include "tests/support/dicom_writer.h"
#include "tests/ui/studies_window.h"

#include <QDesktopServices>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QScopeGuard>
#include <QScrollArea>
#include <QToolBar>
#include <QToolButton>

#include "ui/opening/recent_paths.h"
#include "ui/panels/curve_editor.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class FrictionTest : public StudiesWindow {
    Q_OBJECT
private slots:
    void theClassDialogLeavesTheProjectionFree() {
        open(headPath());
        choosePreset("Bone over soft tissue");
        doubleClick(find<QWidget>("classRow0"));
        auto *dialog = find<QDialog>("classDialog");
        QVERIFY(dialog->isVisible());
        const QRect shown(dialog->mapToGlobal(QPoint()), dialog->size());
        const QRect picture(projection()->mapToGlobal(QPoint()), projection()->size());
        QVERIFY(shown.intersected(picture).width() < picture.width() / 3);
        save("class_dialog_beside");
        dialog->reject();
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

    // A curve over the values of fat and muscle, its left half at 0, hides fat and keeps bone.
    void theCurveOfATypedRangeShows() {
        open(headPath());
        auto *editor = find<ui::CurveEditor>("curveEditor");
        for (const auto &[name, value] :
             {std::pair("curveLowBox", "-100"), {"curveHighBox", "60"}}) {
            auto *box = find<QDoubleSpinBox>(name);
            box->selectAll();
            QTest::keyClicks(box, value);
            QTest::keyClick(box, Qt::Key_Return);
        }
        settle();
        const QImage plain = projection()->picture();
        for (int point = 0; point < 3; ++point)
            dragMouse(editor, Qt::LeftButton, editor->handleAt(point).toPoint(), {0, 60});
        settle();
        const auto &weights = document().scene().look.transferFunction.weights;
        QVERIFY(weights[0] < 0.2 && weights[5] == 1.0);
        QVERIFY(changed(plain, projection()->picture()) > 0.01);
        save("curve_range");
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
    static void doubleClick(QWidget *widget) {
        QTest::mouseDClick(widget, Qt::LeftButton, {}, QPoint(60, 8));
    }

    QString m_openedIn, m_page;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::FrictionTest>(argc, argv);
}

#include "friction_test.moc"
