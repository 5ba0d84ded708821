// SPDX-License-Identifier: GPL-3.0-or-later
// Who the patient is stays in the study: no name in what the program keeps, remembers or shows to
// others.
#include "tests/ui/started_program.h"

#include <array>
#include <filesystem>

#include <QCheckBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QProcess>
#include <QScopeGuard>

#include "tests/support/files.h"
#include "tests/ui/workstation_process.h"
#include "ui/opening/recent_paths.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class PrivacyTest : public StartedProgram {
    Q_OBJECT
private slots:
    void init() {
        QSettings().clear();
        fs::remove_all(m_folder / "data");
    }
    void cleanup() { m_program.reset(); }

    void whoDoesNotWantToBeRememberedIsNot() {
        begin();
        openIn(headPath());
        QVERIFY(!QSettings().value("recentPaths").toStringList().isEmpty());
        openDialog();
        find<QCheckBox>("remembersBox")->click();
        find<QDialog>("preferencesDialog")->close();
        QVERIFY(QSettings().value("recentPaths").toStringList().isEmpty());
        openIn(headPath());
        begin();
        QVERIFY(!find<QWidget>("resumeButton")->isVisible());
        QVERIFY(QSettings().value("recentPaths").toStringList().isEmpty());
        QVERIFY(!fs::exists(m_folder / "data" / "pellucid" / "session.json"));
    }

    void aPathThatNamesThePatientIsNotAmongTheRecentOnes() {
        begin();
        ui::StudyFacts study;
        study.patientName = QString::fromUtf8("M\u00FCller^J\u00F6rg=\u738B^\u5C0F");
        study.patientId = "A-4711";
        study.birthDate = "19500607";
        study.uid = "1.2";
        for (const char *of :
             {"/cd/MULLER_J", "/cd/MullerJorg", "/cd/x jorg", "/cd/a-4711/1", "/cd/A_4711_2",
              "/cd/1950-06-07", "/cd/07.06.1950", "/cd/CT19500607", "/cd/\u738B\u5C0F\u5148\u751F"})
            QVERIFY2(ui::namesPatient(QString::fromUtf8(of), study), of);
        for (const char *of : {"/cd/head", "/home/jo/4711", "/cd/1950", "/cd/fjorgen/j", "",
                               "/cd/\u738B\u5148\u751F"})
            QVERIFY2(!ui::namesPatient(QString::fromUtf8(of), study), of);
        QVERIFY(!ui::namesPatient("/cd", {}));
        study.patientName = QString::fromUtf8(
            "Xu^Ann=\uC774^\uC601"); // of Hangul, each letter three in Unicode's D
        QVERIFY(ui::namesPatient("/cd/xu-li", study));
        QVERIFY(ui::namesPatient(QString::fromUtf8("/cd/\uC774\uC601"), study));
        QVERIFY(!ui::namesPatient("/cd/anna", study));
        study.patientId = "001";
        QVERIFY(ui::namesPatient("/cd/001/a", study));
        QVERIFY(!ui::namesPatient("/cd/IM0001", study));
        study.patientName = "Home";
        QVERIFY(!ui::namesPatient(QDir::homePath() + "/scans", study));
        const ui::StudySource phantom = ui::phantomSource("head");
        QVERIFY(!ui::namesPatient("/phantoms", phantom.study));

        const auto named = m_folder / "of_SECRET";
        fs::copy(headPath().toStdString(), named);
        const auto isKept = [] {
            return !QSettings().value("recentPaths").toStringList().filter("SECRET").isEmpty();
        };
        openIn(QString::fromStdString(named.string()));
        QVERIFY(!isKept());
        openDialog();
        find<QCheckBox>("patientTitleBox")->click();
        find<QDialog>("preferencesDialog")->close();
        openIn(QString::fromStdString(named.string()));
        QVERIFY(isKept());
        openDialog();
        find<QCheckBox>("patientTitleBox")->click(); // chosen no more
        QVERIFY(!isKept());
    }

    // Qt's dialogs write down where they have been.
    void fileDialogsLeaveNoTrace() {
        begin();
        const auto named = m_folder / "dialog_of_SECRET";
        fs::copy(headPath().toStdString(), named);
        const QString path = QString::fromStdString(named.string());
        const auto choose = [&] {
            // Once it is there, however long that takes.
            auto *waiting = new QTimer(this);
            waiting->start(20);
            connect(waiting, &QTimer::timeout, this, [path, waiting] {
                auto *dialog = qobject_cast<QFileDialog *>(QApplication::activeModalWidget());
                if (dialog == nullptr)
                    return;
                waiting->deleteLater();
                waiting->stop();
                dialog->setDirectory(path);
                dialog->findChild<QLineEdit *>("fileNameEdit")->setText(path);
                QMetaObject::invokeMethod(dialog, "accept");
            });
        };
        static constexpr std::array keys{"FileDialog/lastVisited", "FileDialog/history"};
        const auto values = [] {
            const QSettings ofQt(QSettings::UserScope, "QtProject");
            return std::array{ofQt.value(keys[0]), ofQt.value(keys[1])};
        };
        const auto trace = [&] {
            return values()[0].toString() + values()[1].toStringList().join(" ");
        };
        // The file is the user's, who runs this.
        const auto restore = qScopeGuard([before = values()] {
            QSettings ofQt(QSettings::UserScope, "QtProject");
            for (std::size_t n = 0; n < keys.size(); ++n)
                before[n].isValid() ? ofQt.setValue(keys[n], before[n]) : ofQt.remove(keys[n]);
        });
        choose();
        find<QAction>("openFolderAction")->trigger();
        settleIn();
        QVERIFY2(!trace().contains(path), qPrintable(trace()));
        choose();
        QFileDialog::getExistingDirectory(); // as without care
        QVERIFY(trace().contains(path));
    }

    void theTitleNamesThePatientOnlyWhereThatIsChosen() {
        begin();
        openIn(headPath());
        QCOMPARE(window_().windowTitle(), QString("Pellucid"));
        openDialog();
        find<QCheckBox>("patientTitleBox")->click();
        QCOMPARE(window_().windowTitle(), QString("Secret Name - Pellucid"));
    }

    // After a kill nothing is lost; what has ended leaves no path with a name in it.
    void aPathThatNamesThePatientGoesWithTheProgram() {
        const fs::path named = m_folder / "Secret Name";
        fs::copy(headPath().toStdString(), named);
        {
            ui::Workstation program;
            program.window().openPaths({QString::fromStdString(named.string())});
            QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
            const auto &source = program.bench().study.document.sources().at(0);
            QVERIFY(ui::namesPatient(source.lasting.at(0), source.study));
        }
        QVERIFY(!hasSession());
    }

    // No name, no number of a patient in what the program keeps for itself.
    void nothingThatIsKeptNamesThePatient() {
        const fs::path patient = m_folder / "patient";
        fs::copy(headPath().toStdString(), patient);
        QStringList change{"-nb",
                           "-i",
                           "PatientID=SecretNumber",
                           "-i",
                           "PatientBirthDate=19010203",
                           "-i",
                           "StudyDescription=SecretStudy"};
        for (const auto &file : fs::directory_iterator(patient))
            change << QString::fromStdString(file.path().string());
        QCOMPARE(QProcess::execute("dcmodify", change), 0);
        fs::resize_file(patient / "IM0080.dcm", 3000); // which the log may mention
        const QString path = QString::fromStdString(patient.string());
        {
            ui::Workstation program;
            program.window().openPaths({path});
            ui::Document &document = program.bench().study.document;
            QTRY_VERIFY_WITH_TIMEOUT(document.volume() && !document.isPreview(), patienceMs);
            QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
            QVERIFY(!program.window().windowTitle().contains("Secret"));
        }
        QProcess program;
        startWorkstation(program, m_folder, {path});
        QTRY_VERIFY_WITH_TIMEOUT(
            fs::exists(m_folder / "cache" / "pellucid" / "log" / "pellucid.log"), patienceMs);
        QTest::qWait(1500);
        program.terminate();
        QVERIFY(program.waitForFinished(patienceMs));
        int looked = 0;
        for (const char *const place : {"data", "cache", "config"})
            for (const auto &entry : fs::recursive_directory_iterator(m_folder / place)) {
                QVERIFY2(entry.path().string().find("Secret") == std::string::npos,
                         entry.path().c_str());
                if (!entry.is_regular_file() ||
                    entry.path().string().find("library.sqlite") != std::string::npos)
                    continue; // the library is what the user keeps
                ++looked;
                const std::string kept = readText(entry.path());
                for (const char *of : {"Secret", "19010203"})
                    QVERIFY2(kept.find(of) == std::string::npos, entry.path().c_str());
            }
        QVERIFY(looked > 2);
    }

private:
    bool hasSession() const { return fs::exists(m_folder / "data" / "pellucid" / "session.json"); }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::PrivacyTest>(argc, argv);
}

#include "privacy_test.moc"
