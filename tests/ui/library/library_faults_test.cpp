// SPDX-License-Identifier: GPL-3.0-or-later
// What the world does to the study library: programs are killed, discs are full or fail, files go.
#include <QtTest>

#include <array>
#include <csignal>
#include <fstream>
#include <random>
#include <string_view>
#include <sys/resource.h>

#include "core/task/error.h"
#include "tests/support/read_only_folder.h"
#include "tests/ui/library/library_folder.h"
#include "ui/library/import_studies.h"
#include "ui/library/study_library.h"
#include "ui/studies/study_source.h"

namespace pellucid {

namespace fs = std::filesystem;
using namespace test;
using namespace ui;

namespace {

constexpr int patienceMs = 240000; // sanitized, beside others

// A stretch in the middle is overwritten, as a failing disk does.
void damage(const fs::path &file) {
    const auto bytes = fs::file_size(file);
    std::fstream list(file, std::ios::in | std::ios::out | std::ios::binary);
    list.seekp(std::streamoff(bytes / 2));
    const std::string noise(40000, '\xa5');
    list.write(noise.data(), std::streamsize(noise.size()));
}

} // namespace

class LibraryFaultsTest : public LibraryFolder {
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

    // Off the list, and killed before its copies were removed.
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

    // Whenever an import is killed: the study is there with all its files, or not at all, and
    // nothing else is.
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
        const auto wholeMs = unsigned(clock.elapsed());
        int killed = 0, done = 0, named = 0;
        for (int round = 0; round < 40; ++round) {
            const LibraryPlace at = place("killed" + std::to_string(round));
            { const Library empty(at); } // its tables are there
            QProcess program;
            QVERIFY(import(at, program));
            // The copies are made in the second half of it.
            program.waitForFinished(int(wholeMs * (40 + random() % 70) / 100));
            killed += program.state() == QProcess::Running ? 1 : 0;
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

    // Copies that have their names but no row yet when the program is killed.
    void copiesWithoutARowAreRemovedByTheNextProgram() {
        const LibraryPlace at = place("journal");
        importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {});
        const fs::path abandoned = at.copiesFolder() / "incoming" / "abcdef";
        fs::create_directories(abandoned);
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
        std::ofstream(abandoned.string() + ".lock") << "";
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

    void aDamagedListIsRebuiltFromWhatCanBeRead() {
        const LibraryPlace at = place("damaged");
        Library(at).put(many(400, 20));
        const auto bytes = fs::file_size(at.listFile());
        damage(at.listFile());
        const OpenedLibrary opened = openLibrary(at.folder);
        QVERIFY(opened.wasDamaged);
        QVERIFY(!opened.place.inMemory);
        QCOMPARE(opened.notices.size(), std::size_t(1));
        QCOMPARE(fs::file_size(opened.notices[0].path), bytes); // the old file is kept
        const Library library(opened.place);
        const int saved = count(library);
        qInfo("%d of 400 studies were read", saved);
        QVERIFY(saved > 100);
        const StudyFacts study = library.find("", StudyOrder::byName, 0, 1).studies.at(0);
        QVERIFY(library.volumes(study).at(0).files > 0);
        QVERIFY(openLibrary(at.folder).notices.empty());
    }

    void aFileThatIsNoListIsKeptAndReplaced() {
        const LibraryPlace at = place("garbage");
        std::ofstream(at.listFile()) << "this is not what it was and never will be again, is it?";
        const OpenedLibrary opened = openLibrary(at.folder);
        QVERIFY(opened.wasDamaged);
        QCOMPARE(opened.notices.size(), std::size_t(1));
        QVERIFY(fs::exists(opened.notices[0].path));
        QCOMPARE(count(Library(opened.place)), 0);
    }

    void aListOfANewerProgramIsLeftAlone() {
        const LibraryPlace at = place("newer");
        Library(at).put({librarySeries(1, "Doe^Jane", "Thorax", 1)});
        {
            std::fstream list(at.listFile(), std::ios::in | std::ios::out | std::ios::binary);
            list.seekp(60); // SQLite's user version
            list.write("\0\0\0\7", 4);
        }
        const auto written = fs::last_write_time(at.listFile());
        const OpenedLibrary opened = openLibrary(at.folder);
        QVERIFY(opened.place.inMemory);
        QVERIFY(opened.notices.at(0).reason ==
                task::because::listedForThisRun(task::because::isANewerLibrary));
        Library memory(opened.place);
        memory.put({librarySeries(2, "Roe^Richard", "Knee", 1)});
        QCOMPARE(count(Library(opened.place), "richard"), 1); // shared between connections
        QVERIFY(fs::last_write_time(at.listFile()) == written);
    }

    // Its reading and its new list alike: the damaged list is there until the new one is whole.
    void aKilledRebuildLosesNothing() {
        const LibraryPlace at = place("rebuild");
        Library(at).put(many(1500, 20));
        damage(at.listFile());
        const fs::path damaged = m_folder / "damaged.sqlite";
        fs::rename(at.listFile(), damaged);
        const auto begin = [&](QProcess &program) {
            fs::remove_all(at.folder);
            fs::create_directories(at.folder);
            fs::copy_file(damaged, at.listFile());
            program.start(QCoreApplication::applicationFilePath(),
                          {"--open", QString::fromStdString(at.folder.string())});
            return program.waitForStarted();
        };
        QElapsedTimer clock;
        clock.start();
        QProcess whole;
        QVERIFY(begin(whole) && whole.waitForFinished(patienceMs));
        const auto wholeMs = unsigned(clock.elapsed());
        const int readable = count(Library(at));
        QVERIFY(readable > 300);
        std::mt19937 random(13);
        int killed = 0;
        for (int round = 0; round < 25; ++round) {
            QProcess program;
            QVERIFY(begin(program));
            program.waitForFinished(int(wholeMs * (20 + random() % 80) / 100));
            killed += program.state() == QProcess::Running ? 1 : 0;
            program.kill();
            program.waitForFinished();
            const OpenedLibrary opened = openLibrary(at.folder);
            QVERIFY(!opened.place.inMemory);
            QCOMPARE(count(Library(opened.place)), readable);
            QVERIFY(opened.mayLackCopies); // till they are looked for
        }
        qInfo("%d of 25 rebuilds were killed; %d of 1500 studies were read each time", killed,
              readable);
        QVERIFY(killed > 5);
    }

    // As a program that was killed before it had looked for them leaves it.
    void copiesWithoutRowsAreListedAfterARebuild() {
        const LibraryPlace at = place("relisted");
        importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {});
        Library(at).remove(Library(at).find("", StudyOrder::byName, 0, 1).studies.at(0));
        std::ofstream(at.rebuiltMark()) << "";
        OpenedLibrary opened = openLibrary(at.folder);
        QVERIFY(opened.mayLackCopies && !opened.wasDamaged);
        QCOMPARE(relistCopies(at, {}).files, 20);
        QCOMPARE(count(Library(at)), 1);
        QVERIFY(!openLibrary(at.folder).mayLackCopies);
    }

