// SPDX-License-Identifier: GPL-3.0-or-later
// Servers as a person uses them: enter one, test it, search, retrieve, send.
#include "tests/network/servers.h"
#include "tests/ui/studies_window.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <QTreeWidget>

#include "core/archive/sending.h"
#include "ui/servers/remote_study.h"
#include "ui/window/workbench.h"

namespace pellucid {

using namespace test;

class ServersTest : public StudiesWindow {
    Q_OBJECT
private slots:
    void initTestCase() {
        StudiesWindow::initTestCase();
        if (!isInstalled("dcmqrscp"))
            QSKIP("dcmqrscp is not installed");
        m_dcmqrscp = std::make_unique<Dcmqrscp>();
        archive::Server server;
        server.name = "archive";
        server.peer.host = "127.0.0.1";
        server.peer.port = m_dcmqrscp->port();
        server.peer.calledAe = "COMMON";
        std::vector<std::filesystem::path> files;
        for (const auto &entry : std::filesystem::directory_iterator(m_folder / "head"))
            files.push_back(entry.path());
        QVERIFY(archive::send(server, files).notSent.empty());
    }

    void aServerIsEnteredAndTestedStepByStep() {
        find<QAction>("serversAction")->trigger();
        auto *dialog = find<QDialog>("serversDialog");
        enter(*dialog, "archive", m_dcmqrscp->port());
        auto *const message = dialog->findChild<QLabel *>("serverMessage");
        const auto test = [&] {
            QTest::mouseClick(dialog->findChild<QPushButton *>("testServerButton"), Qt::LeftButton);
        };
        test();
        QTRY_VERIFY_WITH_TIMEOUT(message->text().contains("C-FIND"), patienceMs);
        QVERIFY(message->text().contains("TCP"));
        save("servers");
        // The step that fails is named, and what to do.
        dialog->findChild<QSpinBox *>("serverPortBox")->setValue(freePort());
        test();
        QTRY_VERIFY_WITH_TIMEOUT(message->text().contains("check the port"), patienceMs);
        // What makes no sense is refused before it is saved.
        dialog->findChild<QLineEdit *>("serverHostEdit")->setText("");
        QTest::mouseClick(dialog->findChild<QPushButton *>("saveServerButton"), Qt::LeftButton);
        QVERIFY(message->text().contains("AET@HOST:PORT"));
        QVERIFY(bench().servers.servers().empty());
        dialog->findChild<QLineEdit *>("serverHostEdit")->setText("127.0.0.1");
        QTest::mouseClick(dialog->findChild<QPushButton *>("saveServerButton"), Qt::LeftButton);
        QCOMPARE(bench().servers.names(), QStringList{"archive"});
        // The list is there after a restart, and a server can be removed.
        restart();
        find<QAction>("serversAction")->trigger();
        dialog = find<QDialog>("serversDialog");
        QCOMPARE(dialog->findChild<QLineEdit *>("serverAeEdit")->text(), QString("COMMON"));
        QTest::mouseClick(dialog->findChild<QPushButton *>("removeServerButton"), Qt::LeftButton);
        QVERIFY(bench().servers.servers().empty());
        dialog->close();
    }

