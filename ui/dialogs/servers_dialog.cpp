// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/servers_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QListWidget>
#include <QPointer>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QTabWidget>
#include <QVBoxLayout>

#include "core/archive/login.h"
#include "core/network/client/link.h"
#include "ui/dialogs/receiver_form.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/servers/server_book.h"
#include "ui/settings/file_dialogs.h"
#include "ui/widgets/form.h"
#include "ui/widgets/plain_label.h"
#include "ui/widgets/question.h"

namespace pellucid::ui {

namespace {

using archive::RetrieveMethod;
using archive::Server;
using network::Authentication;
using network::Protocol;
using network::Step;

QLineEdit *lineEdit(const char *name, const QString &tip) {
    auto *edit = new QLineEdit;
    edit->setObjectName(name);
    edit->setToolTip(plainToolTip(tip));
    return edit;
}

QSpinBox *spinBox(const char *name, int low, int high, const QString &tip) {
    auto *box = new QSpinBox;
    box->setObjectName(name);
    box->setRange(low, high);
    box->setToolTip(plainToolTip(tip));
    return box;
}

std::string textOf(const QLineEdit *edit) {
    return edit->text().trimmed().toStdString();
}

QString shown(const std::string &text) {
    return QString::fromStdString(text);
}

std::string withoutBrackets(const std::string &host) {
    const bool hasBrackets = host.starts_with('[') && host.ends_with(']');
    return hasBrackets ? host.substr(1, host.size() - 2) : host;
}

// Between commas.
std::vector<std::string> hostsIn(const QLineEdit *edit) {
    std::vector<std::string> hosts;
    for (const QString &host : edit->text().split(',', Qt::SkipEmptyParts))
        if (!host.trimmed().isEmpty())
            hosts.push_back(host.trimmed().toStdString());
    return hosts;
}

QString joined(const std::vector<std::string> &hosts) {
    QStringList texts;
    for (const std::string &host : hosts)
        texts << shown(host);
    return texts.join(", ");
}

} // namespace

ServersDialog::ServersDialog(ServerBook &book, StudyReceiver &receiver, QWidget *parent)
    : QDialog(parent), m_book(book), m_list(new QListWidget), m_message(new PlainLabel),
      m_test(new QPushButton(tr("&Test"))), m_save(new QPushButton(tr("&Save"))),
      m_remove(new QPushButton(tr("&Remove"))) {
    setObjectName("serversDialog");
    setWindowTitle(tr("Servers"));
    setAttribute(Qt::WA_DeleteOnClose);
    m_list->setObjectName("serverList");
    m_list->setAccessibleName(tr("Servers"));
    m_list->setProperty("role", "plain");
    m_list->setMaximumWidth(200);
    auto *add = new QPushButton(tr("&New server"));
    add->setObjectName("newServerButton");
    m_remove->setObjectName("removeServerButton");
    m_test->setObjectName("testServerButton");
    m_test->setToolTip(tr("Connect step by step, and show the step that fails"));
    m_save->setObjectName("saveServerButton");
    m_message->setObjectName("serverMessage");
    m_message->setWordWrap(true);
    m_message->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_message->setMinimumHeight(6 * fontMetrics().lineSpacing());
    m_message->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    auto *left = new QVBoxLayout;
    left->addWidget(m_list, 1);
    left->addWidget(add);
    left->addWidget(m_remove);
    auto *actions = new QHBoxLayout;
    actions->addWidget(m_test);
    actions->addStretch(1);
    actions->addWidget(m_save);
    auto *scroll = new QScrollArea;
    scroll->setWidget(makeForm());
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setMinimumWidth(440);
    auto *right = new QVBoxLayout;
    right->addWidget(scroll, 1);
    right->addLayout(actions);
    right->addWidget(m_message);
    auto *servers = new QWidget;
    auto *columns = new QHBoxLayout(servers);
    columns->addLayout(left);
    columns->addLayout(right, 1);
    auto *tabs = new QTabWidget;
    tabs->setObjectName("serversTabs");
    tabs->addTab(servers, tr("Servers"));
    tabs->addTab(new ReceiverForm(receiver), tr("Receiving"));
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto *layout = new QVBoxLayout(this);
    layout->addWidget(tabs, 1);
    layout->addWidget(buttons);
    for (QPushButton *button : {add, m_remove, m_test, m_save})
        button->setAutoDefault(false);
    m_save->setDefault(true);

    connect(add, &QPushButton::clicked, this, [this] {
        m_list->setCurrentItem(nullptr);
        showServer({}, true);
        m_name->setFocus();
    });
    connect(m_remove, &QPushButton::clicked, this, &ServersDialog::remove);
    connect(m_save, &QPushButton::clicked, this, &ServersDialog::save);
    connect(m_test, &QPushButton::clicked, this, &ServersDialog::test);
    connect(m_list, &QListWidget::currentRowChanged, this, [this](int row) {
        if (row >= 0 && row < int(m_book.servers().size()))
            showServer(m_book.servers()[std::size_t(row)], false);
    });
    list(m_book.names().value(0));
    if (m_book.servers().empty())
        showServer({}, true);
    resize(760, 600);
}

QWidget *ServersDialog::makeForm() {
    auto *form = new QWidget;
    m_form = new QFormLayout(form);
    m_name = lineEdit("serverNameEdit", tr("The name under which the server is listed"));
    m_protocol = new QComboBox;
    m_protocol->setObjectName("protocolBox");
    m_protocol->addItems({tr("DICOM"), tr("DICOMweb")});
    m_ae = lineEdit("serverAeEdit", tr("The server's AE title"));
    m_host = lineEdit("serverHostEdit", tr("Name or address of the server"));
    m_port = spinBox("serverPortBox", 1, 65535, tr("The server's port; usually 104 or 11112"));
    m_url = lineEdit("serverUrlEdit", tr("For example https://pacs.example.org/dicom-web"));
    m_callingAe =
        lineEdit("callingAeEdit", tr("This program's AE title, which the server must know"));
    m_retrieve = new QComboBox;
    m_retrieve->setObjectName("retrieveBox");
    m_retrieve->setToolTip(tr("C-GET brings images on the same connection. With C-MOVE, the server "
                              "sends them to this program's port 11112"));
    m_retrieve->addItems({tr("Automatic"), "C-GET", "C-MOVE"});
    m_sendsFrom = lineEdit("sendsFromEdit",
                           tr("Other hosts from which it sends with C-MOVE, such as the nodes of a "
                              "cluster, separated by commas; usually empty"));
    m_connections = spinBox("connectionsBox", 1, archive::maxConnections,
                            tr("Maximum number of simultaneous connections for retrieving; fewer "
                               "are used if more would not save time"));
    m_limit = spinBox("limitBox", 0, 100000, tr("Maximum number of results; 0: no limit"));
    m_characterSet =
        lineEdit("characterSetEdit", tr("Character set, such as ISO_IR 100, if answers name none"));
    m_uncompress = new QCheckBox(tr("&Decompress if the encoding is not accepted"));
    m_uncompress->setObjectName("uncompressBox");
    m_uncompress->setToolTip(
        tr("Decompresses images before sending if the server does not accept their encoding"));
    m_tls = new QCheckBox(tr("&Encrypt the connection (TLS)"));
    m_tls->setObjectName("tlsBox");
    m_authentication = new QComboBox;
    m_authentication->setObjectName("authenticationBox");
    m_authentication->addItems(
        {tr("None"), tr("User and password"), tr("Token"), tr("In the browser (OAuth 2.0)")});
    m_user = lineEdit("userEdit", tr("User name at the server"));
    m_secret = lineEdit("secretEdit",
                        tr("Kept in the desktop's keychain, or for this run of the program"));
    m_secret->setEchoMode(QLineEdit::Password);
    m_issuer = lineEdit("issuerEdit",
                        tr("For example https://login.example.org/realms/hospital; the login "
                           "server describes the other addresses there"));
    m_authorizationUrl =
        lineEdit("authorizationUrlEdit", tr("Page on which users log in; only without an issuer"));
    m_tokenUrl = lineEdit("tokenUrlEdit", tr("Token endpoint; only without an issuer"));
    m_clientId = lineEdit("clientIdEdit", tr("Client ID registered for Pellucid"));
    m_scope =
        lineEdit("scopeEdit", tr("Scopes to request, such as openid offline_access; optional"));
    m_keyPassword = lineEdit("keyPasswordEdit", m_secret->toolTip());
    m_keyPassword->setEchoMode(QLineEdit::Password);
    m_form->addRow(tr("Name"), m_name);
    m_form->addRow(tr("Protocol"), m_protocol);
    m_form->addRow(tr("AE title"), m_ae);
    m_form->addRow(tr("Host"), m_host);
    m_form->addRow(tr("Port"), m_port);
    m_form->addRow(tr("URL"), m_url);
    m_form->addRow(tr("AE title of this program"), m_callingAe);
    m_form->addRow(tr("Retrieve"), m_retrieve);
    m_form->addRow(tr("Sends from"), m_sendsFrom);
    m_form->addRow(tr("Connections"), m_connections);
    m_form->addRow(tr("Maximum results"), m_limit);
    m_form->addRow(tr("Character set"), m_characterSet);
    m_form->addRow({}, m_uncompress);
    m_form->addRow({}, m_tls);
    m_authorities =
        addFileRow(*m_form, tr("CA certificates"), "authoritiesEdit",
                   tr("Certificates that are trusted (PEM); empty: those of the system"));
    m_certificate = addFileRow(*m_form, tr("Certificate"), "certificateEdit",
                               tr("Client certificate (PEM); empty: none"));
    m_key = addFileRow(*m_form, tr("Private key"), "keyEdit",
                       tr("Private key of the certificate (PEM)"));
    m_form->addRow(tr("Key password"), m_keyPassword);
    m_form->addRow(tr("Login"), m_authentication);
    m_form->addRow(tr("User"), m_user);
    m_form->addRow(tr("Password or token"), m_secret);
    m_form->addRow(tr("Issuer"), m_issuer);
    m_form->addRow(tr("Authorization URL"), m_authorizationUrl);
    m_form->addRow(tr("Token URL"), m_tokenUrl);
    m_form->addRow(tr("Client ID"), m_clientId);
    m_form->addRow(tr("Scope"), m_scope);
    connect(m_issuer, &QLineEdit::textChanged, this, &ServersDialog::enableFields);
    connect(m_protocol, &QComboBox::currentIndexChanged, this, &ServersDialog::enableFields);
    connect(m_authentication, &QComboBox::currentIndexChanged, this, &ServersDialog::enableFields);
    connect(m_tls, &QCheckBox::toggled, this, &ServersDialog::enableFields);
    connect(m_url, &QLineEdit::textChanged, this, &ServersDialog::enableFields);
    return form;
}

// Only the fields that apply are shown.
void ServersDialog::enableFields() {
    const bool isWeb = m_protocol->currentIndex() == 1;
    const bool isSecure = isWeb ? m_url->text().startsWith("https://") : m_tls->isChecked();
    const auto place = [this](QWidget *field, bool isShown) {
        // The field of a file is in a row with its button.
        QWidget *const parent = field->parentWidget();
        m_form->setRowVisible(parent == m_form->parentWidget() ? field : parent, isShown);
    };
    for (QWidget *field :
         std::initializer_list<QWidget *>{m_ae, m_host, m_port, m_callingAe, m_retrieve,
                                          m_sendsFrom, m_characterSet, m_uncompress, m_tls})
        place(field, !isWeb);
    place(m_url, isWeb);
    for (QWidget *field :
         std::initializer_list<QWidget *>{m_authorities, m_certificate, m_key, m_keyPassword})
        place(field, isSecure);
    const auto login = Authentication(m_authentication->currentIndex());
    place(m_user, login == Authentication::basic);
    place(m_secret, login == Authentication::basic || login == Authentication::bearer);
    for (QWidget *field : std::initializer_list<QWidget *>{m_issuer, m_clientId, m_scope})
        place(field, login == Authentication::oauth);
    for (QWidget *field : std::initializer_list<QWidget *>{m_authorizationUrl, m_tokenUrl})
        place(field, login == Authentication::oauth && m_issuer->text().trimmed().isEmpty());
}

void ServersDialog::list(const QString &selected) {
    m_list->clear();
    for (const QString &name : m_book.names())
        m_list->addItem(shownText(name));
    m_list->setCurrentRow(int(m_book.names().indexOf(selected)));
}

void ServersDialog::showServer(const Server &server, bool isNew) {
    const network::Peer &peer = server.peer;
    const bool isWeb = peer.protocol == Protocol::web;
    m_name->setText(shown(server.name));
    m_protocol->setCurrentIndex(isWeb ? 1 : 0);
    m_ae->setText(isNew || isWeb ? QString() : shown(peer.calledAe));
    m_host->setText(isWeb ? QString() : shown(peer.host));
    m_port->setValue(peer.port);
    m_url->setText(isWeb ? shown(archive::addressOf(peer)) : QString());
    m_callingAe->setText(shown(peer.callingAe));
    m_retrieve->setCurrentIndex(int(server.retrieve));
    m_sendsFrom->setText(joined(server.sendsFrom));
    m_connections->setValue(server.connections);
    m_limit->setValue(int(server.limit));
    m_characterSet->setText(shown(peer.characterSet));
    m_uncompress->setChecked(server.mayUncompress);
    m_tls->setChecked(peer.usesTls);
    m_authorities->setText(shown(peer.authorities));
    m_certificate->setText(shown(peer.certificate));
    m_key->setText(shown(peer.key));
    m_keyPassword->clear();
    m_authentication->setCurrentIndex(int(peer.authentication));
    m_user->setText(shown(peer.user));
    const archive::LoginSettings &login = server.loginSettings;
    m_issuer->setText(shown(login.issuer));
    m_authorizationUrl->setText(shown(login.authorizationUrl));
    m_tokenUrl->setText(shown(login.tokenUrl));
    m_clientId->setText(shown(login.clientId));
    m_scope->setText(shown(login.scope));
    m_secret->clear();
    m_secret->setPlaceholderText(isNew ? QString() : tr("unchanged"));
    m_remove->setEnabled(!isNew);
    m_message->clear();
    enableFields();
}

Server ServersDialog::entered() const {
    Server server;
    server.name = textOf(m_name);
    if (m_protocol->currentIndex() == 1)
        server.peer = archive::webPeer(textOf(m_url));
    else
        server.peer = archive::dicomPeer(textOf(m_ae) + "@" +
                                         network::hostPart(withoutBrackets(textOf(m_host))) + ":" +
                                         std::to_string(m_port->value()));
    network::Peer &peer = server.peer;
    if (peer.protocol == Protocol::dicom) {
        peer.usesTls = m_tls->isChecked();
        peer.callingAe = textOf(m_callingAe);
        peer.characterSet = textOf(m_characterSet);
    }
    if (peer.usesTls) {
        peer.authorities = textOf(m_authorities);
        peer.certificate = textOf(m_certificate);
        peer.key = textOf(m_key);
        peer.keyPassword = m_keyPassword->text().toStdString();
    }
    peer.authentication = Authentication(m_authentication->currentIndex());
    if (peer.authentication == Authentication::basic)
        peer.user = textOf(m_user);
    if (peer.authentication == Authentication::basic ||
        peer.authentication == Authentication::bearer)
        peer.secret = m_secret->text().toStdString();
    if (peer.authentication == Authentication::oauth) {
        archive::LoginSettings &login = server.loginSettings;
        login.issuer = textOf(m_issuer);
        if (login.issuer.empty()) {
            login.authorizationUrl = textOf(m_authorizationUrl);
            login.tokenUrl = textOf(m_tokenUrl);
        }
        login.clientId = textOf(m_clientId);
        login.scope = textOf(m_scope);
    }
    server.retrieve = RetrieveMethod(m_retrieve->currentIndex());
    if (peer.protocol == Protocol::dicom)
        server.sendsFrom = hostsIn(m_sendsFrom);
    server.connections = m_connections->value();
    server.limit = std::uint32_t(m_limit->value());
    server.mayUncompress = !m_uncompress->isHidden() && m_uncompress->isChecked();
    archive::requireValid(server);
    // The user has agreed when it was saved.
    for (const Server &saved : m_book.servers())
        if (saved.name == server.name && saved.peer.authentication == peer.authentication &&
            archive::addressOf(saved.peer) == archive::addressOf(peer))
            peer.allowsInsecureLogin = saved.peer.allowsInsecureLogin;
    return server;
}

void ServersDialog::withEntered(const std::function<void(const Server &)> &then) {
    try {
        Server server = entered();
        if (!network::hasInsecureLogin(server.peer)) {
            then(server);
            return;
        }
        ask(this,
            {"insecureLoginQuestion", tr("Login without TLS"),
             tr("Without TLS, others on the network can read the password or token for %1. Send it "
                "without TLS?")
                 .arg(shown(server.peer.host)),
             tr("Send without TLS")},
            [this, server, then]() mutable {
                server.peer.allowsInsecureLogin = true;
                try {
                    then(server);
                } catch (const task::Error &error) {
                    report(translated(error.reason()), "warning");
                }
            });
    } catch (const task::Error &error) {
        report(translated(error.reason()), "warning");
    }
}

void ServersDialog::save() {
    withEntered([this](const Server &server) {
        m_book.put(server);
        list(shown(server.name));
        report(tr("Saved"), "muted");
    });
}

void ServersDialog::remove() {
    try {
        m_book.remove(m_book.names().value(m_list->currentRow()));
        list(m_book.names().value(0));
        if (m_book.servers().empty())
            showServer({}, true);
    } catch (const task::Error &error) {
        report(translated(error.reason()), "warning");
    }
}

void ServersDialog::test() {
    const auto run = [this](const Server &complete) {
        report(tr("Connecting..."), "muted");
        const QStringList names{tr("Name"), "TCP", "TLS", tr("Association"), tr("Offers")};
        auto lines = std::make_shared<QStringList>();
        m_test->setEnabled(false);
        m_jobs.start(
            tr("Testing %1").arg(shown(complete.name)),
            [this, complete, names, lines](const Job &job) {
                const auto observe = [&](Step step, const std::string &found) {
                    job.deliver([this, lines,
                                 line = QString::fromUtf8("\u2713 ") + names[int(step)] + ": " +
                                        shown(found)] {
                        *lines << line;
                        report(lines->join("\n"), "muted");
                    });
                };
                archive::withLogin(complete, job.progress(), [&](const network::Peer &peer) {
                    network::Link link(network::Connection{peer, network::Purpose::echo},
                                       job.progress(), observe);
                    link.echo(job.progress(), observe);
                });
            },
            [this, lines](const Outcome &outcome) {
                m_test->setEnabled(true);
                if (outcome.kind == Outcome::Kind::failed) {
                    *lines << QString::fromUtf8("\u2717 ") + translated(*outcome.reason);
                    report(lines->join("\n"), "warning");
                }
            });
    };
    // A saved server's secret need not be typed again; the address is that of the secret.
    withEntered([this, run](const Server &server) {
        m_book.withSecrets(
            std::vector<Server>{server}, this,
            [self = QPointer<ServersDialog>(this), run](const std::vector<Server> &complete) {
                if (self != nullptr && !complete.empty()) // it may be closed meanwhile
                    run(complete.front());
            });
    });
}

void ServersDialog::report(const QString &text, const char *role) {
    setMessage(*m_message, text, role);
}

} // namespace pellucid::ui
