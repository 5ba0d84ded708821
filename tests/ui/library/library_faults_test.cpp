// SPDX-License-Identifier: GPL-3.0-or-later
// The list of the study library survives damage by disks, killed rebuilds and read-only folders.
#include <QtTest>

#include <array>
#include <fstream>
#include <random>
#include <string_view>

#include "core/task/error.h"
#include "tests/support/read_only_folder.h"
#include "tests/ui/library/library_folder.h"
#include "ui/library/import_studies.h"
#include "ui/library/reasons.h"
#include "ui/library/study_library.h"

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
                task::because::listedForThisRun(task::because::isALibraryOfAnotherVersion));
        Library memory(opened.place);
        memory.put({librarySeries(2, "Roe^Richard", "Knee", 1)});
        QCOMPARE(count(Library(opened.place), "richard"), 1); // shared between connections
        QVERIFY(fs::last_write_time(at.listFile()) == written);
    }

    // A rebuild may be killed while it reads or writes: the damaged list stays until the new one is
    // complete.
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
            QVERIFY(opened.mayLackCopies); // until they are searched for
        }
        qInfo("%d of 25 rebuilds were killed; %d of 1500 studies were read each time", killed,
              readable);
        QVERIFY(killed > 5);
    }

    // A program leaves this state if it is killed before it has searched for the copies.
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

    // The list is empty or missing, as after a power cut or tidying up.
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

    // What the command line retrieves before the first start is no sign of a lost list.
    void filesThatWaitToBeListedAreNoLostList() {
        const LibraryPlace at = place("retrieved");
        std::vector<fs::path> unlisted;
        const auto retrieve = [&](const std::string &study) {
            const fs::path series = at.copiesFolder() / study / (study + ".1");
            fs::create_directories(series);
            for (const auto &entry : fs::directory_iterator(m_folder / "head")) {
                fs::copy_file(entry.path(), series / entry.path().filename());
                unlisted.push_back(series / entry.path().filename());
            }
        };
        retrieve("1.2.3");
        retrieve("1.2.4");
        const OpenedLibrary first = openLibrary(at.folder, unlisted);
        QVERIFY(first.notices.empty());
        QVERIFY(!first.mayLackCopies);
        QVERIFY(!fs::exists(at.rebuiltMark()));
        // One of them has been listed since: then a list is lost.
        fs::remove(at.listFile());
        std::erase_if(unlisted, [](const fs::path &file) {
            return file.string().find("/1.2.4/") != std::string::npos;
        });
        const OpenedLibrary later = openLibrary(at.folder, unlisted);
        QVERIFY(later.mayLackCopies);
        QCOMPARE(later.notices.size(), std::size_t(1));
        QVERIFY(later.notices[0].reason.is(task::because::libraryWasEmpty));
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
        // The second program found the list complete.
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
        QCOMPARE(seen(), 3); // the new one is not there yet
        Library(at).put({many(2, 2).at(1), many(2, 2).at(0)});
        QSignalSpy changed(&open, &StudyLibrary::changed);
        QCOMPARE(seen(), 2);
        const StudyFacts found = open.find("doe1", StudyOrder::byName, 0, 10).studies.at(0);
        QVERIFY(found.libraryId != listed.libraryId);
        QTRY_COMPARE(changed.size(), 1); // views are notified
        // The numbers are different now, but entries listed before still mean the same studies.
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
        // A damaged list is read and stays as it is.
        {
            const LibraryPlace broken = place("read-only-damaged");
            Library(broken).put(many(400, 20));
            damage(broken.listFile());
            const ReadOnlyFolder lockedAsWell(broken.folder);
            const OpenedLibrary read = openLibrary(broken.folder);
            QVERIFY(read.place.inMemory && read.wasDamaged);
            QVERIFY(read.readable.size() > 100);
            const QString notice = QString::fromStdString(read.notices.at(0).reason.english());
            QVERIFY2(notice.contains("cannot be written") &&
                         notice.contains("only until the program closes"),
                     qPrintable(notice));
        }
        // The program starts although the list of copies is missing.
        {
            const LibraryPlace listless = place("read-only-listless");
            importStudies(listless, {{m_folder / "head"}, ImportMode::copy}, {});
            fs::remove(listless.listFile());
            const ReadOnlyFolder lockedAsWell(listless.folder);
            QVERIFY(openLibrary(listless.folder).place.inMemory);
        }
        // A list that cannot be created is kept in memory for this run.
        const OpenedLibrary run = openLibrary(empty.folder);
        QVERIFY(run.place.inMemory);
        QVERIFY(run.notices.at(0).reason.is(task::because::listedForThisRun));
    }
};

} // namespace pellucid

// Runs the tests, or as the program to be killed: --open LIBRARY.
int main(int argc, char **argv) {
    QCoreApplication application(argc, argv);
    if (argc == 3 && std::string_view(argv[1]) == "--open")
        return pellucid::ui::openLibrary(argv[2]).wasDamaged ? 0 : 1;
    pellucid::LibraryFaultsTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "library_faults_test.moc"
