// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <QDialog>

#include "core/archive/login.h"
#include "ui/jobs/job_runner.h"

class QPushButton;

namespace pellucid::ui {

class PlainLabel;

/// Opens the page of a login server in the browser, and waits until the user has logged in there.
/// It is accepted when the login has its tokens.
class LoginDialog : public QDialog {
    Q_OBJECT
public:
    LoginDialog(const QString &server, std::shared_ptr<archive::Login> login, QWidget *parent);

private:
    void logIn();
    void openPage(const QString &url);

    const QString m_server;
    const std::shared_ptr<archive::Login> m_login;
    QString m_url; ///< of the page; empty until it is known
    PlainLabel *m_message;
    QPushButton *m_open, *m_copy;
    JobRunner m_jobs;
};

} // namespace pellucid::ui
