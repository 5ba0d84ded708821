// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QCheckBox;
class QFormLayout;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace pellucid::ui {

class PlainLabel;
class StudyReceiver;

/// Turns receiving on and off, and says whether it works.
class ReceiverForm : public QWidget {
    Q_OBJECT
public:
    ReceiverForm(StudyReceiver &receiver, QWidget *parent = nullptr);

private:
    void apply();
    void enableFields();
    void showState();

    StudyReceiver &m_receiver;
    QFormLayout *m_form;
    QCheckBox *m_on, *m_tls;
    QLineEdit *m_ae, *m_certificate, *m_key, *m_authorities, *m_address;
    QSpinBox *m_port;
    PlainLabel *m_state;
    QPushButton *m_apply;
};

} // namespace pellucid::ui
