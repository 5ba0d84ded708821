// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QSlider;
class QToolButton;

namespace pellucid::ui {

class Phases;
class PlainLabel;

/// Selects and plays the phases of the open series; hidden if there is only one.
class PhaseBar : public QWidget {
    Q_OBJECT
public:
    explicit PhaseBar(Phases &phases, QWidget *parent = nullptr);

private:
    void showPhases();

    Phases &m_phases;
    QToolButton *m_play;
    QSlider *m_slider;
    PlainLabel *m_label;
};

} // namespace pellucid::ui
