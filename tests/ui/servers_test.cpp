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
            auto *const button = dialog->findChild<QPushButton *>("testServerButton");
            QTRY_VERIFY_WITH_TIMEOUT(button->isEnabled(), patienceMs); // the last test has ended
            QTest::mouseClick(button, Qt::LeftButton);
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

    // A study is looked at while it arrives, and nothing is lost when the rest comes.
    void aSeriesIsSeenWhileItArrives() {
        std::vector<std::filesystem::path> files;
        for (const auto &entry : std::filesystem::directory_iterator(m_folder / "head"))
            files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        ui::StudyFacts study;
        study.uid = "1.2.3";
        study.patientName = "Secret^Name";
        const auto series = std::make_shared<dicom::ArrivingSeries>(files.size());
        bench().study.opener.openArriving(study, series);
        const auto order = archive::coarseToFine(files.size());
        std::size_t sent = 0;
        const auto send = [&](std::size_t count) {
            for (; sent < count; ++sent)
                series->add(order[sent], files[order[sent]]);
        };
        QVERIFY(!document().volume());
        send(2);
        QTRY_VERIFY_WITH_TIMEOUT(document().volume(), patienceMs);
        QVERIFY(document().isPreview());
        QCOMPARE(document().volume()->lattice().size().k, 80);
        // Every eighth slice: the projection is there and turns.
        send(12);
        QTRY_VERIFY_WITH_TIMEOUT(!projection()->picture().isNull(), patienceMs);
        QVERIFY(document().isPreview());
        save("arriving");
        projection()->showStandardView(scene::StandardView::left);
        QVERIFY(!find<QAction>("exportPictureAction")->isEnabled());
        send(files.size());
        waitForVolume();
        settle();
        QCOMPARE(document().pose().orientation, scene::viewOrientation(scene::StandardView::left));
        const volume::Volume arrived = *document().volume();
        QVERIFY(arrived.notes().warnings.empty());
        QCOMPARE(list().rowCount(), 1); // one study, and nothing that stands for it
        // As from the disk, bit by bit.
        const auto catalogue = dicom::scan({m_folder / "head"});
        const volume::Volume expected =
            dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
        QVERIFY(arrived.lattice() == expected.lattice());
        expected.visit([&](auto wanted) {
            arrived.visit([&](auto found) {
                QVERIFY(std::equal(wanted.begin(), wanted.end(), found.begin(), found.end()));
            });
        });
    }

    // A part does not stay when the rest does not come.
    void aCancelledArrivalLeavesNothing() {
        std::vector<std::filesystem::path> files;
        for (const auto &entry : std::filesystem::directory_iterator(m_folder / "head"))
            files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        const auto series = std::make_shared<dicom::ArrivingSeries>(files.size());
        bench().study.opener.openArriving({}, series);
        series->add(0, files.front());
        series->add(files.size() - 1, files.back());
        QTRY_VERIFY_WITH_TIMEOUT(document().volume(), patienceMs);
        QTest::keyClick(&mainWindow(), Qt::Key_Escape);
        QTRY_VERIFY_WITH_TIMEOUT(!document().volume(), patienceMs);
        QCOMPARE(document().currentSource(), -1);
        QCOMPARE(list().rowCount(), 0);
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
