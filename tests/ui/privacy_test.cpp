// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing that the program keeps, remembers or shows to others names the patient.
#include "tests/ui/workstation.h"

#include <array>
#include <filesystem>

#include <QCheckBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QScopeGuard>

#include "tests/support/files.h"
#include "tests/ui/workstation_process.h"
#include "ui/opening/recent_paths.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class PrivacyTest : public Workstation {
    Q_OBJECT
private slots:
    void pathsAreNotRememberedIfTheUserTurnsThatOff() {
        open(headPath());
        QVERIFY(!QSettings().value("recentPaths").toStringList().isEmpty());
        openPreferences();
        find<QCheckBox>("remembersBox")->click();
        find<QDialog>("preferencesDialog")->close();
        QVERIFY(QSettings().value("recentPaths").toStringList().isEmpty());
        open(headPath());
        restart();
        QVERIFY(!find<QWidget>("resumeButton")->isVisible());
        QVERIFY(QSettings().value("recentPaths").toStringList().isEmpty());
        QVERIFY(!fs::exists(m_folder / "data" / "pellucid" / "session.json"));
    }

    void recentPathsOmitThoseThatNameThePatient() {
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
            "Xu^Ann=\uC774^\uC601"); // Hangul: three code points a letter in Unicode's form D
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
        open(QString::fromStdString(named.string()));
        QVERIFY(!isKept());
        openPreferences();
        find<QCheckBox>("patientTitleBox")->click();
        find<QDialog>("preferencesDialog")->close();
        open(QString::fromStdString(named.string()));
        QVERIFY(isKept());
        openPreferences();
        find<QCheckBox>("patientTitleBox")->click(); // switched off
        QVERIFY(!isKept());
    }

    // Qt's dialogs store the folders that were visited.
    void fileDialogsLeaveNoTrace() {
        const auto named = m_folder / "dialog_of_SECRET";
        fs::copy(headPath().toStdString(), named);
        const QString path = QString::fromStdString(named.string());
        const auto choose = [&] {
            // When the dialog has opened, however long that takes.
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
        // The file belongs to the user who runs this test.
        const auto restore = qScopeGuard([before = values()] {
            QSettings ofQt(QSettings::UserScope, "QtProject");
            for (std::size_t n = 0; n < keys.size(); ++n)
                before[n].isValid() ? ofQt.setValue(keys[n], before[n]) : ofQt.remove(keys[n]);
        });
        choose();
        find<QAction>("openFolderAction")->trigger();
        settle();
        QVERIFY2(!trace().contains(path), qPrintable(trace()));
        choose();
        QFileDialog::getExistingDirectory(); // the dialog without our precaution
        QVERIFY(trace().contains(path));
    }

    void theTitleNamesThePatientOnlyIfChosen() {
        open(headPath());
        QCOMPARE(mainWindow().windowTitle(), QString("Pellucid"));
        openPreferences();
        find<QCheckBox>("patientTitleBox")->click();
        QCOMPARE(mainWindow().windowTitle(), QString("Secret Name - Pellucid"));
    }

    // It is in the user's private folder, as the library is.
    void aSessionIsKeptWhateverItsPath() {
        const fs::path named = m_folder / "Secret Name";
        fs::copy(headPath().toStdString(), named);
        open(QString::fromStdString(named.string()));
        QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
        endProgram();
        QVERIFY(hasSession());
        const auto rights = fs::status(sessionFile().parent_path()).permissions();
        QVERIFY((rights & (fs::perms::group_all | fs::perms::others_all)) == fs::perms::none);
        restart();
        auto *offer = find<QPushButton>("resumeButton");
        QVERIFY(offer->isVisible());
        QVERIFY(!offer->text().contains("Secret") && !offer->toolTip().contains("Secret"));
        offer->click();
        settle();
        QVERIFY(document().volume());
    }

    // Neither the name nor the number of a patient is in the files that the program keeps.
    void noKeptFileNamesThePatient() {
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
        open(path);
        QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
        QVERIFY(!mainWindow().windowTitle().contains("Secret"));
        endProgram();
        fs::remove(sessionFile());
        QProcess program;
        startWorkstation(program, m_folder, {path});
        // When it keeps the session, the study is open.
        QTRY_VERIFY_WITH_TIMEOUT(hasSession(), patienceMs);
        QVERIFY(fs::exists(m_folder / "cache" / "pellucid" / "log" / "pellucid.log"));
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
    fs::path sessionFile() const { return m_folder / "data" / "pellucid" / "session.json"; }
    bool hasSession() const { return fs::exists(sessionFile()); }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::PrivacyTest>(argc, argv);
}

#include "privacy_test.moc"
