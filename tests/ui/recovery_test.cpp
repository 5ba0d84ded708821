// SPDX-License-Identifier: GPL-3.0-or-later
// A program that is killed or terminated loses only the last moment.
#include "tests/ui/workstation.h"

#include <csignal>
#include <fstream>
#include <optional>

#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QPushButton>
#include <QScopeGuard>

#include <glm/gtc/quaternion.hpp>

#include "core/files/session_folder.h"
#include "core/task/reasons.h"
#include "tests/support/files.h"
#include "tests/support/read_only_folder.h"
#include "tests/ui/workstation_process.h"
#include "ui/document/commands.h"
#include "ui/opening/reasons.h"
#include "ui/opening/session.h"
#include "ui/studies/reasons.h"
#include "ui/window/file_actions.h"
#include "ui/window/reopening.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class RecoveryTest : public Workstation {
    Q_OBJECT
private slots:
    void initTestCase() {
        Workstation::initTestCase();
        m_sessionFile = m_folder / "data" / "pellucid" / "session.json";
    }
    void init() { forgetEverything(); }

    void theNextStartAfterAKillOffersTheStudy() {
        QProcess program;
        startWorkstation(program, m_folder, {headPath()});
        QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
        QVERIFY(!readText(m_sessionFile).empty());
        program.kill();
        QVERIFY(program.waitForFinished(patienceMs));
        restart();
        auto *offer = find<QPushButton>("resumeButton");
        QVERIFY(offer->isVisible());
        QCOMPARE(offer->text(), QString("Recover the last session"));
        offer->click();
        waitForVolume();
        QCOMPARE(document().volume()->lattice().size().k, 80);
    }

    // Each has its own session file, and a running program is not recovered.
    void concurrentProgramsAreRecoveredSeparately() {
        QProcess first;
        startWorkstation(first, m_folder, {headPath()});
        QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
        const fs::path second = m_sessionFile.parent_path() / "session-2.json";
        restart();
        QVERIFY(!find<QPushButton>("resumeButton")->isVisible());
        mainWindow().openPhantom("chest");
        QTRY_VERIFY_WITH_TIMEOUT(fs::exists(second), patienceMs);
        endProgram();
        QVERIFY(ui::sessionFromJson(readText(second)).hasEnded);
        QVERIFY(!kept().hasEnded);
        first.kill();
        QVERIFY(first.waitForFinished(patienceMs));
        restart();
        auto *offer = find<QPushButton>("resumeButton");
        QCOMPARE(offer->text(), QString("Recover the last session")); // before what has ended
        offer->click();
        waitForVolume();
        QCOMPARE(document().volume()->lattice().size().k, 80);
        mainWindow().reopening().forgetAll();
        QVERIFY(!fs::exists(m_sessionFile) && !fs::exists(second));
    }

    // The files at the path belong to a different study.
    void aDifferentStudyAtTheSamePathIsReported() {
        const fs::path place = m_folder / "place";
        fs::copy(headPath().toStdString(), place);
        keepSessionOf({QString::fromStdString(place.string())});
        endProgram();
        QStringList change{"-nb", "-gst", "-gse", "-gin"};
        for (const auto &file : fs::directory_iterator(place))
            change << QString::fromStdString(file.path().string());
        QCOMPARE(QProcess::execute("dcmodify", change), 0);
        resume();
        QTRY_VERIFY_WITH_TIMEOUT(document().volume(), patienceMs);
        const auto &problems = document().problems();
        QVERIFY(std::any_of(problems.begin(), problems.end(), [](const auto &p) {
            return p.reason.is(task::because::isAnotherStudy);
        }));
    }

    // A look that is not saved as a preset.
    void anUnsavedLookIsRecovered() {
        restart();
        mainWindow().openPaths({headPath()});
        waitForVolume();
        ui::editScene(document(), "Weights", ui::noDrag, [](scene::Scene &scene) {
            scene.look.transferFunction.weights = {0.0, 0.7, 1.9, 0.3};
        });
        const classify::Look edited = document().scene().look;
        QTRY_VERIFY_WITH_TIMEOUT(hasSession() && kept().view.scene.look == edited, patienceMs);
        QVERIFY(!kept().hasEnded);
        // The session as a kill would leave it now.
        fs::copy_file(m_sessionFile, m_folder / "killed.json");
        endProgram();
        QVERIFY(kept().hasEnded);
        fs::copy_file(m_folder / "killed.json", m_sessionFile,
                      fs::copy_options::overwrite_existing);
        resume();
        QTRY_VERIFY_WITH_TIMEOUT(document().scene().look == edited, patienceMs);
    }

    // Slices that could not be used are reported again when the rest is resumed.
    void refusedFilesAreReportedAgain() {
        const fs::path series = m_folder / "refused";
        fs::copy(headPath().toStdString(), series);
        const fs::path damaged = series / "IM0080.dcm";
        fs::resize_file(damaged, 300);
        std::optional<task::Reason> why;
        const auto isNamed = [&] {
            const auto &problems = document().problems();
            return std::any_of(problems.begin(), problems.end(), [&](const dicom::Skipped &p) {
                return p.path == damaged && p.reason == why.value_or(p.reason);
            });
        };
        keepSessionOf({QString::fromStdString(series.string())});
        QVERIFY(isNamed());
        why = kept().leftOut.at(0).reason;
        restart();
        QVERIFY(!isNamed());
        mainWindow().reopening().resume();
        waitForVolume();
        QVERIFY(isNamed());
    }

    // A missing slice that has reappeared is no longer a problem.
    void restoredFilesAreNotReportedAgain() {
        const fs::path series = m_folder / "away";
        fs::copy(headPath().toStdString(), series);
        keepSessionOf({QString::fromStdString(series.string())});
        document().addProblems({{series / "IM0005.dcm", task::because::isGone},
                                {series / "IM0099.dcm", task::because::isEmpty}});
        endProgram();
        QCOMPARE(kept().leftOut.size(), 1U);
        QCOMPARE(kept().leftOut[0].path, series / "IM0099.dcm");
    }

    // Picture, letters, cube and scale are the same as before.
    void aResumedStudyLooksAsBefore() {
        const auto turned = [this] {
            ui::Pose pose = document().pose();
            pose.orientation = glm::normalize(glm::dquat(0.9, 0.1, 0.3, 0.0)) * pose.orientation;
            return pose;
        };
        restart();
        open(headPath());
        ui::Pose moved = turned();
        moved.panMm = {30.0, 0.0};
        moved.zoom = 1.3;
        document().setPose(moved);
        settle();
        const auto exposure = document().exposure();
        const QImage picture = projection()->picture();
        endProgram();
        QVERIFY(exposure && kept().view.exposure->exposure == *exposure);
        resume();
        settle();
        QVERIFY(document().exposure() == exposure);
        QVERIFY(document().pose().isFitted);
        QVERIFY(changed(projection()->picture(), picture) < 0.001);
        auto *overlay = projection()->findChild<QWidget *>("projectionOverlay");
        const QImage shown = overlay->grab().toImage();
        // Another view and back gives the same overlay.
        const ui::Pose pose = document().pose();
        document().setPose(turned());
        const QImage other = overlay->grab().toImage();
        document().setPose(pose);
        QVERIFY(changed(overlay->grab().toImage(), other) > 0.0);
        QVERIFY(changed(overlay->grab().toImage(), shown) == 0.0);
    }

    // The unpacked files are deleted: all archives of the series are opened again.
    void studiesFromArchivesAreResumed() {
        QStringList halves;
        for (const char *const half : {"IM000", "IM00[1-8]"}) {
            const QString zip = QString::fromStdString((m_folder / "half").string()) +
                                QString::number(halves.size());
            QCOMPARE(QProcess::execute(
                         "bash", {"-c", QString("cd '%1' && python3 -m zipfile -c '%2.zip' %3*")
                                            .arg(headPath(), zip, half)}),
                     0);
            halves << zip + ".zip";
        }
        restart();
        mainWindow().openPaths(halves);
        waitForVolume();
        scene::Scene scene = document().scene();
        scene.look.transferFunction.weights = {0.0, 0.25, 1.0};
        document().setScene(scene);
        QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
        endProgram();
        QStringList opened = kept().files;
        opened.sort();
        halves.sort();
        QCOMPARE(opened, halves);
        resume();
        waitForVolume();
        QCOMPARE(document().volume()->lattice().size().k, 80);
        QVERIFY(document().scene().look == scene.look);
    }

    void aDamagedSessionIsReported() {
        fs::create_directories(m_sessionFile.parent_path());
        std::ofstream(m_sessionFile) << "{\"schema\": \"pellucid-sess";
        restart();
        QVERIFY(!find<QPushButton>("resumeButton")->isVisible());
        const auto &problems = document().problems();
        QCOMPARE(problems.size(), 1U);
        QCOMPARE(problems[0].path, m_sessionFile);
        QVERIFY(problems[0].reason.is(task::because::isNoSession));
    }

    // A home on a disconnected network share, or that of a guest account.
    void aReadOnlyHomeIsReported() {
        fs::create_directory(m_folder / "locked");
        const ReadOnlyFolder locked(m_folder / "locked");
        const auto restore =
            qScopeGuard([before = qgetenv("XDG_DATA_HOME")] { qputenv("XDG_DATA_HOME", before); });
        qputenv("XDG_DATA_HOME", QByteArray::fromStdString((m_folder / "locked/data").string()));
        restart();
        const auto &problems = document().problems();
        QCOMPARE(problems.size(), 1U);
        const QString why = QString::fromStdString(problems[0].reason.english());
        QVERIFY2(why.contains("cannot be written"), qPrintable(why));
        mainWindow().openPaths({headPath()});
        QTRY_VERIFY_WITH_TIMEOUT(document().volume(), patienceMs);
        endProgram();
        QVERIFY(fs::is_empty(m_folder / "locked"));
    }

    void aTerminatedProgramEndsLikeAClosedOne() {
        QProcess program;
        startWorkstation(program, m_folder, {headPath()});
        QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
        program.terminate();
        QVERIFY(program.waitForFinished(patienceMs));
        QCOMPARE(program.exitStatus(), QProcess::NormalExit);
        QCOMPARE(program.exitCode(), 0);
        QVERIFY(kept().hasEnded);
    }

    // Files from an archive contain patient data.
    void theNextProgramRemovesWhatAKilledOneUnpacked() {
        const QString zip = QString::fromStdString((m_folder / "study.zip").string());
        QProcess packer;
        packer.setWorkingDirectory(headPath());
        packer.start("python3", {"-m", "zipfile", "-c", zip, "."});
        QVERIFY(packer.waitForFinished() && packer.exitCode() == 0);
        const fs::path sessions = m_folder / "cache" / "pellucid" / "sessions";
        QProcess program;
        startWorkstation(program, m_folder, {zip});
        // A folder counts once it has contents: before, it has no lock, and a cleanup may take it.
        const auto unpacked = [&] {
            std::error_code ignored;
            int count = 0;
            for (const auto &entry : fs::directory_iterator(sessions, ignored))
                count += fs::is_directory(entry.path() / "files", ignored) ? 1 : 0;
            return count;
        };
        QTRY_VERIFY_WITH_TIMEOUT(unpacked() == 1, patienceMs);
        // Those of a running program stay.
        files::removeAbandonedSessionFolders();
        QCOMPARE(unpacked(), 1);
        program.kill();
        QVERIFY(program.waitForFinished(patienceMs));
        files::removeAbandonedSessionFolders();
        QVERIFY(fs::is_empty(sessions));
    }

private:
    // Starts the program, opens files and waits until the session is kept.
    void keepSessionOf(const QStringList &paths) {
        restart();
        mainWindow().openPaths(paths);
        QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
    }
    // Starts the program and resumes the last session.
    void resume() {
        restart();
        mainWindow().reopening().resume();
    }

    // The session file of the first program; a second one has its own.
    bool hasSession() const { return fs::exists(m_sessionFile); }
    ui::Session kept() const { return ui::sessionFromJson(readText(m_sessionFile)); }

    fs::path m_sessionFile;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::RecoveryTest>(argc, argv);
}

#include "recovery_test.moc"
