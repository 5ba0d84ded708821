// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/graphics_card.h"

#include <algorithm>

#include <QSettings>

#include "core/task/error.h"
#include "ui/engine/gl_probe.h"
#include "ui/engine/shared_context.h"
#include "ui/language/spoken.h"

namespace pellucid::ui {

namespace {

constexpr const char *settingsKey = "engine";

EngineChoice rememberedChoice() {
    const int choice = QSettings().value(settingsKey, 0).toInt();
    return EngineChoice(std::clamp(choice, 0, int(EngineChoice::card)));
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

void GraphicsCard::giveUp(const QString &reason, const std::shared_ptr<gpu::FramePasses> &passes) {
    // What was chosen meanwhile is another.
    if (!m_passes || m_passes != passes)
        return;
    m_passes.reset();
    m_reason = reason;
    emit changed();
}

// The language may change while the program runs.
QString GraphicsCard::reason() const {
    return spoken(m_reason);
}

QString GraphicsCard::description() const {
    return m_passes ? tr("Graphics card: %1").arg(reason()) : tr("Processor: %1").arg(reason());
}

void GraphicsCard::open() {
    m_passes.reset();
    m_reason.clear();
    const auto &window = windowCapabilities();
    if (m_choice == EngineChoice::processor)
        m_reason = "the processor was chosen";
    else if (!window)
        m_reason = "no OpenGL here";
    else if (!window->canShowImages())
        m_reason = QString("OpenGL here is %1.%2; 3.3 is needed to show pictures with it")
                       .arg(window->version / 10)
                       .arg(window->version % 10);
    else if (m_choice == EngineChoice::automatic && window->software)
        m_reason = "OpenGL here is a software renderer";
    if (!m_reason.isEmpty())
        return;
    try {
        m_passes = std::make_shared<gpu::FramePasses>(
            std::make_shared<gpu::Device>(std::make_unique<SharedContext>()));
        m_reason = m_choice == EngineChoice::card ? "the graphics card was chosen"
                                                  : "there is a graphics card";
    } catch (const task::Error &error) {
        m_reason = QString::fromStdString(error.reason());
    }
}

} // namespace pellucid::ui
