// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <QObject>

#include "core/task/reason.h"
#include "gpu/frame_passes.h"
#include "ui/engine/reasons.h"

namespace pellucid::ui {

/// The engine that the user chose.
enum class EngineChoice { automatic, processor, card };

/// The graphics card that renders projections, if there is one and the user wants it. The automatic
/// choice takes any card but not a software renderer.
class GraphicsCard : public QObject {
    Q_OBJECT
public:
    /// `choice`: for this run only; none: the choice in the settings.
    explicit GraphicsCard(std::optional<EngineChoice> choice = std::nullopt,
                          QObject *parent = nullptr);

    EngineChoice choice() const { return m_choice; }
    /// Makes a new choice and stores it in the settings. A card that was given up is tried again.
    void choose(EngineChoice choice);
    /// Stops using these passes, for this reason, until the user makes a new choice.
    void giveUp(const task::Reason &reason, const std::shared_ptr<gpu::FramePasses> &passes);

    /// The passes that render on the card; none: the processor renders.
    const std::shared_ptr<gpu::FramePasses> &passes() const { return m_passes; }
    /// Why it is the card, or the processor.
    const task::Reason &reason() const { return m_reason; }
    /// Card or processor and the reason, in the user's language.
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
