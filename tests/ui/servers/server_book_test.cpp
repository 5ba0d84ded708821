// SPDX-License-Identifier: GPL-3.0-or-later
// Servers and their secrets without a keychain: secrets last for the run of the program.
#include "tests/ui/servers/server_books.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <QDialogButtonBox>
#include <QInputDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>

#include "tests/support/files.h"

namespace pellucid {

using namespace test;
using network::Authentication;

class ServerBookTest : public ServerBooks {
    Q_OBJECT
private slots:
    void init() { startAnew(); }
    void cleanup() { waitForKeychain(); }

    void aSecretLastsForTheRun() {
        book().put(withPassword("a", 4711, "open sesame"));
        QCOMPARE(secretOf("a"), QString("open sesame"));
        QVERIFY(!readText(m_folder / "data/pellucid/servers.json").empty());
        QVERIFY(readText(m_folder / "data/pellucid/servers.json").find("sesame") ==
                std::string::npos);
        restart();
        QCOMPARE(book().names(), QStringList{"a"});
        QCOMPARE(secretOf("a"), QString("none"));
        const auto answer = ask({"a"}, m_asking.get());
        enter("open sesame");
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(answer->servers->size(), std::size_t(1));
        QCOMPARE(answer->servers->at(0).peer.secret, std::string("open sesame"));
        QCOMPARE(secretOf("a"), QString("open sesame")); // without asking
    }

    // Nobody enters the token of one server for another.
    void theQuestionNamesTheServerAndWhatIsAskedFor() {
        book().put(server("first", 4711, Authentication::basic));
        book().put(server("second", 4712, Authentication::bearer));
        book().put(withKey("third", ""));
        const auto answer = ask({"first", "second", "third"}, m_asking.get());
        QCOMPARE(enter("a"), QString("Password of ann at first"));
        QCOMPARE(enter("b"), QString("Token for second"));
        QCOMPARE(enter("c"), QString("Password of the private key for third"));
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(answer->servers->size(), std::size_t(3));
        QCOMPARE(answer->servers->at(0).peer.secret, std::string("a"));
        QCOMPARE(answer->servers->at(1).peer.secret, std::string("b"));
        QCOMPARE(answer->servers->at(2).peer.keyPassword, std::string("c"));
    }

    void aServerWhoseSecretIsNotEnteredIsLeftOut() {
        book().put(server("first", 4711, Authentication::basic));
        book().put(server("second", 4712, Authentication::basic));
        book().put(server("third", 4713, Authentication::none));
        const auto answer = ask({"first", "second", "third"}, m_asking.get());
        QDialog *const dialog = question("secretDialog");
        QVERIFY(dialog != nullptr);
        QTest::keyClick(dialog, Qt::Key_Escape);
        QVERIFY(!dialog->isVisible());
        enter("b");
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(namesOf(*answer->servers), (QStringList{"second", "third"}));
        // Without a user, nobody is asked.
        restart();
        QCOMPARE(namesOf(known({"first", "second", "third"})), QStringList{"third"});
    }

    // The window that asks is closed.
    void aQuestionThatDisappearsLeavesTheServerOut() {
        book().put(server("a", 4711, Authentication::basic));
        book().put(withLogin("web"));
        for (const auto &[name, dialog] :
             {std::pair{"a", "secretDialog"}, std::pair{"web", "loginDialog"}}) {
            const auto answer = ask({name}, m_asking.get());
            QVERIFY(question(dialog) != nullptr);
            m_asking = std::make_unique<QWidget>();
            m_asking->show();
            QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
            QVERIFY(answer->servers->empty());
        }
    }

    void aSecretIsNotGivenToAnotherAddress() {
        book().put(withPassword("a", 4711, "open sesame"));
        book().put(withPassword("a", 4712, ""));
        QCOMPARE(secretOf("a"), QString("none"));
        archive::Server elsewhere = withPassword("a", 4711, "");
        elsewhere.peer.host = "localhost";
        book().put(elsewhere);
        QCOMPARE(secretOf("a"), QString("none"));
    }

    // The user tests it before it is saved.
    void aSecretIsNotGivenToAnUnsavedAddress() {
        book().put(withPassword("a", 4711, "open sesame"));
        QCOMPARE(secretsOf(withPassword("a", 4712, "")), QStringList());
        QCOMPARE(secretsOf(withPassword("a", 4711, "")), QStringList{"open sesame"});
        QCOMPARE(secretsOf(withPassword("a", 4712, "own")), QStringList{"own"});
    }

    void aRemovedServerIsForgotten() {
        book().put(withPassword("a", 4711, "open sesame"));
        book().put(withKey("b", "open barley"));
        const QSignalSpy changes(&book(), &ui::ServerBook::changed);
        book().remove("a");
        book().remove("b");
        QCOMPARE(changes.size(), 2);
        QCOMPARE(book().names(), QStringList());
        QVERIFY(known({"a", "b"}).empty());
        book().put(withPassword("a", 4711, ""));
        book().put(withKey("b", ""));
        QVERIFY(known({"a", "b"}).empty());
    }

    void aRefusedSecretIsAskedForAgain() {
        book().put(withPassword("a", 4711, "open barley"));
        book().forgetSecret("a");
        const auto answer = ask({"a"}, m_asking.get());
        enter("open sesame");
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(answer->servers->size(), std::size_t(1));
        QCOMPARE(answer->servers->at(0).peer.secret, std::string("open sesame"));
    }

