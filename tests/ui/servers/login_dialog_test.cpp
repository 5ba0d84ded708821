// SPDX-License-Identifier: GPL-3.0-or-later
// The dialog that waits while the user logs in in the browser.
#include "tests/ui/servers/browser.h"

#include <memory>
#include <unistd.h>
#include <vector>

#include <QClipboard>
#include <QDialogButtonBox>
#include <QElapsedTimer>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

#include "core/archive/login.h"
#include "core/archive/reasons.h"
#include "core/archive/server.h"
#include "core/network/process/reasons.h"
#include "core/task/reason.h"
#include "ui/servers/login_dialog.h"

namespace pellucid {

using namespace test;
using ui::LoginDialog;
namespace because = task::because;

class LoginDialogTest : public QObject {
    Q_OBJECT
private slots:
    void init() {
        m_tokens = std::make_unique<Tokens>();
        m_loginServer = std::make_unique<LoginServer>(*m_tokens);
        m_web = std::make_unique<WebServer>(*m_tokens);
        m_browser.reset(); // the new one takes its place in the desktop
        m_browser = std::make_unique<Browser>();
        m_kept.clear();
        show(serverWithLogin("Web", *m_web, *m_loginServer));
    }
    void cleanup() { m_dialog.reset(); }

    void theUserLogsInInTheBrowser() {
        QVERIFY2(message().contains("Web"), qPrintable(message()));
        QVERIFY(!button("copyLoginButton")->isEnabled()); // there is no address yet
        openPage();
        QVERIFY2(m_browser->pages().last().startsWith(
                     QString::fromStdString(m_loginServer->url() + "/authorize?policy=a&")),
                 qPrintable(m_browser->pages().last()));
        QCOMPARE(message(), QString("Log in to Web in the browser."));
        QVERIFY(m_ends->isEmpty());
        const QString shown = m_browser->logIn(*m_loginServer);
        QVERIFY2(shown.contains("You are logged in"), qPrintable(shown));
        expectEnd(QDialog::Accepted);
        QVERIFY(m_login->hasToken());
        QCOMPARE(m_kept, std::vector<std::string>{m_loginServer->refreshToken()});
        QCOMPARE(m_browser->pages().size(), 1);
    }

    // The user has closed the page, or uses another browser.
    void thePageIsOpenedAgainAndCopied() {
        openPage();
        click(*m_dialog, "openLoginButton");
        QCOMPARE(m_browser->pages().size(), 2);
        QCOMPARE(m_browser->pages()[1], m_browser->pages()[0]);
        click(*m_dialog, "copyLoginButton");
        QCOMPARE(QGuiApplication::clipboard()->text(), m_browser->pages()[0]);
        m_browser->logIn(*m_loginServer);
        expectEnd(QDialog::Accepted);
    }

    void withoutABrowserTheAddressIsCopied() {
        m_browser.reset();
        click(*m_dialog, "openLoginButton");
        QTRY_VERIFY_WITH_TIMEOUT(message().contains("No browser"), patienceMs);
        click(*m_dialog, "copyLoginButton");
        Browser::logInOn(QGuiApplication::clipboard()->text(), *m_loginServer);
        expectEnd(QDialog::Accepted);
        QVERIFY(m_login->hasToken());
    }

    void aDeniedLoginIsReportedAndTriedAgain() {
        openPage();
        const QString shown = m_browser->deny();
        QVERIFY2(shown.contains("The login failed"), qPrintable(shown));
        expectMessage(because::loginIsDenied);
        QVERIFY(m_dialog->isVisible());
        QVERIFY(!button("copyLoginButton")->isEnabled()); // nobody waits at the old address
        QVERIFY(!m_login->isLoggedIn());
        openPage();
        QVERIFY(m_browser->pages()[0] != m_browser->pages()[1]);
        m_browser->logIn(*m_loginServer);
        expectEnd(QDialog::Accepted);
        QVERIFY(m_login->hasToken());
    }

    void aRefusedCodeIsReported() {
        m_loginServer->lie({400, "application/json", R"({"error": "invalid_client"})", ""});
        openPage();
        m_browser->logIn(*m_loginServer);
        expectMessage(because::loginIsRefused("invalid_client"));
        QVERIFY(!m_login->isLoggedIn());
        QVERIFY(m_kept.empty());
    }

    // Nothing is opened in the browser then.
    void aLoginServerThatCannotBeUsedIsReported() {
        m_loginServer->setIssuer("https://login.example.org");
        click(*m_dialog, "openLoginButton");
        QCOMPARE(message(), QString("Connecting..."));
        QVERIFY(!button("openLoginButton")->isEnabled());
        expectMessage(because::issuerIsAnother("https://login.example.org"));
        archive::Server server = serverWithLogin("Web", *m_web, *m_loginServer);
        server.loginSettings.issuer = "http://127.0.0.1:" + std::to_string(freePort());
        show(server);
        click(*m_dialog, "openLoginButton");
        QTRY_VERIFY_WITH_TIMEOUT(message().contains("check the port"), patienceMs);
        QVERIFY(button("openLoginButton")->isEnabled());
        QVERIFY(m_ends->isEmpty());
        QVERIFY(m_browser->pages().isEmpty());
    }

