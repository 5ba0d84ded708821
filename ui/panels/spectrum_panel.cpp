// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/spectrum_panel.h"

#include <QVBoxLayout>

#include "ui/language/plain_label.h"
#include "ui/language/reasons.h"
#include "ui/panels/spectrum_plot.h"

namespace pellucid::ui {

SpectrumPanel::SpectrumPanel(const Theme &theme, QWidget *parent)
    : QWidget(parent), m_plot(new SpectrumPlot(theme)), m_hint(new PlainLabel),
      m_readout(new PlainLabel) {
    setObjectName("spectrumPanel");
    setAttribute(Qt::WA_StyledBackground);
    m_hint->setObjectName("spectrumHint");
    m_hint->setProperty("role", "muted");
    m_hint->setWordWrap(true);
    m_hint->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    m_readout->setObjectName("spectrumReadout");
    m_readout->setProperty("role", "small");
    m_readout->setAccessibleName(tr("Frequency and strength under the mouse"));
    m_readout->setFixedHeight(m_readout->fontMetrics().height()); // also when empty
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(14, 2, 14, 8);
    column->setSpacing(0);
    column->addWidget(m_plot, 1);
    column->addWidget(m_readout);
    column->addWidget(m_hint, 1);
    connect(m_plot, &SpectrumPlot::pointedAt, m_readout, &PlainLabel::setText);
    clear({});
}

void SpectrumPanel::showSlice(const render::SpectrumSlice &slice) {
    m_plot->setSlice(slice);
    m_hint->hide();
    m_plot->show();
    m_readout->show();
}

void SpectrumPanel::clear(const std::optional<task::Reason> &reason) {
    m_plot->setSlice({});
    m_readout->clear();
    m_plot->hide();
    m_readout->hide();
    m_hint->setText(reason ? translated(*reason)
                           : tr("The spectrum of the projection's current view."));
    m_hint->show();
}

void SpectrumPanel::showEvent(QShowEvent *event) {
    QWidget::showEvent(event);
    emit visibilityChanged(true);
}

void SpectrumPanel::hideEvent(QHideEvent *event) {
    QWidget::hideEvent(event);
    emit visibilityChanged(false);
}

} // namespace pellucid::ui
