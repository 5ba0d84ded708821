// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/receiver_form.h"

#include <QCheckBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "ui/language/reasons.h"
#include "ui/servers/study_receiver.h"
#include "ui/settings/file_dialogs.h"
#include "ui/widgets/form.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

ReceiverForm::ReceiverForm(StudyReceiver &receiver, QWidget *parent)
    : QWidget(parent), m_receiver(receiver), m_form(new QFormLayout),
      m_on(new QCheckBox(tr("&Receive what the DICOM servers in the list send"))),
      m_tls(new QCheckBox(tr("&Encrypt connections (TLS)"))), m_ae(new QLineEdit),
      m_address(new QLineEdit), m_port(new QSpinBox), m_state(new PlainLabel),
      m_apply(new QPushButton(tr("&Apply"))) {
    setObjectName("receiverForm");
    const ReceiverSettings &now = receiver.settings();
    m_on->setObjectName("receiverOnBox");
    m_on->setToolTip(tr("What arrives is added to the library. Other senders are rejected"));
    m_on->setChecked(now.isOn);
    m_ae->setObjectName("receiverAeEdit");
    m_ae->setToolTip(tr("The name under which servers send to this program"));
    m_ae->setText(now.ae);
    m_address->setObjectName("receiverAddressEdit");
    m_address->setPlaceholderText(tr("all addresses"));
    m_address->setToolTip(
        tr("Receive only on this address of this computer, on the servers' network"));
    m_address->setText(now.address);
    m_port->setObjectName("receiverPortBox");
    m_port->setRange(1, 65535);
    m_port->setToolTip(tr("The port that servers send to; usually 11112"));
    m_port->setValue(now.port);
    m_tls->setObjectName("receiverTlsBox");
    m_tls->setToolTip(tr("Senders must then use TLS, too"));
    m_tls->setChecked(now.usesTls);
    m_form->addRow(m_on);
    m_form->addRow(tr("AE title of this program"), m_ae);
    m_form->addRow(tr("Listen on"), m_address);
    m_form->addRow(tr("Port"), m_port);
    m_form->addRow({}, m_tls);
    m_certificate = addFileRow(*m_form, tr("Certificate"), "receiverCertificateEdit",
                               tr("Certificate of this program (PEM)"));
    m_certificate->setText(now.certificate);
    m_key = addFileRow(*m_form, tr("Private key"), "receiverKeyEdit",
                       tr("Private key of the certificate (PEM), without a password"));
    m_key->setText(now.key);
    m_authorities =
        addFileRow(*m_form, tr("CA certificates"), "receiverAuthoritiesEdit",
                   tr("Certificates of the CAs that issued the senders' certificates (PEM). Each "
                      "sender's certificate must name its host or address"));
    m_authorities->setText(now.authorities);
    m_state->setObjectName("receiverState");
    m_state->setWordWrap(true);
    m_apply->setObjectName("applyReceiverButton");
    m_apply->setAutoDefault(false);
    auto *actions = new QHBoxLayout;
    actions->addWidget(m_state, 1);
    actions->addWidget(m_apply);
    auto *layout = new QVBoxLayout(this);
    layout->addLayout(m_form);
    layout->addStretch(1);
    layout->addLayout(actions);
    connect(m_on, &QCheckBox::toggled, this, &ReceiverForm::enableFields);
    connect(m_tls, &QCheckBox::toggled, this, &ReceiverForm::enableFields);
    connect(m_apply, &QPushButton::clicked, this, &ReceiverForm::apply);
    connect(&receiver, &StudyReceiver::changed, this, &ReceiverForm::showState);
    enableFields();
    showState();
}

void ReceiverForm::enableFields() {
    m_ae->setEnabled(m_on->isChecked());
    m_address->setEnabled(m_on->isChecked());
    m_port->setEnabled(m_on->isChecked());
    m_tls->setEnabled(m_on->isChecked());
    for (QLineEdit *const edit : {m_certificate, m_key, m_authorities})
        m_form->setRowVisible(edit->parentWidget(), m_tls->isChecked());
}

void ReceiverForm::apply() {
    m_receiver.setSettings({m_on->isChecked(), m_address->text().trimmed(), m_port->value(),
                            m_ae->text().trimmed(), m_tls->isChecked(),
                            m_certificate->text().trimmed(), m_key->text().trimmed(),
                            m_authorities->text().trimmed()});
    showState();
}

void ReceiverForm::showState() {
    const ReceiverSettings &now = m_receiver.settings();
    QString text = tr("Receiving is off");
    if (m_receiver.failure())
        text = translated(*m_receiver.failure());
    else if (m_receiver.isListening())
        text = tr("%1 receives on port %2; %n objects have arrived", "",
                  int(m_receiver.receivedCount()))
                   .arg(now.ae, QString::number(now.port));
    setMessage(*m_state, text, m_receiver.failure() ? "warning" : "muted");
}

} // namespace pellucid::ui