    void aLoginIsCancelledBeforeAndWhileTheUserLogsIn() {
        cancel();
        expectEnd(QDialog::Rejected);
        show(serverWithLogin("Web", *m_web, *m_loginServer));
        openPage();
        cancel();
        expectEnd(QDialog::Rejected);
        m_dialog.reset(); // waits for the job
        // A user who logs in after all finds nobody who takes the code.
        QCOMPARE(m_browser->logIn(*m_loginServer), QString("no connection"));
        QVERIFY(!m_login->isLoggedIn());
        QVERIFY(m_loginServer->tokenRequests().empty());
        // The keyboard and the frame of the window cancel, too.
        show(serverWithLogin("Web", *m_web, *m_loginServer));
        openPage();
        QTest::keyClick(m_dialog.get(), Qt::Key_Escape);
        expectEnd(QDialog::Rejected);
        show(serverWithLogin("Web", *m_web, *m_loginServer));
        openPage();
        m_dialog->close();
        expectEnd(QDialog::Rejected);
    }

    // Cancelling does not wait for a server that never answers.
    void aSilentLoginServerDoesNotDelayACancel() {
        int port = 0;
        const int silent = listenOn(port);
        archive::Server server = serverWithLogin("Web", *m_web, *m_loginServer);
        server.loginSettings.issuer = "http://127.0.0.1:" + std::to_string(port);
        server.peer.silenceSeconds = 2e-3 * patienceMs;
        show(server);
        click(*m_dialog, "openLoginButton");
        const int connection = ::accept(silent, nullptr, nullptr);
        QVERIFY(connection >= 0);
        QElapsedTimer time;
        time.start();
        cancel();
        expectEnd(QDialog::Rejected);
        m_dialog.reset();
        QVERIFY2(time.elapsed() < patienceMs, "the dialog has waited for the server");
        ::close(connection);
        ::close(silent);
    }

    // The program ends while the user logs in.
    void aDialogIsDestroyedWhileItWaits() {
        openPage();
        m_dialog.reset();
        QVERIFY(m_ends->isEmpty());
        QCOMPARE(m_browser->logIn(*m_loginServer), QString("no connection"));
    }

private:
    void show(const archive::Server &server) {
        m_login = std::make_shared<archive::Login>(
            server, "", [this](const std::string &token) { m_kept.push_back(token); });
        m_dialog =
            std::make_unique<LoginDialog>(QString::fromStdString(server.name), m_login, nullptr);
        m_ends = std::make_unique<QSignalSpy>(m_dialog.get(), &QDialog::finished);
        m_dialog->open();
    }
    // Waits until the browser has the page.
    void openPage() {
        const auto pages = m_browser->pages().size();
        click(*m_dialog, "openLoginButton");
        QTRY_COMPARE_WITH_TIMEOUT(m_browser->pages().size(), pages + 1, patienceMs);
        QVERIFY(button("openLoginButton")->isEnabled());
        QVERIFY(button("copyLoginButton")->isEnabled());
    }
    void cancel() {
        auto *const buttons = m_dialog->findChild<QDialogButtonBox *>();
        QTest::mouseClick(buttons->button(QDialogButtonBox::Cancel), Qt::LeftButton);
    }
    void expectEnd(QDialog::DialogCode code) {
        QTRY_COMPARE_WITH_TIMEOUT(m_ends->size(), 1, patienceMs);
        QCOMPARE(m_ends->first().first().toInt(), int(code));
        QVERIFY(!m_dialog->isVisible());
    }
    // Waits until the dialog reports it, and can be used again.
    void expectMessage(const task::Reason &reason) {
        QTRY_COMPARE_WITH_TIMEOUT(message(), QString::fromStdString(reason.english()), patienceMs);
        QVERIFY(button("openLoginButton")->isEnabled());
        QVERIFY(m_ends->isEmpty());
    }
    QString message() const { return m_dialog->findChild<QLabel *>("loginMessage")->text(); }
    QPushButton *button(const char *name) const { return m_dialog->findChild<QPushButton *>(name); }

    std::unique_ptr<Tokens> m_tokens;
    std::unique_ptr<LoginServer> m_loginServer;
    std::unique_ptr<WebServer> m_web;
    std::unique_ptr<Browser> m_browser;
    std::vector<std::string> m_kept; ///< refresh tokens for the keychain
    std::shared_ptr<archive::Login> m_login;
    std::unique_ptr<LoginDialog> m_dialog;
    std::unique_ptr<QSignalSpy> m_ends;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::runOffscreen<pellucid::LoginDialogTest>(argc, argv);
}

#include "login_dialog_test.moc"
