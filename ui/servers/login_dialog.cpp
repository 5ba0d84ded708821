// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/login_dialog.h"

#include <QClipboard>
#include <QDesktopServices>
#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QPushButton>
#include <QUrl>
#include <QVBoxLayout>

#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

LoginDialog::LoginDialog(const QString &server, std::shared_ptr<archive::Login> login,
                         QWidget *parent)
    : QDialog(parent), m_server(server), m_login(std::move(login)), m_message(new PlainLabel),
      m_open(new QPushButton(tr("&Open the browser"))),
      m_copy(new QPushButton(tr("&Copy the address"))) {
    setObjectName("loginDialog");
    setWindowTitle(tr("Log in to %1").arg(titleText(server)));
    m_message->setObjectName("loginMessage");
    m_message->setWordWrap(true);
    m_message->setMinimumWidth(360);
    m_message->setText(tr("The server %1 asks for a login in the browser.").arg(server));
    m_open->setObjectName("openLoginButton");
    m_open->setToolTip(tr("Show the page of the login server in the browser"));
    m_open->setDefault(true);
    m_copy->setObjectName("copyLoginButton");
    m_copy->setToolTip(tr("Copy the address of the page, for a different browser"));
    m_copy->setEnabled(false);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    buttons->addButton(m_open, QDialogButtonBox::ActionRole);
    buttons->addButton(m_copy, QDialogButtonBox::ActionRole);
    auto *layout = new QVBoxLayout(this);
    layout->addWidget(m_message);
    layout->addWidget(buttons);
    connect(m_open, &QPushButton::clicked, this, &LoginDialog::logIn);
    connect(m_copy, &QPushButton::clicked, this,
            [this] { QGuiApplication::clipboard()->setText(m_url); });
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(this, &QDialog::rejected, this, [this] { m_jobs.cancel(); });
}

void LoginDialog::logIn() {
    if (!m_url.isEmpty()) { // the page has been closed
        openPage(m_url);
        return;
    }
    m_open->setEnabled(false);
    m_message->setText(tr("Connecting..."));
    const archive::Login::Texts texts{
        tr("You are logged in, and can close this window.").toStdString(),
        tr("The login failed; you can close this window.").toStdString()};
    m_jobs.start(
        tr("Logging in to %1").arg(m_server),
        [this, login = m_login, texts](const Job &job) {
            const auto show = [&](const std::string &url) {
                job.deliver([this, address = QString::fromStdString(url)] { openPage(address); });
            };
            login->logIn(show, texts, job.progress());
        },
        [this](const Outcome &outcome) {
            m_url.clear();
            m_copy->setEnabled(false);
            m_open->setEnabled(true);
            if (outcome.kind == Outcome::Kind::done)
                accept();
            else if (outcome.kind == Outcome::Kind::failed)
                m_message->setText(translated(*outcome.reason));
        });
}

void LoginDialog::openPage(const QString &url) {
    m_url = url;
    m_copy->setEnabled(true);
    m_open->setEnabled(true);
    m_message->setText(QDesktopServices::openUrl(QUrl(url, QUrl::StrictMode))
                           ? tr("Log in to %1 in the browser.").arg(m_server)
                           : tr("No browser could be opened. Copy the address, and open it in a "
                                "browser on this computer."));
}

} // namespace pellucid::ui
