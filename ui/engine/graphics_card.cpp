// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/graphics_card.h"

#include <algorithm>

#include <QSettings>

#include "core/task/error.h"
#include "ui/engine/gl_probe.h"
#include "ui/engine/shared_context.h"
#include "ui/language/reasons.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;

constexpr const char *settingsKey = "engine";

EngineChoice rememberedChoice() {
    const int choice = QSettings().value(settingsKey, 0).toInt();
    return EngineChoice(std::clamp(choice, 0, int(EngineChoice::card)));
}

// The obstacle that is known before a card is probed.
std::optional<task::Reason> whyNoCard(EngineChoice choice) {
    if (choice == EngineChoice::processor)
        return because::processorChosen;
    const auto &window = windowCapabilities();
    if (!window)
        return because::noOpenGl;
    if (!window->canShowImages())
        return because::oldOpenGl(window->version / 10, window->version % 10);
    if (choice == EngineChoice::automatic && window->software)
        return because::softwareOpenGl;
    return std::nullopt;
}

} // namespace

GraphicsCard::GraphicsCard(std::optional<EngineChoice> choice, QObject *parent)
    : QObject(parent), m_choice(choice ? *choice : rememberedChoice()) {
    open();
}

void GraphicsCard::choose(EngineChoice choice) {
    m_choice = choice;
    QSettings().setValue(settingsKey, int(choice));
    open();
    emit changed();
}

void GraphicsCard::giveUp(const task::Reason &reason,
                          const std::shared_ptr<gpu::FramePasses> &passes) {
    // Another card may have been chosen meanwhile.
    if (!m_passes || m_passes != passes)
        return;
    m_passes.reset();
    m_reason = reason;
    emit changed();
}

QString GraphicsCard::description() const {
    return m_passes ? tr("Graphics card: %1").arg(translated(m_reason))
                    : tr("Processor: %1").arg(translated(m_reason));
}

void GraphicsCard::open() {
    m_passes.reset();
    if (const auto obstacle = whyNoCard(m_choice)) {
        m_reason = *obstacle;
        return;
    }
    try {
        m_passes = std::make_shared<gpu::FramePasses>(
            std::make_shared<gpu::Device>(std::make_unique<SharedContext>()));
        m_reason = m_choice == EngineChoice::card ? because::cardChosen : because::cardFound;
    } catch (const task::Error &error) {
        m_reason = error.reason();
    }
}

} // namespace pellucid::ui
