// SPDX-License-Identifier: GPL-3.0-or-later
// A new user's first minute with the program itself, as it is installed: start it, open a study,
// window, orbit, take a preset, save a look, export, quit; and what of it is on the disk
// afterwards.
#include "tests/ui/started_program.h"

#include <filesystem>

#include <QDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QProcess>
#include <QPushButton>

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class FirstMinuteTest : public StartedProgram {
    Q_OBJECT
private slots:
    void init() {}
    void cleanup() { m_program.reset(); }

    // One after the other in one program; what follows a step that fails is not tried.
    void fromTheStartPageToFilesOnTheDisk() {
        QSettings().clear();
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
        begin();
        QVERIFY(find<QWidget>("startPage")->isVisible());
        openIn(headPath());
        QVERIFY(!find<QWidget>("startPage")->isVisible());
    }

    // A key, then the hand.
    void setTheWindow() {
        QTest::keyClick(&window_(), Qt::Key_4);
        dragMouse(find<QWidget>("axialView"), Qt::LeftButton, {120, 120}, {40, -20});
        QVERIFY(document().displayWindow().width > 1500.0);
    }

    void orbit() {
        const auto before = document().scene().camera.orientation;
        dragMouse(find<QWidget>("projectionView"), Qt::LeftButton, {300, 400}, {90, 10});
        settleIn();
        QVERIFY(document().scene().camera.orientation != before);
    }

    // A preset of the gallery, a look of one's own in two clicks.
    void keepALook() {
        choosePreset("Bone over soft tissue");
        QTest::keyClick(&window_(), Qt::Key_S, Qt::ControlModifier);
        auto *name = find<QLineEdit>("lookNameEdit");
        QTRY_VERIFY(name->isVisible());
        QTest::keyClicks(name, "My bones");
        QTest::keyClick(name, Qt::Key_Return);
        QVERIFY(
            !find<QListWidget>("presetGallery")->findItems("My bones", Qt::MatchExactly).isEmpty());
    }

    void measure() {
        QTest::keyClick(&window_(), Qt::Key_M);
        dragMouse(find<QWidget>("axialView"), Qt::LeftButton, {100, 140}, {80, 20});
        QCOMPARE(document().measured().size(), std::size_t(1));
    }

    void exportAPicture() {
        QTest::keyClick(&window_(), Qt::Key_E, Qt::ControlModifier);
        find<QLineEdit>("exportPathEdit")->setText(png());
        QTest::mouseClick(find<QPushButton>("exportWriteButton"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(window_().findChild<QWidget *>("exportDialog") == nullptr,
                                 patienceMs);
    }

    // It asks before it keeps anything: not today.
    void lookAtImporting() {
        QTest::keyClick(&window_(), Qt::Key_I, Qt::ControlModifier);
        QTRY_VERIFY(window_().findChild<QWidget *>("importDialog") != nullptr);
        window_().findChild<QDialog *>("importDialog")->reject();
    }

    void quit() {
        QTest::keyClick(&window_(), Qt::Key_Q, Qt::ControlModifier);
        QTRY_VERIFY(!window_().isVisible());
        m_program.reset();
    }

    // Coloured, and said not to diagnose with.
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

    // The measurement and what was open are there, and no name of the patient anywhere.
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

    // The next start offers to go on.
    void startAgain() {
        begin();
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
