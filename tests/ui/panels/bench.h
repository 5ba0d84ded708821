// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <QApplication>
#include <QVBoxLayout>
#include <QtTest>

#include "core/classify/density_field.h"
#include "core/files/user_folders.h"
#include "core/phantom/phantom.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/hand.h"
#include "ui/document/document.h"
#include "ui/studies/window_presets.h"
#include "ui/theme/theme.h"

namespace pellucid::test {

/// Opens a small phantom in a document, as the workstation does, but without files and jobs.
inline void openPhantom(ui::Document &document, phantom::Kind kind = phantom::Kind::head) {
    constexpr int side = 48;
    const auto lattice =
        phantom::phantomLattice(kind, {.size = volume::GridSize{side, side, side}});
    const auto volume = phantom::makePhantom(kind, lattice);
    document.show({volume, ui::initialWindow(volume), classify::defaultFieldWindow(volume)});
}

/// A window with a panel and, as in a dock, the widget of its corner.
template <class Panel> std::unique_ptr<QWidget> windowOf(Panel *panel) {
    auto window = std::make_unique<QWidget>();
    auto *column = new QVBoxLayout(window.get());
    if constexpr (requires { panel->corner(); })
        column->addWidget(panel->corner());
    column->addWidget(panel, 1);
    window->resize(320, 480);
    return window;
}

/// The fixture of a panel's test: a document with a phantom, and a panel that `Panel` makes for
/// each test. It needs no program, no projection and no screen.
template <class Panel> class PanelBench : public QObject {
public:
    PanelBench() {
        qputenv("XDG_DATA_HOME", (m_folder / "data").c_str());
        qputenv("XDG_CONFIG_HOME", (m_folder / "config").c_str());
    }

protected:
    void begin() {
        m_window.reset();
        m_document = std::make_unique<ui::Document>();
        m_panel = new Panel(*m_document);
        m_window = windowOf(m_panel);
        openPhantom(*m_document);
        m_window->show();
        QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    }
    ui::Document &document() { return *m_document; }
    Panel &panel() { return *m_panel; }
    const classify::Look &look() { return m_document->scene().look; }
    void undo() { m_document->undoStack()->undo(); }
    int edits() { return m_document->undoStack()->count(); }
    template <class T> T *find(const QString &name) {
        auto *const found = m_window->template findChild<T *>(name);
        if (found == nullptr)
            qFatal("there is no %s", qPrintable(name));
        return found;
    }

private:
    TemporaryFolder m_folder;
    std::unique_ptr<ui::Document> m_document;
    std::unique_ptr<QWidget> m_window;
    Panel *m_panel = nullptr;
};

/// Runs the tests of several panels, one after the other.
template <class... Tests> int runOnBench(int argc, char **argv) {
    QApplication application(argc, argv);
    QApplication::setApplicationName("pellucid-test");
    QApplication::setOrganizationName("pellucid-test");
    ui::Theme::named("dark").apply(application);
    int failed = 0;
    const auto run = [&](auto test) { failed += QTest::qExec(test.get(), argc, argv); };
    (run(std::make_unique<Tests>()), ...);
    return failed;
}

} // namespace pellucid::test
