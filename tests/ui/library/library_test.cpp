// SPDX-License-Identifier: GPL-3.0-or-later
// The study library without a window: entries are found as they were put in.
#include <algorithm>
#include <ctime>

#include <QSqlDatabase>
#include <QSqlQuery>
#include <QtTest>

#include "core/task/error.h"
#include "core/volume/nrrd.h"
#include "tests/ui/library/library_folder.h"
#include "ui/library/import_studies.h"
#include "ui/panels/study_list.h"
#include "ui/studies/study_source.h"

namespace pellucid {

namespace because = task::because;
namespace fs = std::filesystem;
using namespace test;
using namespace ui;

namespace {

// Processor time of this process, which other programs do not lengthen. *Units*: ms.
template <class F> double millisecondsOf(const F &work) {
    const std::clock_t start = std::clock();
    work();
    return 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC;
}

// The times of the library's operations. *Units*: ms.
struct LibraryTimes {
    double put = 0.0, open = 0.0, search = 0.0, lastPage = 0.0;
};

} // namespace

class LibraryTest : public LibraryFolder {
    Q_OBJECT
private slots:
    void initTestCase() { writeHead(); }

    void findsByAnyWordWithoutCaseAndAccents() {
        Library library(place("find"));
        library.put({librarySeries(1, QString::fromUtf8("Müller^Jörg"), "Thorax", 2),
                     librarySeries(2, QString::fromUtf8("王^小明"), "Head", 2),
                     librarySeries(3, "Doe^Jane", "Knee", 2)});
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
        LibrarySeries s = librarySeries(1, "Doe^Jane", "Thorax", 3);
        s.volumes[0].thumbnail = QImage(96, 60, QImage::Format_Grayscale8);
        s.volumes[0].thumbnail.fill(77);
        s.volumes[0].tiltDeg = 18.5;
        library.put({s});
        const StudyFacts study = library.find("", StudyOrder::byName, 0, 10).studies.at(0);
        QCOMPARE(study.key(), s.study.key());
        QCOMPARE(study.modalities, QString("CT"));
        const VolumeFacts v = library.volumes(study).at(0);
        QCOMPARE(v.key(), s.volumes[0].key());
        QCOMPARE(v.tiltDeg, 18.5);
        QVERIFY(v.warnings == s.volumes[0].warnings);
        QCOMPARE(v.thumbnail.size(), QSize(96, 60));
        QCOMPARE(qGray(v.thumbnail.pixel(5, 5)), 77);
        QCOMPARE(v.files, 3);
        QCOMPARE(library.files(study, v).size(), std::size_t(3));
        // The series with other files replaces the former one.
        s.files.resize(2);
        library.put({s});
        QCOMPARE(count(library), 1);
        QCOMPARE(library.volumes(study).size(), std::size_t(1));
        QCOMPARE(library.volumes(study)[0].files, 2);
        finish(removeStudy(library, study), library);
        QCOMPARE(count(library), 0);
    }

    void aHundredThousandInstancesStaySearchable_data() {
        QTest::addColumn<int>("studies");
        QTest::addColumn<int>("files");
        QTest::newRow("500 studies of 200 instances") << 500 << 200;
        QTest::newRow("100000 studies of one instance") << 100000 << 1;
    }
    // Ten times as many studies take ten times as long, a quarter more where trees are deeper, but
    // not a hundred times. Finding a page takes a small part of the time for listing all.
    void aHundredThousandInstancesStaySearchable() {
        QFETCH(int, studies);
        QFETCH(int, files);
        const LibraryTimes tenth = timesOf(studies / 10, files), all = timesOf(studies, files);
        qInfo("put %.0f ms, open and check %.0f ms, search %.1f ms, last page %.1f ms; a tenth of "
              "them %.0f, %.0f, %.1f, %.1f ms",
              all.put, all.open, all.search, all.lastPage, tenth.put, tenth.open, tenth.search,
              tenth.lastPage);
        constexpr double most = 20.0, shortestMs = 1.0; // below, the clock counts little else
        const auto grows = [&](double from, double to) {
            return to < most * std::max(from, shortestMs);
        };
        QVERIFY(grows(tenth.put, all.put));
        QVERIFY(grows(tenth.open, all.open));
        QVERIFY(grows(tenth.search, all.search));
        QVERIFY(grows(tenth.lastPage, all.lastPage));
        QVERIFY(all.search < all.put / 50.0);
        QVERIFY(all.lastPage < all.put / 50.0);
    }

