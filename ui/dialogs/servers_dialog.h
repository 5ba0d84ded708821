// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QDialog>

#include "core/archive/server.h"
#include "ui/jobs/job_runner.h"

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLineEdit;
class QListWidget;
class QPushButton;
class QSpinBox;

namespace pellucid::ui {

class PlainLabel;
class ServerBook;
class StudyReceiver;

/// Adds, edits, tests and removes servers, and sets how this program receives what they send.
class ServersDialog : public QDialog {
    Q_OBJECT
public:
    ServersDialog(ServerBook &book, StudyReceiver &receiver, QWidget *parent);

private:
    QWidget *makeForm();
    void list(const QString &selected);
    void showServer(const archive::Server &server, bool isNew);
    /// What the form says. *Throws* Error{usage}.
    archive::Server entered() const;
    /// Calls `then` with what the form says, after the user has agreed to a login that others can
    /// read. Reports what `then` *throws*.
    void withEntered(const std::function<void(const archive::Server &)> &then);
    void enableFields();
    void save();
    void remove();
    void test();
    void report(const QString &text, const char *role);

    ServerBook &m_book;
    QListWidget *m_list;
    QFormLayout *m_form = nullptr;
    QLineEdit *m_name, *m_ae, *m_host, *m_url, *m_callingAe, *m_user, *m_secret, *m_characterSet;
    QLineEdit *m_issuer, *m_authorizationUrl, *m_tokenUrl, *m_clientId, *m_scope;
    QLineEdit *m_authorities, *m_certificate, *m_key, *m_keyPassword;
    QComboBox *m_protocol, *m_retrieve, *m_authentication;
    QLineEdit *m_sendsFrom;
    QSpinBox *m_port, *m_connections, *m_limit;
    QCheckBox *m_tls, *m_uncompress;
    PlainLabel *m_message;
    QPushButton *m_test, *m_save, *m_remove;
    JobRunner m_jobs;
};

} // namespace pellucid::ui
