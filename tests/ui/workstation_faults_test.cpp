// SPDX-License-Identifier: GPL-3.0-or-later
// Unusable files, faults, too little memory: the program reports them and continues.
#include "tests/ui/workstation.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <thread>

#include <QLabel>
#include <QListWidget>
#include <QProcess>
#include <QPushButton>
#include <QStatusBar>

#include "app/exit_code.h"
#include "core/confined/protection.h"
#include "core/platform/confinement.h"
#include "core/task/error.h"
#include "core/task/reasons.h"
#include "tests/support/little_memory.h"
#include "ui/document/commands.h"
#include "ui/window/workstation.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

namespace {

// The reason in the first signal.
const task::Reason &reasonOf(const QSignalSpy &failures) {
    return *static_cast<const task::Reason *>(failures[0][0].constData());
}

} // namespace

class WorkstationFaultsTest : public Workstation {
    Q_OBJECT
private slots:
    void init() {}

    void problemsAreListedAndNothingPopsUp() {
        restart();
        const std::string file = (m_folder / "notes.txt").string();
        std::ofstream(file) << "this is a letter to the patient and no image at all";
        drop(mainWindow(), {QUrl::fromLocalFile(QString::fromStdString(file))});
        auto *list = find<QListWidget>("problemList");
        QTRY_VERIFY_WITH_TIMEOUT(list->count() == 1 && !jobs().isRunning(), patienceMs);
        QVERIFY(list->item(0)->text().contains("not a DICOM file"));
        QVERIFY(QApplication::activeModalWidget() == nullptr);
        drop(mainWindow(), {QUrl::fromLocalFile("/no/such/place")});
        QTRY_VERIFY_WITH_TIMEOUT(
            list->count() == 2 && list->item(1)->text().contains("does not exist"), patienceMs);
        QVERIFY(find<QWidget>("startPage")->isVisible());
        // The former problems are still listed, once, until the user clears the list.
        drop(mainWindow(), {QUrl::fromLocalFile("/no/such/place")});
        QTRY_VERIFY(!jobs().isRunning());
        QCOMPARE(list->count(), 2);
        QTest::mouseClick(find<QPushButton>("clearProblemsButton"), Qt::LeftButton);
        QVERIFY(!list->isVisible());
    }

    // A study that cannot be loaded gives way to the one that was shown.
    void aFailedLoadReturnsToTheFormerStudy() {
        restart();
        open(headPath());
        const auto shown = document().currentSource();
        const QImage before = projection()->picture();
        const std::string file = (m_folder / "damaged.nrrd").string();
        std::ofstream(file) << "NRRD0004\ntype: short\ndimension: 3\nsizes: 9 9 9\n"
                               "endian: little\nencoding: gzip\n\nno gzip stream at all";
        drop(mainWindow(), {QUrl::fromLocalFile(QString::fromStdString(file))});
        auto *list = find<QListWidget>("problemList");
        QTRY_VERIFY_WITH_TIMEOUT(list->count() == 1 && document().volume() &&
                                     document().currentSource() == shown,
                                 patienceMs);
        QVERIFY(list->item(0)->text().contains("damaged or truncated"));
        settle();
        QVERIFY(changed(before, projection()->picture()) < 0.001);
    }

    // A load that fails writes nothing into the picture of another study.
    void aFailedLoadLeavesThePictureClear() {
        restart();
        open(headPath());
        const auto middle = [&] {
            const QRect all = projection()->rect();
            return projection()
                ->grab(all.adjusted(all.width() / 4, all.height() / 4, -all.width() / 4,
                                    -all.height() / 4))
                .toImage();
        };
        const QImage before = middle();
        drop(mainWindow(), {QUrl::fromLocalFile("/no/such/place")});
        QTRY_VERIFY_WITH_TIMEOUT(
            find<QListWidget>("problemList")->count() == 1 && !jobs().isRunning(), patienceMs);
        QVERIFY(mainWindow().statusBar()->currentMessage().contains("place: does not exist"));
        settle();
        QCOMPARE(changed(before, middle()), 0.0);
    }

    // On a system that cannot confine the helpers, the window says so.
    void aMissingProtectionIsVisible() {
        restart();
        auto *const label = find<QLabel>("unprotectedLabel");
        QVERIFY(!label->isVisible());
        std::thread([] { confined::noteProtection("helpers", platform::limitsHold); }).join();
        QTRY_VERIFY(label->isVisible());
        QVERIFY(label->toolTip().contains("hostile file"));
        QVERIFY(find<QListWidget>("problemList")->item(0)->text().contains("cannot confine"));
    }

