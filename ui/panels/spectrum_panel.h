// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QWidget>

#include "core/render/spectrum_slice.h"
#include "core/task/reason.h"
#include "ui/theme/theme.h"

namespace pellucid::ui {

class PlainLabel;
class SpectrumPlot;

/// The slice of the spectrum that the projection's view takes, with a readout at the mouse.
class SpectrumPanel : public QWidget {
    Q_OBJECT
public:
    explicit SpectrumPanel(const Theme &theme, QWidget *parent = nullptr);

    void showSlice(const render::SpectrumSlice &slice);
    /// `reason`: why there is no slice; none if no study is open.
    void clear(const std::optional<task::Reason> &reason);

signals:
    /// Whether the panel is visible.
    void visibilityChanged(bool isVisible);

protected:
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;

private:
    SpectrumPlot *m_plot;
    PlainLabel *m_hint, *m_readout;
};

} // namespace pellucid::ui
