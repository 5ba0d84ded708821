// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/window_chooser.h"

#include <QAction>
#include <QComboBox>
#include <QMenu>
#include <QSignalBlocker>

#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/names.h"
#include "ui/studies/window_presets.h"

namespace pellucid::ui {

namespace {

QString windowLabel(const volume::ValueWindow &w) {
    return QString("%1  %2 / %3")
        .arg(translatedName(w.name.empty() ? "Custom" : w.name))
        .arg(w.width, 0, 'g', 5)
        .arg(w.center, 0, 'g', 5);
}

} // namespace

WindowChooser::WindowChooser(Document &document, QMenu &menu, QComboBox &box)
    : QObject(&box), m_document(document), m_menu(menu), m_box(box) {
    connect(&box, &QComboBox::activated, this, [this](int index) {
        const auto actions = m_menu.actions();
        if (index >= 0 && index < actions.size())
            actions[index]->trigger();
    });
    connect(&document, &Document::volumeChanged, this, &WindowChooser::showWindows);
    connect(&document, &Document::displayWindowChanged, this, &WindowChooser::showCurrent);
    showWindows();
}

void WindowChooser::add(const volume::ValueWindow &window, const QKeySequence &key) {
    QAction *action = m_menu.addAction(windowLabel(window));
    action->setShortcut(key);
    connect(action, &QAction::triggered, this, [this, window] {
        if (m_document.volume() && !(m_document.displayWindow() == window))
            m_document.undoStack()->push(new EditDisplayWindow(m_document, window));
    });
    m_box.addItem(windowLabel(window));
}

// The automatic window depends on all values: compute it only when chosen.
void WindowChooser::addAutomatic() {
    const QAction *const action = m_menu.addAction(translatedName("Auto"));
    connect(action, &QAction::triggered, this, [this] {
        if (!m_document.volume())
            return;
        const volume::ValueWindow window = automaticWindow(*m_document.volume());
        if (!(m_document.displayWindow() == window))
            m_document.undoStack()->push(new EditDisplayWindow(m_document, window));
    });
    m_box.addItem(action->text());
}

void WindowChooser::showWindows() {
    m_menu.clear();
    const auto &volume = m_document.volume();
    m_box.setEnabled(volume.has_value());
    const QSignalBlocker quiet(m_box);
    m_box.clear();
    if (!volume)
        return;
    add(m_document.initialWindow(), QKeySequence("0"));
    for (const WindowPreset &preset : windowPresets(*volume))
        add(preset.window, QKeySequence(QString::number(preset.key)));
    for (std::size_t n = 1; n < volume->notes().windows.size(); ++n)
        add(volume->notes().windows[n], {});
    if (m_document.initialWindow().name != "Auto")
        addAutomatic();
    showCurrent();
}

void WindowChooser::showCurrent() {
    if (!m_document.volume())
        return;
    const QSignalBlocker quiet(m_box);
    // A window that is not in the menu has an extra row at the end.
    while (m_box.count() > m_menu.actions().size())
        m_box.removeItem(m_box.count() - 1);
    const QString text = windowLabel(m_document.displayWindow());
    if (m_box.findText(text) < 0)
        m_box.addItem(text);
    m_box.setCurrentIndex(m_box.findText(text));
}

} // namespace pellucid::ui