    void importsByReferenceAndByCopy() {
        for (const ImportMode mode : {ImportMode::refer, ImportMode::copy}) {
            const LibraryPlace at = place(mode == ImportMode::copy ? "copy" : "refer");
            const ImportResult result = importStudies(at, {{m_folder / "head"}, mode}, {});
            QCOMPARE(result.series, 1);
            QCOMPARE(result.files, 20);
            Library library(at);
            const StudyFacts study = library.find("head", StudyOrder::byName, 0, 10).studies.at(0);
            const VolumeFacts v = library.volumes(study).at(0);
            QVERIFY(!v.thumbnail.isNull());
            QCOMPARE(v.isCopied, mode == ImportMode::copy);
            QCOMPARE(filesBelow(at.copiesFolder()), mode == ImportMode::copy ? 20 : 0);
            // The file names of the copies do not contain the patient's name.
            for (const dicom::InstanceFile &file : library.files(study, v))
                QVERIFY(mode == ImportMode::refer ||
                        file.path.string().find("Head") == std::string::npos);
            const auto loaded = librarySource(study, v, library.files(study, v)).load({}, {});
            QCOMPARE(loaded.volume.lattice().size().k, 20);
            QVERIFY(loaded.skipped.empty());
            finish(removeStudy(library, study), library);
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
        importStudies(at, {{two}, ImportMode::copy}, {}); // importing again adds nothing
        Library library(at);
        const StudyFacts study = library.find("", StudyOrder::byName, 0, 10).studies.at(0);
        QCOMPARE(library.volumes(study).size(), std::size_t(1));
        const VolumeFacts v = library.volumes(study)[0];
        QCOMPARE(v.size.k, 20);
        QCOMPARE(filesBelow(at.copiesFolder()), 20);
    }

    // The study is imported by copy, then by reference: the copies stay in use, and none is left
    // over.
    void whatWasCopiedStaysWhenItIsReferredToLater() {
        const LibraryPlace at = place("both");
        importStudies(at, {{m_folder / "head"}, ImportMode::copy}, {});
        importStudies(at, {{m_folder / "head"}, ImportMode::refer}, {});
        Library library(at);
        const StudyFacts study = library.find("", StudyOrder::byName, 0, 10).studies.at(0);
        QVERIFY(library.volumes(study).at(0).isCopied);
        finish(removeStudy(library, study), library);
        QCOMPARE(filesBelow(at.copiesFolder()), 0);
    }

private:
    LibraryTimes timesOf(int studies, int files) const {
        const LibraryPlace at = place("many" + std::to_string(studies));
        LibraryTimes times;
        const auto series = many(studies, files);
        times.put = millisecondsOf([&] { Library(at).put(series); });
        OpenedLibrary opened;
        times.open = millisecondsOf([&] { opened = openLibrary(at.folder); });
        [&] { QVERIFY(opened.notices.empty()); }();
        const Library library(opened.place);
        const QStringList searches{"doe77", "thorax", "jane doe4", "nobody", ""};
        for (const QString &words : searches)
            times.search += millisecondsOf([&] {
                                const StudyPage page =
                                    library.find(words, StudyOrder::newestFirst, 0, 200);
                                QCOMPARE(int(page.studies.size()), std::min(page.count, 200));
                            }) /
                            double(searches.size());
        [&] {
            QCOMPARE(count(library, "nobody"), 0);
            QCOMPARE(count(library), studies);
        }();
        const int onPage = std::min(studies, 200);
        times.lastPage = millisecondsOf([&] {
            const auto last = library.find("", StudyOrder::newestFirst, studies - onPage, onPage);
            QCOMPARE(int(last.studies.size()), onPage);
        });
        return times;
    }
};

} // namespace pellucid

QTEST_GUILESS_MAIN(pellucid::LibraryTest)

#include "library_test.moc"
