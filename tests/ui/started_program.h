// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include "tests/ui/workstation.h"
#include "ui/window/workstation.h"

namespace pellucid::test {

/// The program as it starts, with preferences and what it keeps from run to run; one at a time.
class StartedProgram : public Workstation {
protected:
    // As if the program had ended and been started again.
    void begin() {
        m_program.reset();
        m_program = std::make_unique<ui::Workstation>();
        window_().resize(1600, 1000);
        QVERIFY(QTest::qWaitForWindowExposed(&window_()));
        window_().activateWindow();
    }
    ui::MainWindow &window_() { return m_program->window(); }
    ui::Document &document() { return m_program->bench().study.document; }
    ui::ProjectionView *projectionOf() { return find<ui::ProjectionView>("projectionView"); }
    template <class T> T *find(const char *name) {
        T *found = window_().findChild<T *>(name);
        if (found == nullptr)
            qFatal("no %s", name);
        return found;
    }
    void settleIn() {
        QTRY_VERIFY_WITH_TIMEOUT(projectionOf()->showsFinalImage() &&
                                     !m_program->bench().study.jobs.isRunning(),
                                 patienceMs);
    }
    void openIn(const QString &path) {
        drop(window_(), {QUrl::fromLocalFile(path)});
        settleIn();
    }
    void choosePreset(const QString &name) {
        clickPreset(window_(), name);
        settleIn();
    }
    void openDialog() {
        find<QAction>("preferencesAction")->trigger();
        QVERIFY(find<QDialog>("preferencesDialog")->isVisible());
    }

    std::unique_ptr<ui::Workstation> m_program;
};

} // namespace pellucid::test
