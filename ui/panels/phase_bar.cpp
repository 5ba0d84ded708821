// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/phase_bar.h"

#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>

#include "ui/opening/phases.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

PhaseBar::PhaseBar(Phases &phases, QWidget *parent)
    : QWidget(parent), m_phases(phases), m_play(new QToolButton),
      m_slider(new QSlider(Qt::Horizontal)), m_label(new PlainLabel) {
    setPanelBackground(*this, "phaseBar");
    m_play->setObjectName("playPhasesButton");
    m_play->setText(tr("Play"));
    m_play->setCheckable(true);
    m_play->setToolTip(tr("Play the phases (Shift+Space)"));
    m_slider->setObjectName("phaseSlider");
    m_slider->setAccessibleName(tr("Phase"));
    m_slider->setToolTip(tr("Phase shown (keys , and .)"));
    m_slider->setPageStep(1);
    m_slider->setTickPosition(QSlider::NoTicks);
    m_label->setObjectName("phaseLabel");
    m_label->setMinimumWidth(220);
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(12, 4, 12, 4);
    row->setSpacing(10);
    row->addWidget(m_play);
    row->addWidget(m_slider, 1);
    row->addWidget(m_label);
    connect(m_play, &QToolButton::clicked, &phases, &Phases::togglePlaying);
    connect(m_slider, &QSlider::valueChanged, &phases, &Phases::show);
    connect(&phases, &Phases::changed, this, &PhaseBar::showPhases);
    showPhases();
}

void PhaseBar::showPhases() {
    setVisible(m_phases.count() > 1);
    if (m_phases.count() < 2)
        return;
    const QSignalBlocker quiet(m_slider);
    m_slider->setRange(0, m_phases.count() - 1);
    const int now = m_phases.current();
    m_slider->setValue(now);
    m_play->setChecked(m_phases.isPlaying());
    QString text =
        tr("Phase %1 of %2").arg(QString::number(now + 1), QString::number(m_phases.count()));
    if (now >= 0 && !m_phases.label(now).isEmpty())
        text += ", " + m_phases.label(now);
    m_label->setText(text);
}

} // namespace pellucid::ui
