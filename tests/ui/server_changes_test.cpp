// SPDX-License-Identifier: GPL-3.0-or-later
// What changes beside an open window: logins, the list of servers, and what an
// archive corrects.
#include <optional>
#include <string>

#include <QAbstractButton>
#include <QInputDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>

#include "core/archive/server.h"
#include "tests/network/odd_web_server.h"
#include "tests/ui/studies_window.h"
#include "ui/panels/study_panel.h"
#include "ui/servers/remote_study.h"
#include "ui/window/workbench.h"

namespace pellucid {

using namespace test;

class ServerChangesTest : public StudiesWindow {
    Q_OBJECT
private slots:
    // The others answer while its question is open, and after it has been closed.
    void aLoginHoldsUpItsOwnServerOnly() {
        const OddWebServer open({.objects = 3});
        const OddWebServer other({.objects = 3, .studies = 2});
        bench().servers.put(open.server());
        archive::Server locked = other.server();
        locked.name = "a&b"; // before the other
        locked.peer.authentication = network::Authentication::basic;
        locked.peer.user = "eva";
        bench().servers.put(locked);
        auto *const search = find<QLineEdit>("studySearch");
        search->setText("ller");
        QTest::keyClick(search, Qt::Key_Return);
        QInputDialog *question = nullptr;
        QTRY_VERIFY_WITH_TIMEOUT(
            (question = mainWindow().findChild<QInputDialog *>("secretDialog")) != nullptr,
            patienceMs);
        QTRY_COMPARE_WITH_TIMEOUT(list().rowCount(), 1, patienceMs);
        question->reject();
        QPushButton *button = nullptr;
        QTRY_VERIFY_WITH_TIMEOUT(
            (button = mainWindow().findChild<QPushButton *>("loginButton")) != nullptr, patienceMs);
        QVERIFY(button->isVisible());
        QCOMPARE(button->text(), QString("Log in to a&&b"));
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        save("locked_server");
        QTest::mouseClick(button, Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(
            (question = mainWindow().findChild<QInputDialog *>("secretDialog")) != nullptr,
            patienceMs);
        question->setTextValue("open sesame");
        question->accept();
        QTRY_COMPARE_WITH_TIMEOUT(list().rowCount(), 2, patienceMs);
        QTRY_VERIFY_WITH_TIMEOUT(mainWindow().findChild<QPushButton *>("loginButton") == nullptr,
                                 patienceMs);
        search->clear();
        bench().servers.remove("a&b");
        bench().servers.remove("odd");
    }

    void aServerThatAnotherProgramAddsIsSeen() {
        QVERIFY(bench().servers.servers().empty());
        archive::Server server;
        server.name = "elsewhere";
        server.peer = archive::dicomPeer("PACS@[2001:db8::7]:104");
        server.sendsFrom = {"node1", "node2"};
        archive::ServerList::ofUser().put(server);
        QTRY_COMPARE_WITH_TIMEOUT(bench().servers.names(), QStringList{"elsewhere"}, patienceMs);
        QVERIFY(bench().servers.servers().front() == server);
        archive::ServerList::ofUser().remove("elsewhere");
        QTRY_VERIFY_WITH_TIMEOUT(bench().servers.servers().empty(), patienceMs);
    }

    // The archive corrects a name: the study here gets it, and is listed once.
    void correctedStudiesAreReplaced() {
        std::string name = OddWebServer::name;
        Quirks quirks;
        quirks.objects = 4;
        quirks.change = namesPatient(name);
        const OddWebServer web(quirks);
        bench().servers.put(web.server());
        const auto retrieve = [&] {
            ui::RemoteStudy study;
            study.study.uid = QString::fromStdString(OddWebServer::study);
            study.study.patientName = QString::fromStdString(name);
            study.servers = {"odd"};
            emit find<ui::StudyPanel>("studyPanel")->retrieveRequested(study);
        };
        retrieve();
        QTRY_VERIFY_WITH_TIMEOUT(rows().join("").contains("Eva"), patienceMs);
        waitForVolume();
        settle();
        name = "M\xc3\xbcller^Ava";
        retrieve();
        QMessageBox *question = nullptr;
        QTRY_VERIFY_WITH_TIMEOUT(
            (question = mainWindow().findChild<QMessageBox *>("correctedQuestion")) != nullptr,
            patienceMs);
        QVERIFY2(question->text().contains("Ava"), qPrintable(question->text()));
        save("corrected");
        for (QAbstractButton *const button : question->buttons())
            if (question->buttonRole(button) == QMessageBox::AcceptRole)
                button->click();
        QTRY_VERIFY_WITH_TIMEOUT(rows().join("").contains("Ava"), patienceMs);
        settle();
        // The one that is open stays on the screen as it is; the library has the new one alone.
        const auto inLibrary = [&] {
            QStringList names;
            for (const ui::StudyFacts &study :
                 bench().library.find({}, ui::StudyOrder::newestFirst, 0, 100).studies)
                names << study.patientName;
            return names;
        };
        QTRY_COMPARE_WITH_TIMEOUT(inLibrary(), QStringList{QString::fromStdString(name)},
                                  patienceMs);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::ServerChangesTest>(argc, argv);
}

#include "server_changes_test.moc"
