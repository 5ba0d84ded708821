// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QProcess>
#include <QtTest>

#include "tests/support/temporary_folder.h"
#include "tests/ui/workstation.h"

namespace pellucid::test {

/// Starts the program as a process of its own, with settings in the test's folder.
inline void startWorkstation(QProcess &program, const TemporaryFolder &folder,
                             const QStringList &arguments) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
#ifdef PELLUCID_SANITIZED // leaks of libraries are looked for in the test's own process
    environment.insert("ASAN_OPTIONS", "detect_leaks=0");
#endif
    environment.insert("XDG_CONFIG_HOME", QString::fromStdString((folder / "config").string()));
    program.setProcessEnvironment(environment);
    program.start(PELLUCID_WORKSTATION, arguments);
    QVERIFY(program.waitForStarted(patienceMs));
}

} // namespace pellucid::test
