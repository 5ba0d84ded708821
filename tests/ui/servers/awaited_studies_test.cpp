// SPDX-License-Identifier: GPL-3.0-or-later
// What the program does with a study that arrives.
#include "ui/servers/awaited_studies.h"

#include <QtTest>

namespace pellucid {

using ui::AwaitedStudies;
using Then = AwaitedStudies::Then;

namespace {

ui::StudyFacts study(const QString &uid) {
    ui::StudyFacts facts;
    facts.patientId = "P";
    facts.uid = uid;
    return facts;
}

const archive::RetrievalReport complete;

archive::RetrievalReport withCorrections(std::size_t images, std::size_t ofAnotherPatient = 0) {
    archive::RetrievalReport report;
    report.corrected = images;
    report.ofAnotherPatient = ofAnotherPatient;
    return report;
}

} // namespace

class AwaitedStudiesTest : public QObject {
    Q_OBJECT
private slots:
    void onlyTheStudyAskedForLastOpensWhileItArrives() {
        AwaitedStudies awaited;
        awaited.await(study("1"));
        awaited.await(study("2"));
        QVERIFY(!awaited.arriving("1"));
        QCOMPARE(awaited.arriving("2")->uid, QString("2"));
        awaited.forgetStudy();
        QVERIFY(!awaited.arriving("2"));
    }

    void aStudyOpensAtItsEndOnlyWhereNothingIsOpen() {
        AwaitedStudies awaited;
        QVERIFY(awaited.completed("1", complete, true, true).then == Then::open);
        QVERIFY(awaited.completed("1", complete, true, false).then == Then::say);
        QVERIFY(awaited.completed("1", complete, false, true).then == Then::say);
    }

    // The user may have closed it meanwhile.
    void aStudyThatOpenedWhileItArrivedDoesNotOpenAgain() {
        AwaitedStudies awaited;
        awaited.await(study("1"));
        QVERIFY(awaited.arriving("1"));
        QVERIFY(awaited.completed("1", complete, true, true).then == Then::say);
    }

    void aStudyOpensBesideTheOneItWasWantedFor() {
        AwaitedStudies awaited;
        awaited.awaitBeside(study("2"), "open");
        awaited.setOpen("open");
        QVERIFY(!awaited.readyForBeside());
        QVERIFY(awaited.completed("2", complete, true, false).then == Then::openBeside);
        QCOMPARE(awaited.readyForBeside()->uid, QString("2"));
        awaited.setOpen("another");
        QVERIFY(!awaited.readyForBeside());
        QVERIFY(awaited.completed("2", complete, true, false).then == Then::say);
    }

    void imagesOfAnotherPatientNeverOpenWithoutAQuestion() {
        AwaitedStudies awaited;
        const archive::RetrievalReport other = withCorrections(0, 1);
        QVERIFY(awaited.completed("1", other, true, true).then == Then::askAboutPatient);
        QVERIFY(awaited.completed("1", other, false, true).then == Then::nothing);
        awaited.awaitBeside(study("1"), "open");
        QVERIFY(awaited.completed("1", other, true, true).then == Then::askAboutPatient);
        QVERIFY(!awaited.readyForBeside());
    }

    void aCorrectionIsOfferedOnceForEachStudy() {
        AwaitedStudies awaited;
        const archive::RetrievalReport corrected = withCorrections(3, 3);
        QVERIFY(!awaited.completed("1", corrected, false, true).asksToReplace);
        const auto first = awaited.completed("1", corrected, true, true);
        QVERIFY(first.asksToReplace && first.then == Then::askAboutPatient);
        QVERIFY(!awaited.completed("1", corrected, true, true).asksToReplace);
        QVERIFY(awaited.completed("2", corrected, true, true).asksToReplace);
    }
};

} // namespace pellucid

QTEST_GUILESS_MAIN(pellucid::AwaitedStudiesTest)
#include "awaited_studies_test.moc"
