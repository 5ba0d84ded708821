// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/engine_menu.h"

#include <QActionGroup>
#include <QCoreApplication>
#include <QMenu>

#include "ui/document/add_command.h"
#include "ui/engine/graphics_card.h"

namespace pellucid::ui {

namespace {

struct EngineMenuTexts {
    Q_DECLARE_TR_FUNCTIONS(EngineMenuTexts)
};

} // namespace

void addEngineMenu(QMenu &menu, GraphicsCard &card) {
    auto *engines = new QActionGroup(&menu);
    const struct {
        QString text;
        const char *name;
        EngineChoice choice;
    } choices[] = {
        {EngineMenuTexts::tr("&Automatic"), "automaticEngineAction", EngineChoice::automatic},
        {EngineMenuTexts::tr("&Processor"), "processorEngineAction", EngineChoice::processor},
        {EngineMenuTexts::tr("&Graphics card"), "cardEngineAction", EngineChoice::card}};
    for (const auto &c : choices) {
        QAction *action = addCommand(menu, c.text, c.name, {}, &card,
                                     [&card, choice = c.choice] { card.choose(choice); });
        action->setCheckable(true);
        action->setActionGroup(engines);
        action->setChecked(card.choice() == c.choice);
    }
}

} // namespace pellucid::ui
