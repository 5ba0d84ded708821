// SPDX-License-Identifier: GPL-3.0-or-later
// Reasons of the core in the user's language, and in files that keep them.
#include <algorithm>
#include <array>

#include <QTranslator>
#include <QtTest>

#include "core/decoding/client/reasons.h"
#include "core/decoding/process/reasons.h"
#include "core/dicom/catalogue.h"
#include "core/dicom/reasons.h"
#include "core/files/reasons.h"
#include "core/task/reasons.h"
#include "core/volume/reasons.h"
#include "ui/language/kept_reasons.h"
#include "ui/language/names.h"
#include "ui/language/reasons.h"
#include "ui/opening/session.h"

namespace pellucid {

namespace because = task::because;
using namespace ui;

namespace {

// A value for a place of a reason; no sentence contains such a number itself.
std::string argument(int place) {
    return "700" + std::to_string(place);
}

// The reason with all places filled.
task::Reason reasonOf(const task::Sentence &sentence) {
    std::string text(sentence.name);
    for (int n = 1; n <= task::placesIn(sentence.english); ++n)
        text += " t" + std::to_string(argument(n).size()) + ":" + argument(n);
    return task::Reason::decoded(text + ";").value();
}

class Chinese {
public:
    Chinese() {
        if (m_texts.load(":/i18n/pellucid_zh_TW.qm"))
            QCoreApplication::installTranslator(&m_texts);
    }
    ~Chinese() { QCoreApplication::removeTranslator(&m_texts); }
    bool isThere() const { return !m_texts.isEmpty(); }

private:
    QTranslator m_texts;
};

} // namespace

class LanguageTest : public QObject {
    Q_OBJECT
private slots:
    void aReasonWithoutATranslationIsEnglish() {
        const task::Reason reason = because::missingSlices(
            std::vector<task::Reason>{because::gapBetween("8.0", "a", "b"), because::more(2)});
        QCOMPARE(translated(reason), QString::fromStdString(reason.english()));
        const std::vector<task::Reason> label{because::slicesTo(1, 5), because::axial};
        QCOMPARE(translated(label), QString::fromStdString(dicom::labelText(label)));
    }

    void everyReasonHasAChineseText() {
        const Chinese chinese;
        QVERIFY(chinese.isThere());
        for (const task::Sentence &sentence : task::allSentences()) {
            // A sentence of the command line is not translated. Units are
            // the same in all languages.
            const std::array same{because::inWords.sentence, because::attributeIs.sentence,
                                  because::percentOfCycle.sentence, because::tubeVoltage.sentence,
                                  because::milliseconds.sentence};
            const bool isSameInAll = std::any_of(
                same.begin(), same.end(), [&](const auto &s) { return s.name == sentence.name; });
            const task::Reason reason = reasonOf(sentence);
            const QString english = QString::fromStdString(reason.english()),
                          text = translated(reason);
            QVERIFY2((text == english) == isSameInAll, qPrintable(english));
            for (int place = 1; place <= task::placesIn(sentence.english); ++place) {
                const QString filled = QString::fromStdString(argument(place));
                QVERIFY2(text.count(filled) == english.count(filled), qPrintable(text));
            }
        }
    }

    void nestedReasonsAreTranslated() {
        const Chinese chinese;
        // Names of files stay as they are.
        QCOMPARE(translated(because::missingSlices(std::vector<task::Reason>{
                     because::gapBetween("8.0", "a.dcm", "b.dcm"),
                     because::gapBetween("6.0", "c, d.dcm", "e; f.dcm"), because::more(2)})),
                 QString::fromUtf8("缺少切片，已內插補上：a.dcm 與 b.dcm 之間 8.0 mm；c, d.dcm 與 "
                                   "e; f.dcm 之間 6.0 mm；另有 2 處"));
        QCOMPARE(translated(because::without("IM1", because::isNotReadable(because::isEmpty))),
                 QString::fromUtf8("未使用 IM1：無法讀取：是空的"));
        QCOMPARE(translated({because::slicesTo(1, 5), because::axial}),
                 QString::fromUtf8("第 1 至 5 張、橫斷面"));
        QCOMPARE(translatedName("Lung"), QString::fromUtf8("肺"));
        // A name that looks like a place stays a name.
        QCOMPARE(translated(because::gapBetween("8.0", "%3", "b%1")),
                 QString::fromUtf8("%3 與 b%1 之間 8.0 mm"));
    }

    void aReasonSurvivesBeingWrittenAsALine() {
        const std::vector<task::Reason> reasons{
            because::isTruncated, because::without("a\nb;%41 \xff\xe9.dcm", because::isEmpty),
            because::missingSlices(std::vector<task::Reason>{because::more(2), because::more(3)})};
        for (const task::Reason &reason : reasons) {
            QVERIFY(!toLine(reason).contains('\n'));
            QVERIFY(reasonFromLine(toLine(reason)) == reason);
        }
        QVERIFY(reasonsFromLines(toLines(reasons)) == reasons);
        QVERIFY(reasonsFromLines(toLines({})).empty());
    }

    void aReasonOfAnotherVersionIsShown() {
        const std::string text = "isOfAnotherVersion t1:x;";
        const task::Reason reason = reasonFromLine(QString::fromStdString(text));
        QCOMPARE(reason.english(), text);
        QVERIFY(reasonFromLine(toLine(reason)) == reason);
        QCOMPARE(reasonsFromLines("one\ntwo").size(), std::size_t(2));
    }

    void aSessionKeepsReasons() {
        Session session;
        session.leftOut = {{"/a", because::isNotReadable(because::permissionDenied)}};
        std::string text = toJson(session);
        QVERIFY(sessionFromJson(text).leftOut.at(0).reason == session.leftOut[0].reason);
        const std::string line = toLine(session.leftOut[0].reason).toStdString();
        text.replace(text.find(line), line.size(), "cannot be read: Permission denied");
        const task::Reason former = sessionFromJson(text).leftOut.at(0).reason;
        QVERIFY(former != session.leftOut[0].reason);
        QCOMPARE(former.english(), session.leftOut[0].reason.english());
    }
};

} // namespace pellucid

QTEST_GUILESS_MAIN(pellucid::LanguageTest)

#include "language_test.moc"
