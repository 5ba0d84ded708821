// SPDX-License-Identifier: GPL-3.0-or-later
// Imports into the study library, and removals, survive killed programs, full disks and missing
// files.
#include <QtTest>

#include <csignal>
#include <fstream>
#include <random>
#include <string_view>
#include <sys/resource.h>

#include "core/task/error.h"
#include "tests/ui/library/library_folder.h"
#include "ui/library/import_studies.h"
#include "ui/studies/reasons.h"
#include "ui/studies/study_source.h"

namespace pellucid {

namespace fs = std::filesystem;
using namespace test;
using namespace ui;

namespace {

constexpr int patienceMs = 240000; // sanitized, beside others

} // namespace

class ImportFaultsTest : public LibraryFolder {
    Q_OBJECT
private slots:
    void initTestCase() { writeHead(); }

    void aCancelledImportLeavesNothing() {
        const LibraryPlace at = place("cancelled");
        std::stop_source stop;
        // Half way: some files are copied already.
        const task::Progress progress(stop.get_token(), [&](double done) {
            if (done > 0.75)
                stop.request_stop();
        });
        QVERIFY_EXCEPTION_THROWN(
            importStudies(at, {{m_folder / "head"}, ImportMode::copy}, progress), task::Cancelled);
        QCOMPARE(count(Library(at)), 0);
        QCOMPARE(filesBelow(at.copiesFolder()), 0);
    }

    // The program is killed after the study has left the list, before its copies are removed.
    void aKilledRemovalLeavesNothing() {
        const LibraryPlace at = place("removal");
        importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {});
        QCOMPARE(filesBelow(at.copiesFolder()), 20);
        QCOMPARE(QProcess::execute(QCoreApplication::applicationFilePath(),
                                   {"--remove", QString::fromStdString(at.folder.string())}),
                 0);
        Library library(openLibrary(at.folder).place);
        QCOMPARE(count(library), 0);
        QCOMPARE(filesBelow(at.copiesFolder()), 22); // their names, and a lock
        removeAbandonedImports(library, LeftCopies::removed);
        QCOMPARE(filesBelow(at.copiesFolder()), 0);
    }

