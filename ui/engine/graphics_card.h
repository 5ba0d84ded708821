// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <QObject>

#include "core/task/reason.h"
#include "gpu/frame_passes.h"

namespace pellucid::ui {

/// Which engine the user wants.
enum class EngineChoice { automatic, processor, card };

/// The graphics card that projections may be made on, if there is one and it is wanted. Left to
/// itself it takes any but those that are made of software.
class GraphicsCard : public QObject {
    Q_OBJECT
public:
    /// `choice`: of this run alone; else what was chosen before.
    explicit GraphicsCard(std::optional<EngineChoice> choice = std::nullopt,
                          QObject *parent = nullptr);

    EngineChoice choice() const { return m_choice; }
    /// Begins anew, also after the card was given up, and is remembered.
    void choose(EngineChoice choice);
    /// Nothing more is made with these passes, for this reason, until the card is chosen again.
    void giveUp(const task::Reason &reason, const std::shared_ptr<gpu::FramePasses> &passes);

    /// None: the processor makes the projections.
    const std::shared_ptr<gpu::FramePasses> &passes() const { return m_passes; }
    /// Why it is that one.
    const task::Reason &reason() const { return m_reason; }
    /// Both, in a line in the user's language.
    QString description() const;

signals:
    void changed();

private:
    void open();

    EngineChoice m_choice;
    std::shared_ptr<gpu::FramePasses> m_passes;
    task::Reason m_reason = task::because::processorChosen;
};

} // namespace pellucid::ui
