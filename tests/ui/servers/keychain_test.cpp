// SPDX-License-Identifier: GPL-3.0-or-later
// Secrets of servers in a real keychain. `tests/ui/with_keychain.sh` starts one for this program.
#include "tests/ui/servers/server_books.h"

#include <memory>
#include <optional>
#include <string>

#include <QProcess>
#include <QRegularExpression>

namespace pellucid {

using namespace test;

class KeychainTest : public ServerBooks {
    Q_OBJECT
private slots:
    void initTestCase() {
        if (qEnvironmentVariableIsEmpty("PELLUCID_TEST_KEYCHAIN"))
            QSKIP("these tests do not use the user's keychain: run them by with_keychain.sh");
    }
    void init() {
        for (const QString &item : items())
            call(item, "org.freedesktop.Secret.Item.Delete");
        QCOMPARE(items(), QStringList());
        startAnew();
    }

    void cleanup() { waitForKeychain(); }

    void aSecretIsFoundByTheNextRun() {
        book().put(withPassword("a", 4711, "open sesame"));
        book().put(withKey("b", "open barley"));
        expectItems(2);
        restart();
        QCOMPARE(secretOf("a"), QString("open sesame"));
        const Servers found = known({"b"});
        QCOMPARE(found.size(), std::size_t(1));
        QCOMPARE(found.front().peer.keyPassword, std::string("open barley"));
        // A new one replaces it, and none leaves it as it is.
        book().put(withPassword("a", 4711, "open wheat"));
        book().put(withPassword("a", 4711, ""));
        expectItems(2);
        restart();
        QCOMPARE(secretOf("a"), QString("open wheat"));
    }

    // Whatever its characters.
    void aSecretIsKeptAsItIs() {
        for (const char *const secret :
             {"%1 %2", "a\nb", "\xe5\xaf\x86\xe7\xa2\xbc", " ", "\\ \" '", "0123456789abcdef"}) {
            book().put(withPassword("a", 4711, secret));
            restart();
            QCOMPARE(secretOf("a"), QString::fromUtf8(secret));
        }
        const std::string longest(8000, 'x'); // tokens may be long
        book().put(withPassword("a", 4711, longest));
        restart();
        QCOMPARE(secretOf("a"), QString::fromStdString(longest));
    }

    void aRemovedServersSecretIsGone() {
        book().put(withPassword("a", 4711, "open sesame"));
        book().put(withKey("b", "open barley"));
        expectItems(2);
        restart(); // not only what this run knows
        book().remove("a");
        book().remove("b");
        expectItems(0);
        book().put(withPassword("a", 4711, ""));
        book().put(withKey("b", ""));
        restart();
        QVERIFY(known({"a", "b"}).empty());
        // One that is removed as soon as it is entered leaves nothing.
        book().put(withPassword("c", 4711, "open sesame"));
        book().remove("c");
        expectItems(0);
    }

    void aSecretIsNotGivenToAnotherAddress() {
        book().put(withPassword("a", 4711, "open sesame"));
        expectItems(1);
        archive::Server elsewhere = withPassword("a", 4711, "");
        elsewhere.peer.host = "localhost";
        for (const archive::Server &other : {withPassword("a", 4712, ""), elsewhere}) {
            book().put(other);
            restart();
            QCOMPARE(secretOf("a"), QString("none"));
        }
        // Nor does it stay where nobody would remove it.
        book().remove("a");
        expectItems(0);
    }

    void aRefusedSecretIsNotFoundAgain() {
        book().put(withPassword("a", 4711, "open barley"));
        restart();
        QCOMPARE(secretOf("a"), QString("open barley"));
        book().forgetSecret("a");
        QCOMPARE(secretOf("a"), QString("none"));
        restart();
        QCOMPARE(secretOf("a"), QString("none"));
    }

    // What the user has entered just before the program ends, is kept.
    void aBookMayEndWhileTheKeychainWorks() {
        book().put(withPassword("a", 4711, "open sesame"));
        restartAtOnce();
        QCOMPARE(secretOf("a"), QString("open sesame"));
        restartAtOnce();
        const auto answer = ask({"a"}, nullptr);
        restartAtOnce();
        waitForKeychain();
        QVERIFY(!answer->servers.has_value());
        book().remove("a");
        restartAtOnce();
        expectItems(0);
    }

