// SPDX-License-Identifier: GPL-3.0-or-later
// Servers as a person uses them: enter one, test it, search, retrieve, send.
#include "tests/network/servers.h"
#include "tests/ui/studies_window.h"

#include <atomic>
#include <thread>

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTreeWidget>

#include "core/archive/reasons.h"
#include "core/archive/sending.h"
#include "core/network/client/reasons.h"
#include "ui/beside/study_beside.h"
#include "ui/panels/study_panel.h"
#include "ui/servers/open_request.h"
#include "ui/servers/remote_study.h"
#include "ui/servers/same_patient.h"
#include "ui/window/link_port.h"
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
        QVERIFY(archive::send(server, filesOfHead()).notSent.empty());
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

    void aLoginInTheBrowserIsEntered() {
        find<QAction>("serversAction")->trigger();
        auto *dialog = find<QDialog>("serversDialog");
        const auto field = [&](const char *name) { return dialog->findChild<QLineEdit *>(name); };
        const auto isShown = [&](const char *name) { return field(name)->isVisibleTo(dialog); };
        const auto save = [&] {
            QTest::mouseClick(dialog->findChild<QPushButton *>("saveServerButton"), Qt::LeftButton);
        };
        field("serverNameEdit")->setText("web");
        dialog->findChild<QComboBox *>("protocolBox")->setCurrentIndex(1);
        field("serverUrlEdit")->setText("https://pacs.example.org/dicom-web");
        auto *const login = dialog->findChild<QComboBox *>("authenticationBox");
        const QStringList names{"issuerEdit", "authorizationUrlEdit", "tokenUrlEdit",
                                "clientIdEdit", "scopeEdit"};
        for (int index = 0; index < login->count(); ++index) {
            login->setCurrentIndex(index);
            for (const QString &name : names)
                QCOMPARE(isShown(qPrintable(name)), index == 3);
        }
        QVERIFY(!isShown("userEdit"));
        QVERIFY(!isShown("secretEdit"));
        auto *const message = dialog->findChild<QLabel *>("serverMessage");
        save();
        QVERIFY(message->text().contains("issuer"));
        field("issuerEdit")->setText("https://login.example.org");
        QVERIFY(!isShown("authorizationUrlEdit")); // the issuer describes it
        QVERIFY(!isShown("tokenUrlEdit"));
        save();
        QVERIFY(message->text().contains("client ID"));
        field("clientIdEdit")->setText("pellucid");
        save();
        QCOMPARE(bench().servers.names(), QStringList{"web"});
        restart();
        find<QAction>("serversAction")->trigger();
        dialog = find<QDialog>("serversDialog");
        QCOMPARE(field("issuerEdit")->text(), QString("https://login.example.org"));
        QCOMPARE(field("clientIdEdit")->text(), QString("pellucid"));
        QTest::mouseClick(dialog->findChild<QPushButton *>("removeServerButton"), Qt::LeftButton);
        QVERIFY(bench().servers.servers().empty());
        dialog->close();
    }

    // The answer is kept with the server.
    void aLoginWithoutTlsIsAskedAboutOnce() {
        find<QAction>("serversAction")->trigger();
        auto *const dialog = find<QDialog>("serversDialog");
        const auto field = [&](const char *name) { return dialog->findChild<QLineEdit *>(name); };
        const auto save = [&] {
            QTest::mouseClick(dialog->findChild<QPushButton *>("saveServerButton"), Qt::LeftButton);
            return dialog->findChild<QMessageBox *>("insecureLoginQuestion");
        };
        field("serverNameEdit")->setText("web");
        dialog->findChild<QComboBox *>("protocolBox")->setCurrentIndex(1);
        field("serverUrlEdit")->setText("http://pacs.example.org/dicom-web");
        dialog->findChild<QComboBox *>("authenticationBox")->setCurrentIndex(1);
        field("userEdit")->setText("eva");
        field("secretEdit")->setText("open sesame");
        QMessageBox *box = save();
        QVERIFY(box != nullptr);
        QCOMPARE(box->defaultButton(), box->button(QMessageBox::Cancel));
        box->button(QMessageBox::Cancel)->click();
        QVERIFY(bench().servers.servers().empty());
        box = save();
        QVERIFY(box != nullptr && bench().servers.servers().empty());
        for (QAbstractButton *const button : box->buttons())
            if (box->buttonRole(button) == QMessageBox::AcceptRole)
                button->click();
        QCOMPARE(bench().servers.names(), QStringList{"web"});
        QVERIFY(bench().servers.servers().front().peer.allowsInsecureLogin);
        QTRY_VERIFY_WITH_TIMEOUT(
            dialog->findChild<QMessageBox *>("insecureLoginQuestion") == nullptr, patienceMs);
        QVERIFY(save() == nullptr);
        // Another address is another question.
        field("serverUrlEdit")->setText("http://other.example.org/dicom-web");
        QVERIFY(save() != nullptr);
        dialog->close();
    }

    void aReceiverWithTlsNeedsAuthorities() {
        addServer("archive", m_dcmqrscp->port());
        ui::ReceiverSettings settings;
        settings.isOn = settings.usesTls = true;
        settings.port = freePort();
        settings.certificate = settings.key = "/etc/hostname";
        bench().receiver.setSettings(settings);
        QVERIFY(!bench().receiver.isListening());
        QVERIFY(bench().receiver.failure()->is(task::because::receiverNeedsAuthorities));
        find<QAction>("serversAction")->trigger();
        auto *const dialog = find<QDialog>("serversDialog");
        QVERIFY(dialog->findChild<QLabel *>("receiverState")
                    ->text()
                    .contains("certificates of the CAs"));
        // It listens where it is told to.
        settings.usesTls = false;
        settings.address = "192.0.2.1";
        bench().receiver.setSettings(settings);
        QVERIFY(bench().receiver.failure()->is(task::because::isNoListeningAddress));
        dialog->findChild<QCheckBox *>("receiverTlsBox")->click();
        dialog->findChild<QLineEdit *>("receiverAddressEdit")->setText("127.0.0.1");
        QTest::mouseClick(dialog->findChild<QPushButton *>("applyReceiverButton"), Qt::LeftButton);
        QVERIFY(bench().receiver.isListening());
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
        const auto files = filesOfHead();
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
        const volume::Lattice first = document().volume()->lattice();
        QVERIFY(first.size().k < 80); // room for all slices would take time
        // Every eighth slice: the projection is there and turns.
        send(12);
        QTRY_VERIFY_WITH_TIMEOUT(!projection()->picture().isNull(), patienceMs);
        QCOMPARE(document().volume()->lattice().size().k, 80);
        QVERIFY(document().volume()->lattice().fillsSameBox(first));
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
        const auto files = filesOfHead();
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

    // A server may send anybody's images under the UID of the study that the user chose.
    void imagesOfAnotherPatientAreAskedAbout() {
        addServer("archive", m_dcmqrscp->port());
        ui::RemoteStudy study;
        study.study.uid = studyUid();
        study.study.patientName = "Somebody^Else";
        study.study.patientId = "another";
        study.servers = {"archive"};
        const auto awaitQuestion = [&](const char *name) {
            QMessageBox *question = nullptr;
            [&] {
                QTRY_VERIFY_WITH_TIMEOUT((question = mainWindow().findChild<QMessageBox *>(name)) !=
                                             nullptr,
                                         patienceMs);
            }();
            return question;
        };
        const auto retrieve = [&](const char *name) {
            emit find<ui::StudyPanel>("studyPanel")->retrieveRequested(study);
            return awaitQuestion(name);
        };
        const auto press = [](QMessageBox &question, QMessageBox::ButtonRole role) {
            for (QAbstractButton *const button : question.buttons())
                if (question.buttonRole(button) == role)
                    QTest::mouseClick(button, Qt::LeftButton);
            QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        };
        QMessageBox *question = retrieve("anotherPatientQuestion");
        QVERIFY(question != nullptr);
        QVERIFY(question->text().contains("Listed: Somebody Else, another"));
        QVERIFY(question->text().contains("Named: Secret Name"));
        // Nothing was shown while it arrived either. The list names the images' own patient.
        QVERIFY(!document().volume());
        QVERIFY(document().currentSource() < 0);
        QTRY_COMPARE_WITH_TIMEOUT(rows(), QStringList{"Secret Name"}, patienceMs);
        press(*question, QMessageBox::RejectRole);
        QVERIFY(!document().volume());
        // Nor if the images are here already: then the archive may have corrected the patient.
        question = retrieve("correctedQuestion");
        QVERIFY(question != nullptr);
        press(*question, QMessageBox::RejectRole);
        question = awaitQuestion("anotherPatientQuestion");
        QVERIFY(question != nullptr && !document().volume());
        press(*question, QMessageBox::AcceptRole);
        QTRY_VERIFY_WITH_TIMEOUT(document().volume() && !document().isPreview(), patienceMs);
    }

    // The command line may retrieve into the library before the workstation has ever been started.
    void aStudyThatCameBeforeTheFirstStartIsListed() {
        forgetEverything();
        const auto folder = archive::libraryObjectFolder() / "1.2.3" / "1.2.3.1";
        std::filesystem::create_directories(folder);
        {
            archive::TransferLog log(archive::TransferLog::fileOfUser());
            for (const auto &file : filesOfHead()) {
                const auto to = folder / file.filename();
                std::filesystem::copy_file(file, to);
                log.addArrival({to, "1.2.3", "1.2.3.1", file.stem().string(), "", 1}, "archive");
            }
        }
        restart();
        QTRY_COMPARE_WITH_TIMEOUT(rows(), QStringList{"Secret Name"}, patienceMs);
        QCOMPARE(problems(), QString());
        QTRY_VERIFY_WITH_TIMEOUT(
            archive::TransferLog(archive::TransferLog::fileOfUser()).arrivals().empty(),
            patienceMs);
    }

    // Another attempt would fail as well: the reason is shown, and nothing stays in the list.
    void aStudyThatTheServerDoesNotHaveIsNotListed() {
        addServer("archive", m_dcmqrscp->port());
        std::vector<task::Reason> failures;
        QObject context;
        connect(&bench().transfers, &ui::TransferQueue::failed, &context,
                [&](const task::Reason &what) { failures.push_back(what); });
        ui::RemoteStudy study;
        study.study.uid = "1.2.3.4";
        study.servers = {"archive"};
        bench().transfers.add(study, &mainWindow());
        QCOMPARE(bench().transfers.transfers().size(), std::size_t(1));
        QTRY_COMPARE_WITH_TIMEOUT(failures.size(), std::size_t(1), patienceMs);
        QVERIFY(failures.front().is(task::because::serverHasNoSuchStudy));
        QVERIFY(bench().transfers.transfers().empty());
        QCOMPARE(find<QTreeWidget>("transfersTree")->topLevelItemCount(), 0);
    }

    // A picture of an open study goes to a server without a file on this computer.
    void aPictureIsSentToAServer() {
        const Dcmqrscp archives;
        const archive::Server server = addServer("archive", archives.port());
        addServer("dead", freePort());
        open(headPath());
        const auto send = [&](const char *name, int format) {
            find<QAction>("exportPictureAction")->trigger();
            auto *const to = find<QComboBox>("exportToBox");
            to->setCurrentIndex(to->findText(name));
            find<QComboBox>("exportFormatBox")->setCurrentIndex(format);
            find<QSpinBox>("exportFramesBox")->setValue(3);
        };
        const auto press = [&] {
            QVERIFY(find<QPushButton>("exportWriteButton")->isEnabled());
            QTest::mouseClick(find<QPushButton>("exportWriteButton"), Qt::LeftButton);
        };
        // Choosing a server chooses a format that servers store.
        find<QAction>("exportPictureAction")->trigger();
        auto *const formats = find<QComboBox>("exportFormatBox");
        QCOMPARE(formats->currentIndex(), 0);
        auto *const to = find<QComboBox>("exportToBox");
        to->setCurrentIndex(to->findText("archive"));
        QCOMPARE(formats->currentIndex(), 4);
        formats->setCurrentIndex(0);
        QVERIFY(!find<QPushButton>("exportWriteButton")->isEnabled());
        QVERIFY(find<QLabel>("exportMessage")->text().contains("DICOM"));
        for (const int format : {4, 7}) {
            send("archive", format);
            press();
            // It says so, and does not send the same twice.
            QTRY_VERIFY_WITH_TIMEOUT(find<QLabel>("exportMessage")->text().contains("Sent to"),
                                     patienceMs);
            QVERIFY(!find<QPushButton>("exportWriteButton")->isEnabled());
        }
        archive::SearchTerms terms;
        terms.studyUid = document().sources().front().study.uid.toStdString();
        terms.level = network::Level::series;
        QCOMPARE(archive::search({server}, terms).entries.size(), std::size_t(2));
        // Why it fails is said where it was asked for.
        send("dead", 4);
        press();
        QTRY_VERIFY_WITH_TIMEOUT(find<QLabel>("exportMessage")->text().contains("check the port"),
                                 patienceMs);
        find<QDialog>("exportDialog")->close();
    }

    // What known servers send comes into the library; others are turned away.
    void theProgramReceivesWhatKnownServersSend() {
        find<QAction>("serversAction")->trigger();
        auto *const dialog = find<QDialog>("serversDialog");
        dialog->findChild<QTabWidget *>("serversTabs")->setCurrentIndex(1);
        auto *const state = dialog->findChild<QLabel *>("receiverState");
        QVERIFY(state->text().contains("off"));
        const int port = freePort();
        dialog->findChild<QCheckBox *>("receiverOnBox")->click();
        dialog->findChild<QSpinBox *>("receiverPortBox")->setValue(port);
        const auto apply = [&] {
            QTest::mouseClick(dialog->findChild<QPushButton *>("applyReceiverButton"),
                              Qt::LeftButton);
        };
        apply();
        QVERIFY2(state->text().contains("no DICOM server"), qPrintable(state->text()));
        addServer("archive", m_dcmqrscp->port());
        QVERIFY2(state->text().contains(QString::number(port)), qPrintable(state->text()));
        save("receiving");
        archive::Server us;
        us.peer.host = "127.0.0.1";
        us.peer.port = port;
        us.peer.calledAe = "PELLUCID";
        us.peer.callingAe = "STRANGER";
        const auto files = filesOfHead();
        QVERIFY_EXCEPTION_THROWN(archive::send(us, files), task::Error);
        QTRY_VERIFY_WITH_TIMEOUT(problems().contains("127.0.0.1"), patienceMs);
        QCOMPARE(rows(), QStringList());
        us.peer.callingAe = "COMMON";
        QVERIFY(archive::send(us, files).notSent.empty());
        QTRY_COMPARE_WITH_TIMEOUT(rows(), QStringList{"Secret Name"}, patienceMs);
        QTRY_COMPARE_WITH_TIMEOUT(bench().receiver.receivedCount(), qint64(files.size()),
                                  patienceMs);
        // It goes on after a restart, and ends when it is turned off.
        dialog->close();
        restart();
        QTRY_VERIFY_WITH_TIMEOUT(bench().receiver.isListening(), patienceMs);
        bench().receiver.setSettings({});
        QVERIFY(!bench().receiver.isListening());
        QVERIFY_EXCEPTION_THROWN(archive::send(us, files), task::Error);
    }

    // The receiver has the port to which a server sends what is asked for by C-MOVE.
    void aServerThatOnlySendsUsesTheReceiver() {
        archive::Server server = addServer("archive", m_dcmqrscp->port());
        server.retrieve = archive::RetrieveMethod::move;
        bench().servers.put(server);
        ui::ReceiverSettings settings;
        settings.isOn = true;
        settings.port = m_dcmqrscp->destinationPort;
        bench().receiver.setSettings(settings);
        QVERIFY(bench().receiver.isListening());
        ui::RemoteStudy study;
        study.study.uid = studyUid();
        study.servers = QStringList{"archive"};
        bench().transfers.add(study, &mainWindow());
        QTRY_VERIFY_WITH_TIMEOUT(bench().transfers.transfers().front().state ==
                                     archive::TransferState::complete,
                                 patienceMs);
        QCOMPARE(bench().transfers.transfers().front().received, std::size_t(80));
        QTRY_COMPARE_WITH_TIMEOUT(rows(), QStringList{"Secret Name"}, patienceMs);
    }

    void earlierStudiesOfThePatientOpenBeside() {
        const Dcmqrscp archives;
        const archive::Server server = addServer("archive", archives.port());
        const auto write = [&](const char *folder, const char *name) {
            const auto lattice = phantom::phantomLattice(phantom::Kind::chest,
                                                         {.size = volume::GridSize{48, 48, 24}});
            dicom::writeCtSeries(
                m_folder / folder, phantom::makePhantom(phantom::Kind::chest, lattice),
                {.patientName = name, .patientId = "4711"}, dicom::TransferSyntax::explicitLittle);
            std::vector<std::filesystem::path> files;
            for (const auto &entry : std::filesystem::directory_iterator(m_folder / folder))
                files.push_back(entry.path());
            return files;
        };
        write("now", "Miller^Ann");
        QVERIFY(archive::send(server, write("earlier", "MILLER^ANN ")).notSent.empty());
        QVERIFY(archive::send(server, write("other", "Zhang^Wei")).notSent.empty());
        find<QDockWidget>("earlierDock")->show();
        auto *const earlier = find<QTreeWidget>("earlierTree");
        open(QString::fromStdString((m_folder / "now").string()));
        // One of the same patient, and one under the heading of the uncertain.
        QTRY_COMPARE_WITH_TIMEOUT(earlier->topLevelItemCount(), 3, patienceMs);
        QVERIFY(earlier->topLevelItem(1)->text(0).contains("different patient"));
        save("earlier");
        const auto click = [&](int row) {
            QTest::mouseClick(earlier->viewport(), Qt::LeftButton, {},
                              earlier->visualItemRect(earlier->topLevelItem(row)).center());
        };
        // Another patient's study does not open by a slip of the hand.
        click(2);
        auto *const question = mainWindow().findChild<QDialog *>("otherPatientQuestion");
        QVERIFY(question != nullptr);
        question->reject();
        QVERIFY(bench().transfers.transfers().empty());
        click(0);
        QTRY_VERIFY_WITH_TIMEOUT(mainWindow().findChild<ui::StudyBeside *>() != nullptr,
                                 patienceMs);
        auto *const beside = mainWindow().findChild<ui::StudyBeside *>();
        QTRY_VERIFY_WITH_TIMEOUT(beside->document().volume().has_value(), patienceMs);
        QCOMPARE(document().sources().front().study.patientName, QString("Miller^Ann"));
        save("earlier_beside");
        // In advance: without a click, and without opening anything.
        forgetEverything();
        restart();
        addServer("archive", archives.port());
        find<QDockWidget>("earlierDock")->show();
        auto *const inAdvance = find<QComboBox>("inAdvanceBox");
        inAdvance->setCurrentIndex(1);
        emit inAdvance->activated(1);
        find<QDockWidget>("earlierDock")->hide();
        open(QString::fromStdString((m_folder / "now").string()));
        QTRY_VERIFY_WITH_TIMEOUT(!bench().transfers.transfers().empty() &&
                                     bench().transfers.transfers().front().state ==
                                         archive::TransferState::complete,
                                 patienceMs);
        QCOMPARE(bench().transfers.transfers().size(), std::size_t(1));
        QVERIFY(mainWindow().findChild<ui::StudyBeside *>() == nullptr);
        QCOMPARE(document().sources().size(), std::size_t(1));
    }

    // Identifiers are unique within a hospital only.
    void patientsAreToldApart() {
        ui::StudyFacts a;
        a.patientId = "4711";
        a.patientName = "Miller^Ann";
        a.birthDate = "19500131";
        const auto same = [&](const char *id, const char *name, const char *date) {
            ui::StudyFacts b;
            b.patientId = id;
            b.patientName = QString::fromUtf8(name);
            b.birthDate = date;
            return ui::samePatient(a, b);
        };
        QVERIFY(same("4711", "Miller^Ann", "19500131") == ui::SamePatient::yes);
        QVERIFY(same("4711 ", "MILLER ANN", "") == ui::SamePatient::yes);
        QVERIFY(same("4711", "Smith^Ann", "19500131") == ui::SamePatient::yes); // married
        QVERIFY(same("4711", "Zhang^Wei", "19800101") == ui::SamePatient::perhaps);
        QVERIFY(same("A-9", "Miller^Ann", "19500131") == ui::SamePatient::perhaps);
        QVERIFY(same("A-9", "Miller^Ann", "") == ui::SamePatient::no);
        QVERIFY(same("A-9", "Miller^Ann", "19510131") == ui::SamePatient::no);
        a.patientId.clear();
        QVERIFY(same("", "Zhang^Wei", "") == ui::SamePatient::no); // neither has an identifier
    }

    void aLinkOpensAStudyOfAKnownServer() {
        addServer("archive", m_dcmqrscp->port());
        const QString link = "pellucid://open?server=archive&studyUID=" + studyUid();
        mainWindow().openLink(link);
        auto *question = mainWindow().findChild<QMessageBox *>("linkQuestion");
        QVERIFY(question != nullptr);
        question->reject();
        QVERIFY(bench().transfers.transfers().empty());
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        mainWindow().openLink(link);
        question = mainWindow().findChild<QMessageBox *>("linkQuestion");
        QVERIFY(question != nullptr);
        for (QAbstractButton *const button : question->buttons())
            if (question->buttonRole(button) == QMessageBox::AcceptRole)
                button->click();
        QTRY_VERIFY_WITH_TIMEOUT(document().volume() && !document().isPreview(), patienceMs);
        settle();
        // Allowed once, it is not asked again; and a program that runs takes the link of another.
        restart();
        ui::LinkPort port;
        connect(&port, &ui::LinkPort::linkReceived, &mainWindow(), &ui::MainWindow::openLink);
        std::atomic<bool> isTaken = false;
        std::jthread other([&] { isTaken = ui::LinkPort::handOver(link); });
        QTRY_VERIFY_WITH_TIMEOUT(document().volume() && !document().isPreview(), patienceMs);
        other.join();
        QVERIFY(isTaken);
        settle();
        // What is wrong is reported, and nothing is asked.
        mainWindow().openLink("pellucid://open?server=elsewhere&studyUID=1.2.3");
        QVERIFY2(problems().contains("there is no server 'elsewhere'"), qPrintable(problems()));
        for (const char *const wrong :
             {"pellucid://open", "pellucid://open?server=archive",
              "pellucid://open?server=archive&studyUID=1.2.x", "http://open?server=a&studyUID=1.2",
              "pellucid://close?server=archive&studyUID=1.2",
              "pellucid://open?server=archive&studyUID=1.2&file=/etc/passwd",
              "pellucid://open?server=a&server=b&studyUID=1.2"})
            QVERIFY_EXCEPTION_THROWN(ui::openRequestOf(wrong), task::Error);
        mainWindow().openLink("pellucid://open?server=archive&studyUID=1.2.3.999");
        QTRY_VERIFY_WITH_TIMEOUT(problems().contains("no such study"), patienceMs);
    }

    void theWordsOfASearchHaveMeanings() {
        const archive::SearchTerms terms = ui::searchTermsOf("Miller Ann 2026-01-15 CT A4711");
        QCOMPARE(QString::fromStdString(terms.patientName), QString("*Miller*Ann*"));
        QCOMPARE(QString::fromStdString(terms.date), QString("20260115"));
        QCOMPARE(QString::fromStdString(terms.modality), QString("CT"));
        QCOMPARE(QString::fromStdString(terms.patientId), QString("*A4711*"));
        QVERIFY(ui::searchTermsOf(" ").patientName.empty());
        // Eight digits that are no day are an identifier.
        QCOMPARE(QString::fromStdString(ui::searchTermsOf("20260230").patientId),
                 QString("*20260230*"));
    }

private:
    static void enter(QDialog &dialog, const QString &name, int port) {
        dialog.findChild<QLineEdit *>("serverNameEdit")->setText(name);
        dialog.findChild<QLineEdit *>("serverAeEdit")->setText("COMMON");
        dialog.findChild<QLineEdit *>("serverHostEdit")->setText("127.0.0.1");
        dialog.findChild<QSpinBox *>("serverPortBox")->setValue(port);
    }
    std::vector<std::filesystem::path> filesOfHead() const {
        std::vector<std::filesystem::path> files;
        for (const auto &entry : std::filesystem::directory_iterator(m_folder / "head"))
            files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        return files;
    }
    archive::Server addServer(const std::string &name, int port) {
        archive::Server server;
        server.name = name;
        server.peer.host = "127.0.0.1";
        server.peer.port = port;
        server.peer.calledAe = "COMMON";
        bench().servers.put(server);
        return server;
    }
    QString studyUid() const {
        archive::Server server = bench().servers.servers().front();
        return QString::fromStdString(
            archive::search({server}, {}).entries.at(0).text(network::tag::studyUid));
    }

    std::unique_ptr<Dcmqrscp> m_dcmqrscp;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::ServersTest>(argc, argv);
}

#include "servers_test.moc"
