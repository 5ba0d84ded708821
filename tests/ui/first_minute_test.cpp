// SPDX-License-Identifier: GPL-3.0-or-later
// A new user's first minute with the program itself, as it is installed: start it, open a study,
// window, orbit, take a preset, save a look, export, quit; and what of it is on the disk
// afterwards.
#include <QtTest>

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QProcess>
#include <QPushButton>

#include "tests/ui/workstation.h"
#include "ui/views/mpr_view.h"
#include "ui/window/main_window.h"
#include "ui/window/workstation.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class FirstMinuteTest : public test::Workstation {
    Q_OBJECT
private slots:
    void init() {}
    void cleanup() {}

    void fromTheStartPageToFilesOnTheDisk() {
        QSettings().clear();
        auto program = std::make_unique<ui::Workstation>();
        m_program = program.get();
        window().resize(1600, 1000);
        QVERIFY(QTest::qWaitForWindowExposed(&window()));
        window().activateWindow();
        QVERIFY(of<QWidget>("startPage")->isVisible());

        // Open: a folder is dropped.
        drop(window(), {QUrl::fromLocalFile(headPath())});
        rest();
        QVERIFY(!of<QWidget>("startPage")->isVisible());

        // Window: a key, then the hand.
        QTest::keyClick(&window(), Qt::Key_4);
        dragMouse(of<QWidget>("axialView"), Qt::LeftButton, {120, 120}, {40, -20});
        const volume::ValueWindow shown = program->bench().document.displayWindow();
        QVERIFY(shown.width > 1500.0);

        // Orbit.
        const auto before = program->bench().document.scene().camera.orientation;
        dragMouse(of<QWidget>("projectionView"), Qt::LeftButton, {300, 400}, {90, 10});
        rest();
        QVERIFY(program->bench().document.scene().camera.orientation != before);

        // A preset of the gallery, a look of one's own in two clicks.
        auto *gallery = of<QListWidget>("presetGallery");
        clickPreset(window(), "Bone over soft tissue");
        rest();
        QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
        auto *name = of<QLineEdit>("lookNameEdit");
        QTRY_VERIFY(name->isVisible());
        QTest::keyClicks(name, "My bones");
        QTest::keyClick(name, Qt::Key_Return);
        QVERIFY(!gallery->findItems("My bones", Qt::MatchExactly).isEmpty());

        // A distance.
        QTest::keyClick(&window(), Qt::Key_M);
        dragMouse(of<QWidget>("axialView"), Qt::LeftButton, {100, 140}, {80, 20});
        QCOMPARE(program->bench().document.measured().size(), std::size_t(1));

        // Export.
        QTest::keyClick(&window(), Qt::Key_E, Qt::ControlModifier);
        const QString png = QString::fromStdString((m_folder / "first.png").string());
        of<QLineEdit>("exportPathEdit")->setText(png);
        QTest::mouseClick(of<QPushButton>("exportWriteButton"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(window().findChild<QWidget *>("exportDialog") == nullptr,
                                 patienceMs);

        // Importing asks before it keeps anything: not today.
        QTest::keyClick(&window(), Qt::Key_I, Qt::ControlModifier);
        QTRY_VERIFY(window().findChild<QWidget *>("importDialog") != nullptr);
        window().findChild<QDialog *>("importDialog")->reject();

        // Quit.
        QTest::keyClick(&window(), Qt::Key_Q, Qt::ControlModifier);
        QTRY_VERIFY(!window().isVisible());
        program.reset();

        // On the disk: the picture, coloured and said not to diagnose with ...
        const QImage picture(png);
        QVERIFY(picture.width() > 400 && colorfulness(picture) > 1.0);
        QCOMPARE(picture.text("Comment"), QString("Not for diagnostic use"));
        // ... the look, that the command line accepts ...
        const fs::path data = m_folder / "data" / "pellucid";
        int looks = 0;
        for (const auto &entry : fs::directory_iterator(data / "presets")) {
            ++looks;
            QProcess check;
            check.start(PELLUCID_CLI,
                        {"preset", "validate", QString::fromStdString(entry.path().string())});
            QVERIFY(check.waitForFinished() && check.exitCode() == 0);
        }
        QCOMPARE(looks, 1);
        // ... the measurement, what was open, and no name of the patient anywhere.
        QCOMPARE(std::distance(fs::directory_iterator(data / "measurements"), {}), 1);
        QVERIFY(fs::exists(data / "session.json"));
        for (const auto &entry : fs::recursive_directory_iterator(m_folder / "data")) {
            if (!entry.is_regular_file())
                continue;
            QFile file(QString::fromStdString(entry.path().string()));
            QVERIFY(file.open(QIODevice::ReadOnly));
            QVERIFY2(!file.readAll().contains("Secret"), entry.path().c_str());
        }

        // And the next start offers to go on.
        m_program = nullptr;
        program = std::make_unique<ui::Workstation>();
        m_program = program.get();
        QVERIFY(QTest::qWaitForWindowExposed(&window()));
        QVERIFY(of<QWidget>("resumeButton")->isVisible());
        m_program = nullptr;
    }

private:
    ui::MainWindow &window() { return m_program->window(); }
    template <class T> T *of(const char *name) {
        T *found = window().findChild<T *>(name);
        if (found == nullptr)
            qFatal("no %s", name);
        return found;
    }
    void rest() {
        QTRY_VERIFY_WITH_TIMEOUT(of<ui::ProjectionView>("projectionView")->showsFinalImage() &&
                                     !m_program->bench().jobs.isRunning(),
                                 patienceMs);
    }

    ui::Workstation *m_program = nullptr;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::FirstMinuteTest>(argc, argv);
}

#include "first_minute_test.moc"