    void aLoginLastsForTheRun() {
        book().put(withLogin("web"));
        QVERIFY(known({"web"}).empty());
        const auto answer = ask({"web"}, m_asking.get());
        logIn();
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(namesOf(*answer->servers), QStringList{"web"});
        QVERIFY(answer->servers->at(0).login->hasToken());
        // It is used again.
        const Servers again = known({"web"});
        QCOMPARE(again.size(), std::size_t(1));
        QCOMPARE(again.at(0).login, answer->servers->at(0).login);
        QCOMPARE(m_browser->pages().size(), 1);
        restart();
        QVERIFY(known({"web"}).empty());
    }

    // A search and a retrieval that need the same login ask the user once.
    void twoThatNeedALoginShareIt() {
        book().put(withLogin("web"));
        const auto first = ask({"web"}, m_asking.get()), second = ask({"web"}, m_asking.get());
        logIn();
        QTRY_VERIFY_WITH_TIMEOUT(first->servers.has_value() && second->servers.has_value(),
                                 patienceMs);
        QCOMPARE(m_browser->pages().size(), 1);
        QCOMPARE(first->servers->size(), std::size_t(1));
        QCOMPARE(second->servers->size(), std::size_t(1));
        QCOMPARE(first->servers->at(0).login, second->servers->at(0).login);
        QCOMPARE(m_loginServer->tokenRequests().size(), std::size_t(1));
    }

    void aCancelledLoginLeavesTheServerOut() {
        book().put(withLogin("web"));
        book().put(server("open", 4711, Authentication::none));
        const auto answer = ask({"web", "open"}, m_asking.get());
        QDialog *const dialog = question("loginDialog");
        QVERIFY(dialog != nullptr);
        QVERIFY2(dialog->windowTitle().contains("web"), qPrintable(dialog->windowTitle()));
        QTest::keyClick(dialog, Qt::Key_Escape);
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(namesOf(*answer->servers), QStringList{"open"});
        // The next search asks again.
        const auto next = ask({"web"}, m_asking.get());
        logIn();
        QTRY_VERIFY_WITH_TIMEOUT(next->servers.has_value(), patienceMs);
        QCOMPARE(namesOf(*next->servers), QStringList{"web"});
    }

    void aLoginIsForgottenWithItsServer() {
        book().put(withLogin("web"));
        const auto answer = ask({"web"}, m_asking.get());
        logIn();
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(answer->servers->size(), std::size_t(1));
        const auto login = answer->servers->at(0).login;
        book().remove("web");
        QVERIFY(!login->isLoggedIn()); // also where it is in use
        book().put(withLogin("web"));
        QVERIFY(known({"web"}).empty());
    }

    // A token goes only to the login server that gave it.
    void aLoginIsForgottenWithItsAddresses() {
        book().put(withLogin("web"));
        const auto answer = ask({"web"}, m_asking.get());
        logIn();
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(answer->servers->size(), std::size_t(1));
        archive::Server other = withLogin("web");
        other.loginSettings.clientId = "another";
        book().put(other);
        QVERIFY(!answer->servers->at(0).login->isLoggedIn());
        QVERIFY(known({"web"}).empty());
        book().put(withLogin("web"));
        QVERIFY(known({"web"}).empty());
    }

    void aRefusedLoginIsAskedForAgain() {
        book().put(withLogin("web"));
        const auto answer = ask({"web"}, m_asking.get());
        logIn();
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(answer->servers->size(), std::size_t(1));
        book().forgetSecret("web");
        QVERIFY(known({"web"}).empty());
        const auto next = ask({"web"}, m_asking.get());
        logIn();
        QTRY_VERIFY_WITH_TIMEOUT(next->servers.has_value(), patienceMs);
        QCOMPARE(next->servers->size(), std::size_t(1));
        QVERIFY(next->servers->at(0).login->hasToken());
    }

private:
    static QStringList namesOf(const Servers &servers) {
        QStringList names;
        for (const archive::Server &server : servers)
            names << QString::fromStdString(server.name);
        return names;
    }
    // What the book gives for a server that need not be saved, without asking the user.
    QStringList secretsOf(const archive::Server &server) const {
        std::optional<Servers> found;
        book().withSecrets(Servers{server}, nullptr,
                           [&](const Servers &servers) { found = servers; });
        if (!QTest::qWaitFor([&] { return found.has_value(); }, patienceMs))
            qFatal("no answer");
        QStringList secrets;
        for (const archive::Server &complete : *found)
            secrets << QString::fromStdString(complete.peer.secret);
        return secrets;
    }
    // Answers the question for a secret. Returns the question.
    QString enter(const char *secret) const {
        auto *const dialog = qobject_cast<QInputDialog *>(question("secretDialog"));
        if (dialog == nullptr)
            return "no question";
        const QString text = dialog->labelText();
        auto *const edit = dialog->findChild<QLineEdit *>();
        if (edit->echoMode() != QLineEdit::Password)
            return "others can read the secret";
        QTest::keyClicks(edit, secret);
        QTest::mouseClick(dialog->findChild<QDialogButtonBox *>()->button(QDialogButtonBox::Ok),
                          Qt::LeftButton);
        return text;
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    // Away from the keychain of the user who runs the tests.
    qputenv("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent");
    return pellucid::test::runOffscreen<pellucid::ServerBookTest>(argc, argv);
}

#include "server_book_test.moc"
