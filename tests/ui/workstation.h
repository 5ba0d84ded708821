// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtTest>

#include <filesystem>
#include <memory>

#include <QDialog>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QStandardPaths>

#include "core/dicom/write_series.h"
#include "core/files/user_folders.h"
#include "core/fourier/transforms/wisdom.h"
#include "core/phantom/phantom.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/hand.h"
#include "tests/ui/patience.h"
#include "tests/ui/pictures.h"
#include "ui/theme/theme.h"
#include "ui/views/projection_view.h"
#include "ui/window/application.h"
#include "ui/window/main_window.h"
#include "ui/window/workstation.h"

namespace pellucid::test {

/// The folder of the real series; empty if they are absent.
inline QString testData() {
    return qEnvironmentVariable("PELLUCID_TEST_DATA");
}

/// Makes a window active. It asks again until the request is granted: a window that is not on the
/// screen yet, or one that takes the keyboard from another program, ignores the first request.
inline bool activate(QWidget &window) {
    return QTest::qWaitFor(
        [&] {
            if (!window.isActiveWindow())
                window.activateWindow();
            return window.isActiveWindow();
        },
        patienceMs);
}

/// Keeps settings, presets, library, caches and secrets of a test apart from the user's.
inline void keepToFolder(const test::TemporaryFolder &folder) {
    QStandardPaths::setTestModeEnabled(true);
    QSettings().clear();
    qputenv("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent"); // where the keychain is
    qputenv("XDG_DATA_HOME", QByteArray::fromStdString((folder / "data").string()));
    // The tests share one plan of FFTW, as the programs do, and so compute the same bits.
    qputenv("XDG_CACHE_HOME", QByteArray::fromStdString((folder / "cache").string()));
    fourier::keepWisdomIn(*files::userCacheFolder() / "fftw-wisdom");
}

/// The number of textures, buffers, programs and render buffers of the program. Names of objects
/// are small numbers, and contexts share them.
inline int sharedGlObjects() {
    QOffscreenSurface surface;
    surface.create();
    QOpenGLContext context;
    context.setShareContext(QOpenGLContext::globalShareContext());
    if (!context.create() || !context.makeCurrent(&surface))
        return -1;
    QOpenGLFunctions &gl = *context.functions();
    int count = 0;
    for (GLuint name = 1; name < 20000; ++name)
        count += gl.glIsTexture(name) + gl.glIsBuffer(name) + gl.glIsProgram(name) +
                 gl.glIsRenderbuffer(name);
    context.doneCurrent();
    return count;
}

/// Counts the changes of a document of some kinds.
class ChangeCount : public QObject {
public:
    ChangeCount(ui::Document &document, ui::Changes what) {
        document.whenever(what, this, [this] { ++m_count; });
    }
    int count() const { return m_count; }

private:
    int m_count = 0;
};

/// The fixture of all tests of the window: the program, which starts for the first time before each
/// test, and a head to open in it.
class Workstation : public QObject {
    Q_OBJECT
protected slots:
    void initTestCase() {
        keepToFolder(m_folder);
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{96, 96, 80}});
        dicom::writeCtSeries(
            m_folder / "head", phantom::makePhantom(phantom::Kind::head, lattice),
            {.patientName = "Secret^Name", .windows = {{40, 100, ""}, {300, 1500, ""}}},
            dicom::TransferSyntax::explicitLittle);
    }
    void init() {
        forgetEverything();
        restart();
    }
    void cleanup() { endProgram(); }

protected:
    /// Ends the program and removes its settings and all data that it keeps between runs.
    void forgetEverything() {
        endProgram();
        QSettings().clear();
        std::filesystem::remove_all(m_folder / "data");
    }
    /// Ends the program, if it runs, and starts it again. `size`: of its window.
    void restart(QSize size = {1600, 1000}) {
        endProgram();
        m_program = std::make_unique<ui::Workstation>();
        mainWindow().resize(size);
        QVERIFY(QTest::qWaitForWindowExposed(&mainWindow()));
        QVERIFY(activate(mainWindow())); // keys go to the active window
    }
    void endProgram() { m_program.reset(); }

    ui::Workbench &bench() const { return m_program->bench(); }
    ui::MainWindow &mainWindow() const { return m_program->window(); }
    ui::Document &document() const { return mainWindow().document(); }
    ui::JobRunner &jobs() const { return mainWindow().jobs(); }
    ui::ProjectionView *projection() { return find<ui::ProjectionView>("projectionView"); }

    template <class T> T *find(const char *name) {
        T *found = mainWindow().findChild<T *>(name);
        if (found == nullptr)
            qFatal("no %s", name);
        return found;
    }
    QImage grab(const char *name) { return find<QWidget>(name)->grab().toImage(); }
    /// Saves a screenshot for a person to look at.
    void save(const QString &name) {
        const QString folder = qEnvironmentVariable("PELLUCID_ARTIFACTS");
        if (folder.isEmpty())
            return;
        QDir().mkpath(folder);
        QVERIFY(mainWindow().grab().save(folder + "/workstation_" + name + ".png"));
    }

    QString headPath() const { return QString::fromStdString((m_folder / "head").string()); }
    void open(const QString &path) {
        drop(mainWindow(), {QUrl::fromLocalFile(path)});
        settle();
    }
    void choosePreset(const QString &name) {
        clickPreset(mainWindow(), name);
        settle();
    }
    void openPreferences() {
        find<QAction>("preferencesAction")->trigger();
        QVERIFY(find<QDialog>("preferencesDialog")->isVisible());
    }

    /// Waits until the projection shows the scene as it is now, at full detail, and nothing is
    /// underway or queued that would change it.
    void settle() { QTRY_VERIFY_WITH_TIMEOUT(staysSettled(), patienceMs); }
    /// Waits until the whole volume is open; its projection may still be underway.
    void waitForVolume() {
        QTRY_VERIFY_WITH_TIMEOUT(document().volume() && !document().isPreview(), patienceMs);
    }

    test::TemporaryFolder m_folder;
    std::unique_ptr<ui::Workstation> m_program;

private:
    // While the user's hand may go on, a former engine shows a scene that it was not made for, and
    // no job runs yet.
    bool isSettled() {
        return projection()->showsWhatIsAskedFor() && !jobs().isRunning() &&
               bench().study.preparer.preparedFor() == ui::wantedOf(document());
    }
    // An event that is still queued may ask for another picture.
    bool staysSettled() {
        if (!isSettled())
            return false;
        QCoreApplication::processEvents();
        return isSettled();
    }
};

/// Runs the tests of a class in an application of their own.
template <class Test, class Application = ui::Application> int run(int argc, char **argv) {
    QSurfaceFormat format;
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    // All contexts that share must ask for it, or none gets it.
    format.setOption(QSurfaceFormat::ResetNotification);
    QSurfaceFormat::setDefaultFormat(format);
    QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
    Application application(argc, argv);
    QApplication::setApplicationName("pellucid-test");
    QApplication::setOrganizationName("pellucid-test");
    ui::Theme::named("dark").apply(application);
    qputenv("QTEST_FUNCTION_TIMEOUT", "3600000"); // ctest has one of its own
    Test test;
    return QTest::qExec(&test, argc, argv);
}

} // namespace pellucid::test
