// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <QDialog>

#include <qt6keychain/keychain.h>

#include "core/archive/login.h"
#include "core/archive/server.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/servers/browser.h"
#include "ui/servers/server_book.h"

namespace pellucid::test {

/// The fixture of tests of ServerBook: a list of servers on disk, books that read it, and servers
/// with a login.
class ServerBooks : public QObject {
protected:
    using Servers = std::vector<archive::Server>;

    /// Forgets the servers on disk, and starts the servers with a login.
    void startAnew() {
        std::filesystem::remove_all(m_folder / "data");
        qputenv("XDG_DATA_HOME", QByteArray::fromStdString((m_folder / "data").string()));
        m_tokens = std::make_unique<Tokens>();
        m_loginServer = std::make_unique<LoginServer>(*m_tokens);
        m_web = std::make_unique<WebServer>(*m_tokens);
        m_browser.reset(); // the new one takes its place in the desktop
        m_browser = std::make_unique<Browser>();
        m_asking = std::make_unique<QWidget>();
        m_asking->show();
        restart();
    }
    /// Another run of the program: another book. The keychain does first what it was asked for.
    void restart() {
        waitForKeychain();
        restartAtOnce();
    }
    /// The same while the keychain works.
    void restartAtOnce() {
        m_book.reset();
        m_book = std::make_unique<ui::ServerBook>();
    }
    /// Waits until the keychain, if there is one, has done all that was asked of it: its jobs run
    /// one after the other.
    static void waitForKeychain() {
        const auto isDone = std::make_shared<bool>(false);
        auto *const last = new QKeychain::ReadPasswordJob("pellucid-test");
        last->setKey("none");
        connect(last, &QKeychain::Job::finished, [isDone] { *isDone = true; });
        last->start();
        QTRY_VERIFY_WITH_TIMEOUT(*isDone, patienceMs);
    }
    ui::ServerBook &book() const { return *m_book; }

    static archive::Server server(const std::string &name, int port,
                                  network::Authentication authentication) {
        archive::Server server;
        server.name = name;
        server.peer = archive::webPeer("http://127.0.0.1:" + std::to_string(port) + "/dicom-web");
        server.peer.authentication = authentication;
        server.peer.user = "ann";
        return server;
    }
    static archive::Server withPassword(const std::string &name, int port,
                                        const std::string &password) {
        archive::Server made = server(name, port, network::Authentication::basic);
        made.peer.secret = password;
        return made;
    }
    archive::Server withLogin(const std::string &name) const {
        return serverWithLogin(name, *m_web, *m_loginServer);
    }
    /// A server that needs a certificate of ours, whose private key has a password.
    archive::Server withKey(const std::string &name, const std::string &password) const {
        const std::filesystem::path key = m_folder / "key.pem";
        std::ofstream(key) << "-----BEGIN ENCRYPTED PRIVATE KEY-----\n";
        archive::Server made = server(name, 4711, network::Authentication::none);
        made.peer.certificate = made.peer.key = key.string();
        made.peer.keyPassword = password;
        return made;
    }

    /// What a book gives for the servers of these names, at once or later.
    struct Answer {
        std::optional<Servers> servers;
    };
    std::shared_ptr<Answer> ask(const QStringList &names, QWidget *asking) const {
        auto answer = std::make_shared<Answer>();
        m_book->withSecrets(names, asking,
                            [answer](const Servers &servers) { answer->servers = servers; });
        return answer;
    }
    /// Waits for what a book gives without asking the user. Servers that lack a secret are left
    /// out.
    Servers known(const QStringList &names) const {
        const auto answer = ask(names, nullptr);
        if (!QTest::qWaitFor([&] { return answer->servers.has_value(); }, patienceMs))
            qFatal("no answer");
        return *answer->servers;
    }
    /// The secret of a server that a book gives without asking the user.
    QString secretOf(const QString &name) const {
        const Servers servers = known({name});
        return servers.empty() ? "none" : QString::fromStdString(servers.front().peer.secret);
    }
    /// Waits until the user is asked for something. *Shape*: null if that does not happen.
    QDialog *question(const char *name) const {
        QDialog *found = nullptr;
        (void)QTest::qWaitFor(
            [&] {
                for (auto *const dialog : m_asking->findChildren<QDialog *>(name))
                    if (dialog->isVisible())
                        found = dialog;
                return found != nullptr;
            },
            patienceMs);
        return found;
    }
    /// The user logs in on the page that the program asks for.
    void logIn() const {
        QDialog *const dialog = question("loginDialog");
        QVERIFY(dialog != nullptr);
        const auto pages = m_browser->pages().size();
        click(*dialog, "openLoginButton");
        QTRY_COMPARE_WITH_TIMEOUT(m_browser->pages().size(), pages + 1, patienceMs);
        m_browser->logIn(*m_loginServer);
    }

    TemporaryFolder m_folder;
    std::unique_ptr<Tokens> m_tokens;
    std::unique_ptr<LoginServer> m_loginServer;
    std::unique_ptr<WebServer> m_web;
    std::unique_ptr<Browser> m_browser;
    std::unique_ptr<QWidget> m_asking;

private:
    std::unique_ptr<ui::ServerBook> m_book;
};

} // namespace pellucid::test