    // As after a power cut, or by a hand that tidied up.
    void copiesWithoutAListAreListedAgain() {
        const LibraryPlace at = place("listless");
        importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {});
        for (const bool isThere : {true, false}) {
            if (isThere)
                fs::resize_file(at.listFile(), 0);
            else
                fs::remove(at.listFile());
            const OpenedLibrary opened = openLibrary(at.folder);
            QVERIFY(opened.mayLackCopies);
            QCOMPARE(opened.notices.size(), std::size_t(1));
            relistCopies(at, {});
            QCOMPARE(count(Library(at)), 1);
        }
    }

    // The list is gone from them, the removal of the copies fails: the next program does it.
    void aRemovalThatFailsIsTakenUpAgain() {
        const LibraryPlace at = place("failed removal");
        importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {});
        Library library(at);
        removeStudy(library, library.find("", StudyOrder::byName, 0, 1).studies.at(0));
        QCOMPARE(filesBelow(at.copiesFolder()), 22); // their names, and a lock
        removeAbandonedImports(library, LeftCopies::removed);
        QCOMPARE(filesBelow(at.copiesFolder()), 0);
    }

    void twoProgramsRebuildOneListOnce() {
        const LibraryPlace at = place("two");
        Library(at).put(many(1500, 20));
        damage(at.listFile());
        std::array<QProcess, 2> programs;
        for (QProcess &program : programs)
            program.start(QCoreApplication::applicationFilePath(),
                          {"--open", QString::fromStdString(at.folder.string())});
        for (QProcess &program : programs)
            QVERIFY(program.waitForFinished(patienceMs));
        // Whoever came second found it whole.
        QCOMPARE(programs[0].exitCode() + programs[1].exitCode(), 1);
        QVERIFY(count(Library(at)) > 300);
        QVERIFY(!openLibrary(at.folder).wasDamaged);
    }

    void aListThatAnotherProgramReplacesIsReadFromThen() {
        const auto before = qgetenv("XDG_DATA_HOME");
        const auto restored = qScopeGuard([&] { qputenv("XDG_DATA_HOME", before); });
        qputenv("XDG_DATA_HOME", QByteArray::fromStdString((m_folder / "replaced").string()));
        const LibraryPlace at{m_folder / "replaced" / "pellucid" / "library"};
        StudyLibrary open;
        Library(at).put(many(3, 2));
        const auto seen = [&] { return open.find("", StudyOrder::byName, 0, 10).count; };
        QCOMPARE(seen(), 3);
        const StudyFacts listed = open.find("doe1", StudyOrder::byName, 0, 10).studies.at(0);
        const fs::path damaged = at.folder / "damaged.sqlite";
        fs::rename(at.listFile(), damaged);
        QCOMPARE(seen(), 3); // the new one is to come
        Library(at).put({many(2, 2).at(1), many(2, 2).at(0)});
        QSignalSpy changed(&open, &StudyLibrary::changed);
        QCOMPARE(seen(), 2);
        const StudyFacts found = open.find("doe1", StudyOrder::byName, 0, 10).studies.at(0);
        QVERIFY(found.libraryId != listed.libraryId);
        QTRY_COMPARE(changed.size(), 1); // whoever lists them is told
        // Numbers are others now; what was listed before is what is meant.
        QCOMPARE(open.volumes(listed).at(0).seriesUid, open.volumes(found).at(0).seriesUid);
        open.remove(listed);
        QCOMPARE(count(Library(at)), 1);
        QCOMPARE(count(Library(at), "doe0"), 1);
    }

    void aReadOnlyFolderIsReadAndKeepsWhatItHas() {
        const LibraryPlace at = place("read-only"), empty = place("read-only-empty");
        Library(at).put(many(3, 2));
        const ReadOnlyFolder locked(at.folder), lockedToo(empty.folder);
        const OpenedLibrary opened = openLibrary(at.folder);
        QVERIFY(!opened.place.inMemory && !opened.wasDamaged);
        Library library(opened.place);
        QCOMPARE(count(library), 3);
        QVERIFY_EXCEPTION_THROWN(library.put(many(5, 2)), task::Error);
        QVERIFY_EXCEPTION_THROWN(importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {}),
                                 task::Error);
        QCOMPARE(count(library), 3);
        // A damaged one is read, and stays as it is.
        {
            const LibraryPlace broken = place("read-only-damaged");
            Library(broken).put(many(400, 20));
            damage(broken.listFile());
            const ReadOnlyFolder lockedAsWell(broken.folder);
            const OpenedLibrary read = openLibrary(broken.folder);
            QVERIFY(read.place.inMemory && read.wasDamaged);
            QVERIFY(read.readable.size() > 100);
            const QString said = QString::fromStdString(read.notices.at(0).reason.english());
            QVERIFY2(said.contains("cannot be written") && said.contains("this run only"),
                     qPrintable(said));
        }
        // Copies whose list is gone are no reason not to begin.
        {
            const LibraryPlace listless = place("read-only-listless");
            importStudies(listless, {{m_folder / "head"}, ImportMode::copy}, {});
            fs::remove(listless.listFile());
            const ReadOnlyFolder lockedAsWell(listless.folder);
            QVERIFY(openLibrary(listless.folder).place.inMemory);
        }
        // One that could not be made is for this run.
        const OpenedLibrary run = openLibrary(empty.folder);
        QVERIFY(run.place.inMemory);
        QVERIFY(run.notices.at(0).reason.is(task::because::listedForThisRun));
    }
};

} // namespace pellucid

// The test itself, or, to be killed: --import LIBRARY PATH, --remove LIBRARY, --open LIBRARY.
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
    if (argc == 3 && std::string_view(argv[1]) == "--open")
        return pellucid::ui::openLibrary(argv[2]).wasDamaged ? 0 : 1;
    pellucid::LibraryFaultsTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "library_faults_test.moc"
