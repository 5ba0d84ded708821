// SPDX-License-Identifier: GPL-3.0-or-later
// The study library without a window: what is put in is found, nothing is lost, damage is survived.
#include <QtTest>

#include <csignal>
#include <fstream>
#include <random>
#include <string_view>
#include <sys/resource.h>

#include "core/dicom/write_series.h"
#include "core/phantom/phantom.h"
#include "core/task/error.h"
#include "core/volume/nrrd.h"
#include "tests/support/temporary_folder.h"
#include "ui/library/import_studies.h"
#include "ui/library/library.h"
#include "ui/library/study_list.h"
#include "ui/study_source.h"

namespace pellucid {

namespace fs = std::filesystem;
using namespace ui;

namespace {

LibrarySeries series(int number, const QString &name, const QString &description, int files) {
    LibrarySeries s;
    s.study.patientId = QString("ID%1").arg(number);
    s.study.patientName = name;
    s.study.uid = QString("1.2.%1").arg(number);
    s.study.date = QString("20%1%2%3")
                       .arg(number % 24, 2, 10, QChar('0'))
                       .arg(1 + number % 12, 2, 10, QChar('0'))
                       .arg(1 + number % 28, 2, 10, QChar('0'));
    s.study.description = description;
    VolumeFacts v;
    v.seriesUid = s.study.uid + ".1";
    v.modality = "CT";
    v.description = "Soft kernel";
    v.bodyPart = "CHEST";
    v.seriesNumber = 3;
    v.size = {512, 512, files};
    v.spacingMm = {0.5, 0.5, 1.0};
    v.warnings = {"slice 4 is missing"};
    s.volumes = {v};
    for (int n = 0; n < files; ++n)
        s.files.push_back({"/archive/" + std::to_string(number) + "/" + std::to_string(n) + ".dcm",
                           (v.seriesUid + "." + QString::number(n)).toStdString()});
    return s;
}

std::vector<LibrarySeries> many(int studies, int files) {
    std::vector<LibrarySeries> all;
    for (int n = 0; n < studies; ++n)
        all.push_back(series(n, QString("Doe%1^Jane").arg(n), "Thorax", files));
    return all;
}

int filesBelow(const fs::path &folder) {
    int count = 0;
    std::error_code none;
    for (const auto &entry : fs::recursive_directory_iterator(folder, none))
        count += entry.is_regular_file() ? 1 : 0;
    return count;
}

int count(const Library &library, const QString &search = {}) {
    return library.find(search, StudyOrder::byName, 0, 1).count;
}

double medianMs(std::vector<double> times) {
    std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
    return times[times.size() / 2];
}

} // namespace

class LibraryTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        qputenv("XDG_CACHE_HOME", QByteArray::fromStdString((m_folder / "cache").string()));
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{32, 32, 20}});
        dicom::writeCtSeries(m_folder / "head", phantom::makePhantom(phantom::Kind::head, lattice),
                             {.patientName = "Head^Test"}, dicom::TransferSyntax::explicitLittle);
    }

    void findsByAnyWordWithoutCaseAndAccents() {
        Library library(place("find"));
        library.put({series(1, QString::fromUtf8("Müller^Jörg"), "Thorax", 2),
                     series(2, QString::fromUtf8("王^小明"), "Head", 2),
                     series(3, "Doe^Jane", "Knee", 2)});
        const auto names = [&](const char *search) {
            QStringList found;
            for (const StudyFacts &s :
                 library.find(QString::fromUtf8(search), StudyOrder::byName, 0, 10).studies)
                found << patientText(s);
            return found.join(",");
        };
        QCOMPARE(names("muller"), QString::fromUtf8("Müller Jörg"));
        QCOMPARE(names("JORG thorax"), QString::fromUtf8("Müller Jörg"));
        QCOMPARE(names("小明"), QString::fromUtf8("王 小明"));
        QCOMPARE(names("id3"), QString("Doe Jane"));
        QCOMPARE(names("2003-04-04"), QString("Doe Jane"));
        QCOMPARE(names("20030404"), QString("Doe Jane"));
        QCOMPARE(names("soft").count(','), 2);
        QCOMPARE(names("thorax knee"), QString());
        QCOMPARE(names("100%"), QString()); // no letter is a wildcard
        QCOMPARE(count(library, "soft"), 3);
        QCOMPARE(library.find("", StudyOrder::newestFirst, 0, 1).studies.front().patientName,
                 QString("Doe^Jane"));
    }

    void keepsEverythingThatIsShown() {
        Library library(place("facts"));
        LibrarySeries s = series(1, "Doe^Jane", "Thorax", 3);
        s.volumes[0].thumbnail = QImage(96, 60, QImage::Format_Grayscale8);
        s.volumes[0].thumbnail.fill(77);
        s.volumes[0].tiltDeg = 18.5;
        library.put({s});
        const StudyFacts study = library.find("", StudyOrder::byName, 0, 10).studies.at(0);
        QCOMPARE(study.key(), s.study.key());
        QCOMPARE(study.modalities, QString("CT"));
        const VolumeFacts v = library.volumes(study.libraryId).at(0);
        QCOMPARE(v.key(), s.volumes[0].key());
        QCOMPARE(v.tiltDeg, 18.5);
        QCOMPARE(v.warnings, s.volumes[0].warnings);
        QCOMPARE(v.thumbnail.size(), QSize(96, 60));
        QCOMPARE(qGray(v.thumbnail.pixel(5, 5)), 77);
        QCOMPARE(v.files, 3);
        QCOMPARE(library.files(v.libraryId).size(), std::size_t(3));
        // Again, with another file: in place of what was there.
        s.files.resize(2);
        library.put({s});
        QCOMPARE(count(library), 1);
        QCOMPARE(library.volumes(study.libraryId).size(), std::size_t(1));
        QCOMPARE(library.volumes(study.libraryId)[0].files, 2);
        library.removeCopies(removeStudy(library, study.libraryId).copies);
        QCOMPARE(count(library), 0);
    }

    void aHundredThousandInstancesStaySearchable_data() {
        QTest::addColumn<int>("studies");
        QTest::addColumn<int>("files");
        QTest::newRow("500 studies of 200 instances") << 500 << 200;
        QTest::newRow("100000 studies of one instance") << 100000 << 1;
    }
    void aHundredThousandInstancesStaySearchable() {
        QFETCH(int, studies);
        QFETCH(int, files);
        const LibraryPlace at = place(QString("many%1").arg(studies).toStdString());
        QElapsedTimer clock;
        clock.start();
        Library(at).put(many(studies, files));
        const double put = double(clock.nsecsElapsed()) * 1e-6;
        clock.start();
        const OpenedLibrary opened = openLibrary(at.folder);
        const double open = double(clock.nsecsElapsed()) * 1e-6;
        QVERIFY(opened.notices.empty());
        const Library library(opened.place);
        std::vector<double> times;
        for (const char *search : {"doe77^", "thorax", "jane doe4", "nobody", ""}) {
            const QString words = QString(search).remove('^');
            for (int n = 0; n < 5; ++n) {
                clock.start();
                const StudyPage page = library.find(words, StudyOrder::newestFirst, 0, 200);
                times.push_back(double(clock.nsecsElapsed()) * 1e-6);
                QCOMPARE(int(page.studies.size()), std::min(page.count, 200));
            }
        }
        QCOMPARE(count(library, "nobody"), 0);
        QCOMPARE(count(library), studies);
        clock.start();
        const auto last = library.find("", StudyOrder::newestFirst, studies - 200, 200);
        const double scroll = double(clock.nsecsElapsed()) * 1e-6;
        QCOMPARE(last.studies.size(), std::size_t(200));
        qInfo(
            "put %.0f ms, open and check %.0f ms, search median %.1f ms, worst %.1f ms, last page "
            "%.1f ms",
            put, open, medianMs(times), *std::max_element(times.begin(), times.end()), scroll);
    }

    void importsByReferenceAndByCopy() {
        for (const ImportMode mode : {ImportMode::refer, ImportMode::copy}) {
            const LibraryPlace at = place(mode == ImportMode::copy ? "copy" : "refer");
            const ImportResult result = importStudies(at, {{m_folder / "head"}, mode}, {});
            QCOMPARE(result.series, 1);
            QCOMPARE(result.files, 20);
            Library library(at);
            const StudyFacts study = library.find("head", StudyOrder::byName, 0, 10).studies.at(0);
            const VolumeFacts v = library.volumes(study.libraryId).at(0);
            QVERIFY(!v.thumbnail.isNull());
            QCOMPARE(v.isCopied, mode == ImportMode::copy);
            QCOMPARE(filesBelow(at.copiesFolder()), mode == ImportMode::copy ? 20 : 0);
            // No name of a patient among the names of the copies.
            for (const dicom::InstanceFile &file : library.files(v.libraryId))
                QVERIFY(mode == ImportMode::refer ||
                        file.path.string().find("Head") == std::string::npos);
            const auto loaded = librarySource(study, v, library.files(v.libraryId)).load({}, {});
            QCOMPARE(loaded.volume.lattice().size().k, 20);
            QVERIFY(loaded.skipped.empty());
            library.removeCopies(removeStudy(library, study.libraryId).copies);
            QCOMPARE(filesBelow(at.copiesFolder()), 0);
            QCOMPARE(filesBelow(m_folder / "head"), 20);
        }
    }

    void theRestOfASeriesJoinsWhatIsThere() {
        const fs::path one = m_folder / "disc1", two = m_folder / "disc2";
        fs::create_directories(one);
        fs::create_directories(two);
        int n = 0;
        std::vector<fs::path> files;
        for (const auto &entry : fs::directory_iterator(m_folder / "head"))
            files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path &file : files)
            fs::copy_file(file, (n++ < 10 ? one : two) / file.filename());
        const LibraryPlace at = place("discs");
        importStudies(at, {{one}, ImportMode::copy}, {});
        importStudies(at, {{two}, ImportMode::copy}, {});
        importStudies(at, {{two}, ImportMode::copy}, {}); // twice is once
        Library library(at);
        const StudyFacts study = library.find("", StudyOrder::byName, 0, 10).studies.at(0);
        QCOMPARE(library.volumes(study.libraryId).size(), std::size_t(1));
        const VolumeFacts v = library.volumes(study.libraryId)[0];
        QCOMPARE(v.size.k, 20);
        QCOMPARE(filesBelow(at.copiesFolder()), 20);
    }

    // By reference after by copy: the copies are kept in use, and none is left over.
    void whatWasCopiedStaysWhenItIsReferredToLater() {
        const LibraryPlace at = place("both");
        importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {});
        importStudies(at, {{m_folder / "head"}, ImportMode::refer}, {});
        Library library(at);
        const StudyFacts study = library.find("", StudyOrder::byName, 0, 10).studies.at(0);
        QVERIFY(library.volumes(study.libraryId).at(0).isCopied);
        library.removeCopies(removeStudy(library, study.libraryId).copies);
        QCOMPARE(filesBelow(at.copiesFolder()), 0);
    }

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

    // Whenever an import is killed: the study is there with all its files, or not at all, and
    // nothing else is.
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
        QVERIFY(import(place("whole"), whole) && whole.waitForFinished());
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
                const VolumeFacts v = library.volumes(study.libraryId).at(0);
                const auto loaded =
                    librarySource(study, v, library.files(v.libraryId)).load({}, {});
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
        const VolumeFacts v = library.volumes(study.libraryId)[0];
        const auto files = library.files(v.libraryId);
        fs::remove(files[0].path);
        const auto loaded = librarySource(study, v, files).load({}, {});
        QCOMPARE(loaded.volume.lattice().size().k, 19);
        QCOMPARE(loaded.skipped.at(0).reason, std::string("is not there any more"));
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
        {
            // A stretch in the middle is overwritten, as a failing disk does.
            std::fstream list(at.listFile(), std::ios::in | std::ios::out | std::ios::binary);
            list.seekp(std::streamoff(bytes / 2));
            const std::string noise(40000, '\xa5');
            list.write(noise.data(), std::streamsize(noise.size()));
        }
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
        QVERIFY(library.volumes(study.libraryId).at(0).files > 0);
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
        Library(at).put({series(1, "Doe^Jane", "Thorax", 1)});
        {
            std::fstream list(at.listFile(), std::ios::in | std::ios::out | std::ios::binary);
            list.seekp(60); // SQLite's user version
            list.write("\0\0\0\7", 4);
        }
        const auto written = fs::last_write_time(at.listFile());
        const OpenedLibrary opened = openLibrary(at.folder);
        QVERIFY(opened.place.inMemory);
        QVERIFY(QString::fromStdString(opened.notices.at(0).reason).contains("newer version"));
        Library memory(opened.place);
        memory.put({series(2, "Roe^Richard", "Knee", 1)});
        QCOMPARE(count(Library(opened.place), "richard"), 1); // shared between connections
        QVERIFY(fs::last_write_time(at.listFile()) == written);
    }

private:
    LibraryPlace place(const std::string &name) {
        fs::create_directories(m_folder / name);
        return {m_folder / name};
    }

    test::TemporaryFolder m_folder;
};

} // namespace pellucid

// The test itself, or, to be killed: --import LIBRARY PATH, --remove LIBRARY.
int main(int argc, char **argv) {
    QCoreApplication application(argc, argv);
    if (argc == 4 && std::string_view(argv[1]) == "--import") {
        pellucid::ui::importStudies({argv[2]}, {{argv[3]}, pellucid::ui::ImportMode::copy}, {});
        return 0;
    }
    if (argc == 3 && std::string_view(argv[1]) == "--remove") {
        pellucid::ui::Library library({argv[2]});
        const auto study = library.find("", pellucid::ui::StudyOrder::byName, 0, 1).studies.at(0);
        const auto removal = pellucid::ui::removeStudy(library, study.libraryId);
        std::_Exit(removal.copies.empty() ? 1 : 0);
    }
    pellucid::LibraryTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "library_test.moc"
