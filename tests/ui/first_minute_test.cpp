// SPDX-License-Identifier: GPL-3.0-or-later
// A new user's first minute: start the program, open a study, window, orbit, choose a preset, save
// a look, export, quit; and the files that are on the disk afterwards.
#include "tests/ui/workstation.h"

#include <filesystem>

#include <QDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QProcess>
#include <QPushButton>

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class FirstMinuteTest : public Workstation {
    Q_OBJECT
private slots:
    // The steps follow each other in one program; the first that fails ends the test.
    void fromTheStartPageToFilesOnTheDisk() {
        using Step = void (FirstMinuteTest::*)();
        for (const Step step : {&FirstMinuteTest::openAFolder, &FirstMinuteTest::setTheWindow,
                                &FirstMinuteTest::orbit, &FirstMinuteTest::keepALook,
                                &FirstMinuteTest::measure, &FirstMinuteTest::exportAPicture,
                                &FirstMinuteTest::lookAtImporting, &FirstMinuteTest::quit,
                                &FirstMinuteTest::findThePicture, &FirstMinuteTest::findTheLook,
                                &FirstMinuteTest::findNoName, &FirstMinuteTest::startAgain}) {
            (this->*step)();
            if (QTest::currentTestFailed())
                return;
        }
    }

private:
    void openAFolder() {
        QVERIFY(find<QWidget>("startPage")->isVisible());
        open(headPath());
        QVERIFY(!find<QWidget>("startPage")->isVisible());
    }

    // By a key, then by a drag.
    void setTheWindow() {
        QTest::keyClick(&mainWindow(), Qt::Key_4);
        dragMouse(find<QWidget>("axialView"), Qt::LeftButton, {120, 120}, {40, -20});
        QVERIFY(document().displayWindow().width > 1500.0);
    }

    void orbit() {
        const auto before = document().scene().camera.orientation;
        dragMouse(projection(), Qt::LeftButton, {300, 400}, {90, 10});
        settle();
        QVERIFY(document().scene().camera.orientation != before);
    }

    // A preset of the gallery, then a look under a new name.
    void keepALook() {
        choosePreset("Bone over soft tissue");
        QTest::keyClick(&mainWindow(), Qt::Key_S, Qt::ControlModifier);
        auto *name = find<QLineEdit>("lookNameEdit");
        QTRY_VERIFY(name->isVisible());
        QTest::keyClicks(name, "My bones");
        QTest::keyClick(name, Qt::Key_Return);
        QVERIFY(
            !find<QListWidget>("presetGallery")->findItems("My bones", Qt::MatchExactly).isEmpty());
    }

    void measure() {
        QTest::keyClick(&mainWindow(), Qt::Key_M);
        dragMouse(find<QWidget>("axialView"), Qt::LeftButton, {100, 140}, {80, 20});
        QCOMPARE(document().measured().size(), std::size_t(1));
    }

    void exportAPicture() {
        QTest::keyClick(&mainWindow(), Qt::Key_E, Qt::ControlModifier);
        find<QLineEdit>("exportPathEdit")->setText(png());
        QTest::mouseClick(find<QPushButton>("exportWriteButton"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(mainWindow().findChild<QWidget *>("exportDialog") == nullptr,
                                 patienceMs);
    }

    // The program asks before it imports: rejected.
    void lookAtImporting() {
        QVERIFY(activate(mainWindow())); // there may be no window manager that does
        QTest::keyClick(&mainWindow(), Qt::Key_I, Qt::ControlModifier);
        QTRY_VERIFY(mainWindow().findChild<QWidget *>("importDialog") != nullptr);
        mainWindow().findChild<QDialog *>("importDialog")->reject();
    }

    void quit() {
        QTest::keyClick(&mainWindow(), Qt::Key_Q, Qt::ControlModifier);
        QTRY_VERIFY(!mainWindow().isVisible());
        endProgram();
    }

    // It is colored, and marked as not for diagnostic use.
    void findThePicture() {
        const QImage picture(png());
        QVERIFY(picture.width() > 400 && colorfulness(picture) > 1.0);
        QCOMPARE(picture.text("Comment"), QString("Not for diagnostic use"));
    }

    // The command line accepts it.
    void findTheLook() {
        int looks = 0;
        for (const auto &entry : fs::directory_iterator(data() / "presets")) {
            ++looks;
            QProcess check;
            check.start(PELLUCID_CLI,
                        {"preset", "validate", QString::fromStdString(entry.path().string())});
            QVERIFY(check.waitForFinished() && check.exitCode() == 0);
        }
        QCOMPARE(looks, 1);
    }

    // Measurement and session are kept, and no file contains the patient's name.
    void findNoName() {
        QCOMPARE(std::distance(fs::directory_iterator(data() / "measurements"), {}), 1);
        QVERIFY(fs::exists(data() / "session.json"));
        for (const auto &entry : fs::recursive_directory_iterator(m_folder / "data")) {
            if (!entry.is_regular_file())
                continue;
            QFile file(QString::fromStdString(entry.path().string()));
            QVERIFY(file.open(QIODevice::ReadOnly));
            QVERIFY2(!file.readAll().contains("Secret"), entry.path().c_str());
        }
    }

    // The next start offers to resume.
    void startAgain() {
        restart();
        QVERIFY(find<QWidget>("resumeButton")->isVisible());
    }

    QString png() const { return QString::fromStdString((m_folder / "first.png").string()); }
    fs::path data() const { return m_folder / "data" / "pellucid"; }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::FirstMinuteTest>(argc, argv);
}

#include "first_minute_test.moc"
