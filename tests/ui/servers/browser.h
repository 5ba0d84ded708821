// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtTest>

#include <string>

#include <QAbstractButton>
#include <QApplication>
#include <QDesktopServices>
#include <QStringList>
#include <QUrl>
#include <QWidget>

#include "core/archive/server.h"
#include "core/network/client/peer.h"
#include "tests/network/login_server.h"
#include "tests/ui/patience.h"

/// Logging in to servers, and the user who does it.
namespace pellucid::test {

/// Gets the pages that the program opens, in place of the desktop's browser, and the user in front
/// of it.
class Browser : public QObject {
    Q_OBJECT
public:
    Browser() { QDesktopServices::setUrlHandler("http", this, "open"); }
    ~Browser() override { QDesktopServices::unsetUrlHandler("http"); }

    const QStringList &pages() const { return m_pages; }

    /// Logs in on the last page. Returns what the browser shows then.
    QString logIn(LoginServer &server) const { return logInOn(m_pages.last(), server); }
    static QString logInOn(const QString &page, LoginServer &server) {
        server.expect(page.toStdString());
        return redirect(page, "code=the-code");
    }
    /// Refuses to log in on the last page. Returns what the browser shows then.
    QString deny() const { return redirect(m_pages.last(), "error=access_denied"); }

public slots:
    void open(const QUrl &page) { m_pages << page.toString(QUrl::FullyEncoded); }

private:
    static QString redirect(const QString &page, const std::string &answer) {
        const std::string url = page.toStdString();
        Fields fields = fieldsOf(url.substr(url.find('?') + 1));
        return QString::fromStdString(
            visit(fields["redirect_uri"] + "?" + answer + "&state=" + fields["state"]));
    }

    QStringList m_pages;
};

/// A DICOMweb server with a login at this login server.
inline archive::Server serverWithLogin(const std::string &name, const WebServer &web,
                                       const LoginServer &login) {
    archive::Server server;
    server.name = name;
    server.peer = archive::webPeer(web.url());
    server.peer.authentication = network::Authentication::oauth;
    server.loginSettings.issuer = login.url();
    server.loginSettings.clientId = "pellucid";
    server.loginSettings.scope = "openid offline_access";
    return server;
}

inline void click(const QWidget &parent, const char *button) {
    auto *const found = parent.findChild<QAbstractButton *>(button);
    QVERIFY2(found != nullptr && found->isEnabled(), button);
    QTest::mouseClick(found, Qt::LeftButton);
}

/// Runs the tests of a class that shows dialogs, without a display and without a browser.
template <class Test> int runOffscreen(int argc, char **argv) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    QApplication::setApplicationName("pellucid-test");
    QApplication::setOrganizationName("pellucid-test");
    Test test;
    return QTest::qExec(&test, argc, argv);
}

} // namespace pellucid::test