    // Any exception on any thread is reported, and the program still works.
    void exceptionsAreReportedAndTheProgramGoesOn() {
        ui::Workstation program;
        QSignalSpy failures(static_cast<ui::Application *>(qApp), &ui::Application::failed);
        QTimer::singleShot(0, &program, [] { throw std::bad_alloc(); });
        QTRY_COMPARE(failures.size(), 1);
        QVERIFY(reasonOf(failures).is(task::because::notEnoughMemory));
        ui::JobRunner &jobs = program.bench().study.jobs;
        QSignalSpy failed(&jobs, &ui::JobRunner::failed);
        const std::vector<std::pair<std::function<void()>, task::Reason>> faults{
            {[] { throw std::bad_alloc(); }, task::because::notEnoughMemory},
            {[] { throw std::out_of_range("vector"); }, task::because::faultOfTheProgram},
            {[] { throw 7; }, task::because::faultOfTheProgram},
            {[] { throw task::Error(task::ErrorCode::unusable, task::because::isEmpty, "/a"); },
             task::because::isEmpty}};
        for (const auto &[fault, reason] : faults) {
            failed.clear();
            jobs.start("fault", [fault = fault](const ui::Job &) { fault(); });
            QTRY_COMPARE(failed.size(), 1);
            QVERIFY(reasonOf(failed) == reason);
            QVERIFY(!jobs.isRunning());
        }
        program.window().openPaths({headPath()});
        QTRY_VERIFY_WITH_TIMEOUT(program.bench().study.document.volume() &&
                                     !program.bench().study.document.isPreview(),
                                 patienceMs);
    }

#ifndef PELLUCID_SANITIZED // sanitizers reserve terabytes
    void aFailedPreparationIsReportedAndRepeatedByF5() {
        restart();
        open(headPath());
        {
            const test::LittleMemory little(2); // too little for a thread
            ui::editScene(document(), "Tolerance", ui::noDrag,
                          [](scene::Scene &scene) { scene.tolerance = 1e-5; });
            QTRY_VERIFY(!jobs().isRunning());
            QCOMPARE(projection()->frames().planState(), ui::PlanState::failed);
            QCOMPARE(document().problems().size(), 1U);
        }
        QTest::keyClick(&mainWindow(), Qt::Key_F5);
        QCOMPARE(projection()->frames().planState(), ui::PlanState::underway);
        settle();
        QCOMPARE(projection()->frames().planState(), ui::PlanState::holds);
    }

    // A limit too low to start with is reported before libraries that need more crash.
    void aLowMemoryLimitIsReportedInOneLine() {
        for (const char *kilobytes : {"300000", "400000", "600000", "1000000"}) {
            QProcess program;
            program.start("/bin/sh",
                          {"-c", "ulimit -v $0; exec \"$1\"", kilobytes, PELLUCID_WORKSTATION});
            QVERIFY(program.waitForFinished(patienceMs));
            QCOMPARE(program.exitStatus(), QProcess::NormalExit);
            QCOMPARE(program.exitCode(), exitCode(task::ErrorCode::outOfMemory));
            const QByteArray output = program.readAllStandardError();
            QVERIFY2(output.startsWith("pellucid: not enough memory to start") &&
                         output.count('\n') == 1,
                     output.constData());
        }
    }

    // Memory grows in steps from too little to enough: a study opens or a reason is given, and once
    // there is memory, the next one opens.
    void aLackOfMemoryIsReportedAndTheNextStudyOpens() {
        const fs::path large = m_folder / "large";
        dicom::writeCtSeries(large,
                             phantom::makePhantom(phantom::Kind::head,
                                                  phantom::phantomLattice(
                                                      phantom::Kind::head,
                                                      {.size = volume::GridSize{256, 256, 128}})),
                             {}, dicom::TransferSyntax::explicitLittle);
        ui::Workstation program;
        ui::Document &document = program.bench().study.document;
        ui::JobRunner &jobs = program.bench().study.jobs;
        QSignalSpy failed(&jobs, &ui::JobRunner::failed);
        QSignalSpy failures(static_cast<ui::Application *>(qApp), &ui::Application::failed);
        const auto rests = [&] { return !jobs.isRunning() && !document.isPreview(); };
        const auto slices = [&] {
            return document.volume() ? document.volume()->lattice().size().k : 0;
        };
        program.window().openPaths({headPath()}); // all that is made once is there
        QTRY_VERIFY_WITH_TIMEOUT(document.volume() && rests(), patienceMs);
        auto *const view = program.window().findChild<ui::ProjectionView *>("projectionView");
        int opened = 0, refused = 0;
        for (const std::size_t mb : {5, 10, 40, 80, 120, 160, 240, 320, 480, 640, 960, 1600}) {
            failed.clear();
            failures.clear();
            std::optional<LittleMemory> little(mb);
            program.window().openPaths({QString::fromStdString(large.string())});
            const bool isOver = QTest::qWaitFor(rests, patienceMs);
            // Frames, too.
            (void)QTest::qWaitFor(
                [&] { return view->frames().showsFinalImage() || !failures.isEmpty(); }, 2000);
            little.reset();
            QVERIFY(isOver);
            const bool isOpen = slices() == 128;
            opened += isOpen ? 1 : 0;
            refused += failed.size() + failures.size() > 0 ? 1 : 0;
            for (const auto &failure : failed)
                QCOMPARE(fs::path(failure[1].toString().toStdString()), large);
            QVERIFY2(isOpen || failed.size() + failures.size() > 0,
                     qPrintable(QString::number(mb)));
            program.window().openPaths({headPath()});
            QTRY_VERIFY_WITH_TIMEOUT(slices() == 80 && rests(), patienceMs);
        }
        qInfo("%d opened, %d with a reason", opened, refused);
        QVERIFY(opened > 0 && refused > 0);
    }
#endif
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::WorkstationFaultsTest>(argc, argv);
}

#include "workstation_faults_test.moc"
