// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/window_chooser.h"

#include <algorithm>
#include <utility>

#include <QAction>
#include <QComboBox>
#include <QMenu>
#include <QSignalBlocker>

#include "ui/dialogs/display_window_dialog.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/names.h"
#include "ui/language/number_text.h"
#include "ui/language/shown_text.h"
#include "ui/studies/window_presets.h"
#include "ui/widgets/action_table.h"
#include "ui/widgets/dialog_place.h"

namespace pellucid::ui {

namespace {

constexpr int lastPresetKey = 8, fileKey = 9;

QString windowLabel(const volume::ValueWindow &w) {
    return QString("%1  %2 / %3")
        .arg(translatedName(w.name.empty() ? "Custom" : w.name), numberText(w.width, 5),
             numberText(w.center, 5));
}

QKeySequence keyOf(int digit) {
    return QKeySequence(QString::number(digit));
}

} // namespace

WindowChooser::WindowChooser(Document &document, std::function<Document &()> target,
                             QObject *parent)
    : QObject(parent), m_document(document), m_target(std::move(target)) {}

void WindowChooser::show(QMenu &menu, QComboBox &box, const ActionTable &actions) {
    m_menu = &menu;
    m_box = &box;
    m_actions = &actions;
    connect(&box, &QComboBox::activated, this, [this](int index) {
        if (index < m_rows.size())
            m_rows[index]->trigger();
        showCurrent(); // the row that opens the dialog is not a window
    });
    m_document.whenever(Change::displayWindow, this, [this](Changes changes) {
        if (changes & Change::volume)
            showWindows();
        else
            showCurrent();
    });
    showWindows();
}

// A different window is shown as the present one is: inverted or not.
void WindowChooser::choose(volume::ValueWindow window) {
    Document &shown = m_target();
    if (!shown.volume())
        return;
    window.isInverted = shown.displayWindow().isInverted;
    if (!(shown.displayWindow() == window))
        shown.undoStack()->push(new EditDisplayWindow(shown, window));
}

void WindowChooser::addRow(QAction &action, const QString &text) {
    m_menu->addAction(&action);
    m_rows << &action;
    m_box->addItem(text);
}

void WindowChooser::add(const volume::ValueWindow &window, const QKeySequence &key) {
    auto *const action = new QAction(menuText(windowLabel(window)), m_menu);
    action->setShortcut(key);
    connect(action, &QAction::triggered, this, [this, window] {
        // The list is for the unit of the open study.
        const auto &volume = m_target().volume();
        if (volume && m_document.volume() && volume->unit() == m_document.volume()->unit())
            choose(window);
    });
    addRow(*action, windowLabel(window));
}

// The automatic window depends on all values: compute it only when chosen.
void WindowChooser::chooseAutomatic() {
    if (m_target().volume())
        choose(automaticWindow(*m_target().volume()));
}

void WindowChooser::invert() {
    Document &shown = m_target();
    volume::ValueWindow window = shown.displayWindow();
    window.isInverted = !window.isInverted;
    shown.undoStack()->push(new EditDisplayWindow(shown, window));
}

void WindowChooser::showWindows() {
    m_menu->clear();
    m_rows.clear();
    const auto &volume = m_document.volume();
    m_box->setEnabled(volume.has_value());
    const QSignalBlocker quiet(m_box);
    m_box->clear();
    if (!volume)
        return;
    addRow(*(*m_actions)["autoWindowAction"], translatedName("Auto"));
    std::vector<WindowPreset> presets = windowPresets();
    std::erase_if(presets, [&](const WindowPreset &p) { return p.unit != volume->unit(); });
    const std::vector<volume::ValueWindow> &ofFile = volume->notes().windows;
    for (std::size_t n = 0; n < ofFile.size(); ++n) {
        volume::ValueWindow window = ofFile[n];
        if (n == 0 && window.name.empty())
            window.name = "File";
        add(window, n == 0 ? keyOf(fileKey) : QKeySequence());
    }
    // The window that the study opened with is always there.
    const volume::ValueWindow &initial = m_document.initialWindow();
    const bool isListed =
        initial.name == "Auto" || !ofFile.empty() ||
        std::any_of(presets.begin(), presets.end(), [&](const WindowPreset &p) {
            return p.window.center == initial.center && p.window.width == initial.width;
        });
    if (!isListed)
        add(initial, {});
    int digit = 0;
    for (const WindowPreset &preset : presets)
        add(preset.window, ++digit <= lastPresetKey ? keyOf(digit) : QKeySequence());
    m_menu->addSeparator();
    m_menu->addAction((*m_actions)["invertedPlanesAction"]);
    addRow(*(*m_actions)["displayWindowAction"], tr("Width and center..."));
    showCurrent();
}

void WindowChooser::showCurrent() {
    if (!m_document.volume())
        return;
    const QSignalBlocker quiet(m_box);
    // A window that is not in the menu has an extra row at the end.
    while (m_box->count() > m_rows.size())
        m_box->removeItem(m_box->count() - 1);
    const QString text = windowLabel(m_document.displayWindow());
    if (m_box->findText(text) < 0)
        m_box->addItem(text);
    m_box->setCurrentIndex(m_box->findText(text));
}

void WindowChooser::openDialog() {
    QWidget &window = *m_box->window();
    Document &shown = m_target();
    if (auto *const former = window.findChild<DisplayWindowDialog *>();
        former != nullptr && &former->document() != &shown)
        delete former;
    placeBeside(showOnly<DisplayWindowDialog>(window, [&] {
        auto *dialog = new DisplayWindowDialog(shown, &window);
        // A study beside may be closed before the dialog.
        connect(&shown, &QObject::destroyed, dialog, [dialog] { delete dialog; });
        connect(dialog, &DisplayWindowDialog::presetsChanged, this, &WindowChooser::showWindows);
        return dialog;
    }));
}

} // namespace pellucid::ui