    // One field searches the library and the servers; a double-click brings the study.
    void aStudyIsFoundAndRetrieved() {
        addServer("archive", m_dcmqrscp->port());
        addServer("dead", freePort());
        auto *const search = find<QLineEdit>("studySearch");
        search->setFocus();
        QTest::keyClicks(search, "Secret");
        QTest::keyClick(search, Qt::Key_Return);
        QTRY_COMPARE_WITH_TIMEOUT(rows(), QStringList{"Secret Name"}, patienceMs);
        auto *const states = find<QLabel>("serverStates");
        QTRY_VERIFY_WITH_TIMEOUT(states->toolTip().contains("dead"), patienceMs);
        QVERIFY(states->toolTip().contains("check the port"));
        save("search");
        const QModelIndex row = tree()->model()->index(0, 0);
        QVERIFY(!tree()->model()->hasChildren(row));
        QVERIFY(row.data(Qt::ToolTipRole).toString().contains("archive"));
        click(row); // selects it
        QTest::mouseDClick(tree()->viewport(), Qt::LeftButton, {}, middle(row));
        // It opens, because no study was open, and is in the library.
        QTRY_VERIFY_WITH_TIMEOUT(document().volume() && !document().isPreview(), patienceMs);
        settle();
        QCOMPARE(document().volume()->lattice().size().k, 80);
        auto *const transfers = find<QTreeWidget>("transfersTree");
        QVERIFY(transfers->isVisible());
        QCOMPARE(transfers->topLevelItem(0)->text(1), QString("80 images"));
        QTRY_VERIFY_WITH_TIMEOUT(tree()->model()->hasChildren(tree()->model()->index(0, 0)),
                                 patienceMs);
        save("retrieved");
        restart();
        QTRY_COMPARE_WITH_TIMEOUT(rows(), QStringList{"Secret Name"}, patienceMs);
        QCOMPARE(bench().transfers.transfers().size(), 1U);
        // What is here and at the server is listed once, with the server.
        find<QLineEdit>("studySearch")->setText("Secret");
        QTest::keyClick(find<QLineEdit>("studySearch"), Qt::Key_Return);
        QTRY_VERIFY_WITH_TIMEOUT(
            tree()->model()->index(0, 0).data(Qt::ToolTipRole).toString().contains("archive"),
            patienceMs);
        QCOMPARE(rows(), QStringList{"Secret Name"});
    }

    // What an interrupted program left in the queue is continued by the next one.
    void aQueuedTransferIsContinued() {
        addServer("archive", m_dcmqrscp->port());
        const QString uid = studyUid();
        {
            archive::TransferLog log(archive::TransferLog::fileOfUser());
            archive::Transfer transfer;
            transfer.server = "archive";
            transfer.wanted.studyUid = uid.toStdString();
            transfer.title = "Head";
            transfer.folder = archive::libraryObjectFolder();
            log.add(transfer);
        }
        restart();
        QTRY_COMPARE_WITH_TIMEOUT(rows(), QStringList{"Secret Name"}, patienceMs);
        QTRY_VERIFY_WITH_TIMEOUT(bench().transfers.transfers().front().state ==
                                     archive::TransferState::complete,
                                 patienceMs);
    }

    void theWordsOfASearchHaveMeanings() {
        const archive::SearchTerms terms = ui::searchTermsOf("Miller Ann 2026-01-15 CT A4711");
        QCOMPARE(QString::fromStdString(terms.patientName), QString("*Miller*Ann*"));
        QCOMPARE(QString::fromStdString(terms.date), QString("20260115"));
        QCOMPARE(QString::fromStdString(terms.modality), QString("CT"));
        QCOMPARE(QString::fromStdString(terms.patientId), QString("*A4711*"));
        QVERIFY(ui::searchTermsOf(" ").patientName.empty());
    }

private:
    static void enter(QDialog &dialog, const QString &name, int port) {
        dialog.findChild<QLineEdit *>("serverNameEdit")->setText(name);
        dialog.findChild<QLineEdit *>("serverAeEdit")->setText("COMMON");
        dialog.findChild<QLineEdit *>("serverHostEdit")->setText("127.0.0.1");
        dialog.findChild<QSpinBox *>("serverPortBox")->setValue(port);
    }
    void addServer(const std::string &name, int port) {
        archive::Server server;
        server.name = name;
        server.peer.host = "127.0.0.1";
        server.peer.port = port;
        server.peer.calledAe = "COMMON";
        bench().servers.put(server);
    }
    QString studyUid() const {
        archive::Server server = bench().servers.servers().front();
        return QString::fromStdString(
            archive::search({server}, {}).entries.at(0).text(exchange::tag::studyUid));
    }

    std::unique_ptr<Dcmqrscp> m_dcmqrscp;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::ServersTest>(argc, argv);
}

#include "servers_test.moc"