    // The study has left the list, but removing its copies fails: the next program does it.
    void aRemovalThatFailsIsTakenUpAgain() {
        const LibraryPlace at = place("failed removal");
        importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {});
        Library library(at);
        removeStudy(library, library.find("", StudyOrder::byName, 0, 1).studies.at(0));
        QCOMPARE(filesBelow(at.copiesFolder()), 22); // their names, and a lock
        removeAbandonedImports(library, LeftCopies::removed);
        QCOMPARE(filesBelow(at.copiesFolder()), 0);
    }

    // Whenever an import is killed, the study is there with all its files or not at all, and no
    // other file is left.
    void aKilledImportIsDoneOrLeavesNothing() {
        std::mt19937 random(11);
        const auto import = [&](const LibraryPlace &at, QProcess &program) {
            program.start(QCoreApplication::applicationFilePath(),
                          {"--import", QString::fromStdString(at.folder.string()),
                           QString::fromStdString((m_folder / "head").string())});
            return program.waitForStarted();
        };
        QElapsedTimer clock;
        clock.start();
        QProcess whole;
        QVERIFY(import(place("whole"), whole) && whole.waitForFinished(patienceMs));
        auto wholeMs = double(clock.elapsed());
        int killed = 0, done = 0, named = 0;
        for (int round = 0; round < 40; ++round) {
            const LibraryPlace at = place("killed" + std::to_string(round));
            { const Library empty(at); } // creates the tables
            QProcess program;
            QVERIFY(import(at, program));
            // The copies are made in the second half of it.
            clock.start();
            program.waitForFinished(int(wholeMs * double(40 + random() % 70) / 100.0));
            const bool isRunning = program.state() == QProcess::Running;
            killed += isRunning ? 1 : 0;
            // The time varies with the load of the machine.
            wholeMs = isRunning ? 1.05 * wholeMs : double(clock.elapsed());
            program.kill();
            program.waitForFinished();
            std::error_code none;
            for (const auto &entry : fs::directory_iterator(at.copiesFolder() / "incoming", none))
                named += fs::exists(entry.path() / "names") ? 1 : 0;
            OpenedLibrary opened = openLibrary(at.folder);
            QVERIFY(!opened.wasDamaged && !opened.place.inMemory);
            Library library(opened.place);
            removeAbandonedImports(library, LeftCopies::removed);
            const int studies = count(library);
            done += studies;
            QCOMPARE(filesBelow(at.copiesFolder()), 20 * studies);
            if (studies > 0) {
                const StudyFacts study = library.find("", StudyOrder::byName, 0, 1).studies.at(0);
                const VolumeFacts v = library.volumes(study).at(0);
                const auto loaded = librarySource(study, v, library.files(study, v)).load({}, {});
                QCOMPARE(loaded.volume.lattice().size().k, 20);
            }
        }
        qInfo("%d of 40 imports were killed, %d with copies that had names; %d were done", killed,
              named, done);
        QVERIFY(killed > 5 && done > 0);
    }

    // The program is killed when copies have their names but no row yet.
    void copiesWithoutARowAreRemovedByTheNextProgram() {
        const LibraryPlace at = place("journal");
        importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {});
        const fs::path abandoned = [&] {
            files::SessionFolder folder(at.incomingFolder());
            folder.setAbandoned(true);
            return folder.path();
        }();
        std::ofstream names(abandoned / "names");
        for (const auto &entry : fs::recursive_directory_iterator(at.copiesFolder()))
            if (entry.path().extension() == ".dcm")
                names << entry.path().string() << "\n"; // these have rows
        const fs::path orphan = at.copiesFolder() / "series" / "orphan.dcm";
        const fs::path other = m_folder / "other.dcm"; // no copy at all
        for (const fs::path &path : {orphan, other}) {
            fs::create_directories(path.parent_path());
            std::ofstream(path) << "x";
            names << path.string() << "\n";
        }
        names.close();
        Library library(at);
        removeAbandonedImports(library, LeftCopies::removed);
        QVERIFY(!fs::exists(abandoned));
        QVERIFY(!fs::exists(orphan));
        QVERIFY(fs::exists(other));
        QCOMPARE(filesBelow(at.copiesFolder()), 20);
    }

    // First the copies do not fit, then the list.
    void aFullDiskLeavesTheLibraryAsItWas() {
        const LibraryPlace at = place("full");
        Library(at).put(many(3, 2));
        const auto isRefused = [&](auto work) {
            rlimit before{};
            getrlimit(RLIMIT_FSIZE, &before);
            const auto fill = [&](rlim_t bytes) {
                const rlimit small{bytes, before.rlim_max};
                setrlimit(RLIMIT_FSIZE, &small);
            };
            bool refused = false;
            try {
                work(fill);
            } catch (const task::Error &error) {
                refused = error.code() == task::ErrorCode::output;
            }
            setrlimit(RLIMIT_FSIZE, &before);
            return refused && count(Library(at)) == 3 && filesBelow(at.copiesFolder()) == 0 &&
                   !openLibrary(at.folder).wasDamaged;
        };
        std::signal(SIGXFSZ, SIG_IGN);
        QVERIFY(isRefused([&](auto fill) {
            const task::Progress progress({}, [&](double done) {
                if (done > 0.75) // half way
                    fill(1500);
            });
            importStudies(at, {{m_folder / "head"}, ImportMode::copy}, progress);
        }));
        QVERIFY(isRefused([&](auto fill) {
            fill(fs::file_size(at.listFile()));
            Library(at).put(many(200, 50));
        }));
        Library(at).put(many(5, 2)); // and works again
        QCOMPARE(count(Library(at)), 5);
    }

    void filesThatAreGoneAreNamed() {
        const fs::path folder = m_folder / "going";
        fs::copy(m_folder / "head", folder);
        const LibraryPlace at = place("gone");
        importStudies(at, {{folder}, ImportMode::refer}, {});
        Library library(at);
        const StudyFacts study = library.find("", StudyOrder::byName, 0, 10).studies.at(0);
        const VolumeFacts v = library.volumes(study)[0];
        const auto files = library.files(study, v);
        fs::remove(folder / "IM0001.dcm"); // the end of the stack
        const auto loaded = librarySource(study, v, files).load({}, {});
        QCOMPARE(loaded.volume.lattice().size().k, 19);
        QVERIFY(loaded.skipped.at(0).reason.is(task::because::isGone));
        fs::remove_all(folder);
        try {
            librarySource(study, v, files).load({}, {});
            QFAIL("loaded what is not there");
        } catch (const task::Error &error) {
            QCOMPARE(error.code(), task::ErrorCode::unusable);
            QCOMPARE(error.path(), folder);
        }
    }
};

} // namespace pellucid

// Runs the tests, or as the program to be killed: --import LIBRARY PATH, --remove LIBRARY.
int main(int argc, char **argv) {
    QCoreApplication application(argc, argv);
    if (argc == 4 && std::string_view(argv[1]) == "--import") {
        pellucid::ui::importStudies({argv[2]}, {{argv[3]}, pellucid::ui::ImportMode::copy}, {});
        return 0;
    }
    if (argc == 3 && std::string_view(argv[1]) == "--remove") {
        pellucid::ui::Library library({argv[2]});
        const auto study = library.find("", pellucid::ui::StudyOrder::byName, 0, 1).studies.at(0);
        const auto removal = pellucid::ui::removeStudy(library, study);
        std::_Exit(removal.copies.empty() ? 1 : 0);
    }
    pellucid::ImportFaultsTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "import_faults_test.moc"