    // Only the token that renews a login is kept.
    void aLoginIsFoundByTheNextRun() {
        enterWithLogin();
        expectItems(1);
        const std::string kept = m_loginServer->refreshToken();
        restart();
        const Servers found = known({"web"});
        QCOMPARE(found.size(), std::size_t(1));
        QVERIFY(found.front().login->hasToken());
        QCOMPARE(m_browser->pages().size(), 1);
        Fields renewal = m_loginServer->tokenRequests().back();
        QCOMPARE(renewal["grant_type"], std::string("refresh_token"));
        QCOMPARE(renewal["refresh_token"], kept);
        // The login server gave a new one, which is kept in place of the old one.
        const std::string renewed = m_loginServer->refreshToken();
        QVERIFY(renewed != kept);
        expectItems(1);
        restart();
        QCOMPARE(known({"web"}).size(), std::size_t(1));
        QCOMPARE(m_loginServer->tokenRequests().back().at("refresh_token"), renewed);
    }

    // The user tests a server before saving it.
    void aLoginIsKeptWhenItsServerIsSaved() {
        std::optional<Servers> found;
        book().withSecrets(Servers{withLogin("web")}, m_asking.get(),
                           [&](const Servers &servers) { found = servers; });
        logIn();
        QTRY_VERIFY_WITH_TIMEOUT(found.has_value(), patienceMs);
        QCOMPARE(found->size(), std::size_t(1));
        expectItems(0);
        book().put(withLogin("web"));
        expectItems(1);
        restart();
        QCOMPARE(known({"web"}).size(), std::size_t(1));
    }

    void aLoginIsForgottenWithItsServer() {
        enterWithLogin();
        expectItems(1);
        restart();
        book().remove("web");
        expectItems(0);
        book().put(withLogin("web"));
        QVERIFY(known({"web"}).empty());
    }

    void aLoginIsForgottenWithItsAddresses() {
        enterWithLogin();
        expectItems(1);
        restart();
        archive::Server other = withLogin("web");
        other.loginSettings.clientId = "another";
        book().put(other);
        expectItems(0);
        QVERIFY(known({"web"}).empty());
    }

    void aLoginThatIsNotRenewedIsForgotten() {
        enterWithLogin();
        expectItems(1);
        restart();
        m_loginServer->refuseToRenew();
        const auto answer = ask({"web"}, m_asking.get());
        logIn(); // the user is asked
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(answer->servers->size(), std::size_t(1));
        expectItems(1);
        restart();
        QCOMPARE(known({"web"}).size(), std::size_t(1));
        m_loginServer->refuseToRenew();
        restart();
        QVERIFY(known({"web"}).empty());
        expectItems(0);
    }

    // A login server that cannot be reached has not refused anything.
    void aLoginSurvivesALoginServerThatIsAway() {
        enterWithLogin();
        expectItems(1);
        restart();
        m_loginServer->lie({503, "text/plain", "", ""});
        const Servers found = known({"web"});
        QCOMPARE(found.size(), std::size_t(1)); // whoever connects reports it
        QVERIFY(!found.front().login->hasToken());
        QVERIFY(found.front().login->isLoggedIn());
        expectItems(1);
    }

private:
    void enterWithLogin() {
        book().put(withLogin("web"));
        const auto answer = ask({"web"}, m_asking.get());
        logIn();
        QTRY_VERIFY_WITH_TIMEOUT(answer->servers.has_value(), patienceMs);
        QCOMPARE(answer->servers->size(), std::size_t(1));
    }

    // What a method of the keychain answers.
    static QString call(const QString &path, const QString &method,
                        const QStringList &arguments = {}) {
        QProcess process;
        process.start("gdbus", QStringList{"call", "--session", "--dest", "org.freedesktop.secrets",
                                           "--object-path", path, "--method", method} +
                                   arguments);
        if (!process.waitForFinished(patienceMs) || process.exitCode() != 0)
            qFatal("the keychain fails: %s", process.readAllStandardError().constData());
        return QString::fromUtf8(process.readAllStandardOutput());
    }
    static QStringList items() {
        static const QString collection = "/org/freedesktop/secrets/collection/login";
        const QString answer = call(collection, "org.freedesktop.DBus.Properties.Get",
                                    {"org.freedesktop.Secret.Collection", "Items"});
        QStringList found;
        for (auto matches = QRegularExpression(collection + "/[^']+").globalMatch(answer);
             matches.hasNext();)
            found << matches.next().captured();
        return found;
    }
    static void expectItems(int count) {
        waitForKeychain();
        QCOMPARE(items().size(), count);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::runOffscreen<pellucid::KeychainTest>(argc, argv);
}

#include "keychain_test.moc"
