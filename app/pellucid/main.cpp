// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <cstdlib>

#include <QSurfaceFormat>
#include <QUrl>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/exit_code.h"
#include "app/pellucid/log_spdlog.h"
#include "core/files/session_folder.h"
#include "core/files/user_folders.h"
#include "core/fourier/transforms/wisdom.h"
#include "core/platform/display.h"
#include "core/platform/memory.h"
#include "core/platform/process.h"
#include "core/platform/terminal.h"
#include "core/system/log.h"
#include "core/task/error.h"
#include "ui/engine/graphics_card.h"
#include "ui/language/failure.h"
#include "ui/servers/open_request.h"
#include "ui/theme/icons.h"
#include "ui/window/application.h"
#include "ui/window/link_port.h"
#include "ui/window/main_window.h"
#include "ui/window/reopening.h"
#include "ui/window/workstation.h"

namespace {

// A request ends the program as the user would: files are complete or absent, and the session can
// be resumed. A second one ends a program that does not respond.
void endWhenAsked() {
    using namespace pellucid;
    const auto endAtOnce = [] { std::_Exit(exitCode(task::ErrorCode::internal)); };
    platform::whenAskedToEnd(
        [endAtOnce] {
            if (QCoreApplication *const application = QCoreApplication::instance())
                QMetaObject::invokeMethod(application, &QCoreApplication::quit,
                                          Qt::QueuedConnection);
            else
                endAtOnce();
        },
        endAtOnce);
}

int failAtStart(const std::string &what, pellucid::task::ErrorCode code) {
    pellucid::platform::reportAtStart("pellucid: " + what);
    return pellucid::exitCode(code);
}

} // namespace

int main(int argc, char **argv) {
    using namespace pellucid;
    platform::joinTerminal();
    platform::leaveMemoryOutOfDumps(); // not hideMemory: desktops then refuse their dialogs
    platform::letLongFilesFail();
    endWhenAsked();
    CLI::App options("View DICOM studies as transparent projections", "pellucid");
    options.allow_windows_style_options(false); // a path may begin with a slash
    std::vector<std::string> paths;
    options.set_version_flag("--version", "pellucid " PELLUCID_VERSION);
    std::string engine;
    options.add_option("--engine", engine, "Engine that renders the projections: auto, cpu or gpu")
        ->check(CLI::IsMember({"auto", "cpu", "gpu"}));
    options.add_option("PATH", paths,
                       "Files, folders, a DICOMDIR, ZIP archives, or volumes in NRRD, NIfTI or "
                       "MetaImage; or a link pellucid://open?server=NAME&studyUID=UID");
    try {
        options.parse(argc, argv);
    } catch (const CLI::Success &success) {
        return options.exit(success);
    } catch (const CLI::ParseError &error) {
        return failAtStart(error.what(), task::ErrorCode::usage);
    }
    QSurfaceFormat format;
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    // All contexts that share must request it, or none gets it.
    format.setOption(QSurfaceFormat::ResetNotification);
    QSurfaceFormat::setDefaultFormat(format);
    // Qt aborts if it finds no display. Print one line and return an exit code instead.
    static QString reason; // the last warning before the failure
    qInstallMessageHandler([](QtMsgType type, const QMessageLogContext &, const QString &text) {
        const QString line = text.section('\n', 0, 0).simplified();
        if (type == QtFatalMsg) {
            std::_Exit(failAtStart((reason.isEmpty() ? line : reason).toStdString(),
                                   task::ErrorCode::noSuchDevice));
        }
        if (type != QtWarningMsg && type != QtCriticalMsg)
            return;
        if (QCoreApplication::instance() == nullptr || QCoreApplication::startingUp())
            reason = line;
        else
            std::fprintf(stderr, "%s\n", qPrintable(text));
    });
    files::removeAbandonedSessionFolders();
    if (const auto cache = files::userCacheFolder()) {
        fourier::keepWisdomIn(*cache / "fftw-wisdom");
        keepLogIn(*cache / "log" / "pellucid.log");
    }
    // Checked before Qt tries and names each of its plugins.
    if (!platform::mayHaveDisplay())
        return failAtStart("there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set)",
                           task::ErrorCode::noSuchDevice);
    // Libraries map much memory at start, and some software renderers crash if they cannot.
    constexpr std::size_t mappedToStart = std::size_t(1100) << 20;
    if (platform::mappableBytes() < mappedToStart)
        return failAtStart(
            fmt::format("not enough memory to start: needs {} MB, the limit leaves {} MB",
                        mappedToStart >> 20, platform::mappableBytes() >> 20),
            task::ErrorCode::outOfMemory);
    system::log("pellucid " PELLUCID_VERSION ", Qt " + std::string(qVersion()));
    // The engine's context shares with the windows' contexts, so that its pictures stay on the
    // card.
    QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
    ui::Application application(argc, argv);
    QApplication::setApplicationName("pellucid");
    QApplication::setOrganizationName("pellucid");
    QApplication::setApplicationVersion(PELLUCID_VERSION);
    QGuiApplication::setDesktopFileName("org.pellucid.Pellucid");
    QApplication::setWindowIcon(ui::themedIcon("pellucid"));
    std::optional<ui::EngineChoice> choice;
    if (!engine.empty())
        choice = engine == "gpu"   ? ui::EngineChoice::card
                 : engine == "cpu" ? ui::EngineChoice::processor
                                   : ui::EngineChoice::automatic;
    try {
        QStringList files, links;
        for (const std::string &path : paths) {
            const QString text = QString::fromStdString(path);
            if (ui::isLink(text))
                links << text;
            else // desktops name files by URLs, too
                files << (text.startsWith("file://") ? QUrl(text).toLocalFile() : text);
        }
        // A program that is running opens it. A link that is wrong is reported here.
        for (const QString &link : links)
            ui::openRequestOf(link);
        if (files.isEmpty() && links.size() == 1 && ui::LinkPort::handOver(links.front()))
            return 0;
        ui::Workstation workstation(choice);
        const ui::LinkPort port;
        QObject::connect(&port, &ui::LinkPort::linkReceived, &workstation,
                         [&workstation](const QString &link) {
                             ui::MainWindow &window = workstation.window();
                             window.setWindowState(window.windowState() & ~Qt::WindowMinimized);
                             window.raise();
                             window.activateWindow();
                             window.openLink(link);
                         });
        if (!files.isEmpty())
            workstation.window().openPaths(files);
        for (const QString &link : links)
            workstation.window().openLink(link);
        if (files.isEmpty() && links.isEmpty() && ui::Preferences::load().resumesAtStart)
            workstation.window().reopening().resume();
        return QApplication::exec();
    } catch (const task::Error &error) {
        return failAtStart(error.what(), error.code());
    } catch (const std::bad_alloc &) {
        return failAtStart("not enough memory to start", task::ErrorCode::outOfMemory);
    } catch (...) {
        return failAtStart(ui::currentFailure().what.english(), task::ErrorCode::internal);
    }
}
