// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtTest>

#include <algorithm>
#include <cmath>
#include <memory>

#include <QDropEvent>
#include <QListWidget>
#include <QMimeData>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QSlider>
#include <QStandardPaths>
#include <QStyleOptionSlider>

#include "core/dicom/write_series.h"
#include "core/files/user_folders.h"
#include "core/fourier/transforms/wisdom.h"
#include "core/phantom/phantom.h"
#include "tests/support/temporary_folder.h"
#include "ui/views/projection_view.h"
#include "ui/window/application.h"
#include "ui/window/main_window.h"

namespace pellucid::test {

#ifdef PELLUCID_SANITIZED
constexpr int patienceMs = 240000;
#else
constexpr int patienceMs = 60000;
#endif

inline QString testData() {
    return qEnvironmentVariable("PELLUCID_TEST_DATA");
}

// Asked for till it is granted: a window that is not on the screen yet, or that another program's
// takes the keyboard from, is not active by being asked once.
inline bool activate(QWidget &window) {
    return QTest::qWaitFor(
        [&] {
            if (!window.isActiveWindow())
                window.activateWindow();
            return window.isActiveWindow();
        },
        patienceMs);
}

inline void drop(QWidget &window, const QList<QUrl> &urls) {
    QMimeData data;
    data.setUrls(urls);
    QDragEnterEvent enter(QPoint(400, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent dropped(QPointF(400, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &dropped);
}

inline double meanGrey(const QImage &image) {
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            sum += qGray(image.pixel(x, y));
    return sum / (double(image.width()) * image.height());
}

// The mean distance of the channels from each other.
inline double colorfulness(const QImage &image) {
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const QRgb p = image.pixel(x, y);
            sum +=
                std::max({qRed(p), qGreen(p), qBlue(p)}) - std::min({qRed(p), qGreen(p), qBlue(p)});
        }
    return sum / (double(image.width()) * image.height());
}

inline void moveMouse(QWidget *widget, QPoint to) {
    QMouseEvent move(QEvent::MouseMove, to, widget->mapToGlobal(to), Qt::NoButton, Qt::NoButton,
                     Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &move);
}

inline double meanGrey(const QImage &image, const QRect &area) {
    return meanGrey(image.copy(area));
}

// Share of pixels that differ clearly.
inline double changed(const QImage &a, const QImage &b) {
    if (a.size() != b.size())
        return 1.0;
    qint64 count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            count += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))) > 8 ? 1 : 0;
    return double(count) / (double(a.width()) * a.height());
}

inline void dragMouse(QWidget *widget, Qt::MouseButton button, QPoint from, QPoint by) {
    QTest::mousePress(widget, button, Qt::NoModifier, from);
    for (int step = 1; step <= 8; ++step) {
        // QTest's own moves carry no buttons; a person's do.
        const QPoint at = from + by * step / 8;
        QMouseEvent move(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, button,
                         Qt::NoModifier);
        QCoreApplication::sendEvent(widget, &move);
        QTest::qWait(5);
    }
    QTest::mouseRelease(widget, button, Qt::NoModifier, from + by);
}

inline void turnWheel(QWidget *widget, int steps) {
    const QPointF at = widget->rect().center();
    QWheelEvent event(at, widget->mapToGlobal(at), {}, QPoint(0, 120 * steps), Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(widget, &event);
}

// Drags the knob of a slider.
inline void dragSlider(QSlider *slider, QPoint by) {
    QStyleOptionSlider option;
    option.initFrom(slider);
    option.minimum = slider->minimum();
    option.maximum = slider->maximum();
    option.sliderPosition = option.sliderValue = slider->value();
    const QRect knob = slider->style()->subControlRect(QStyle::CC_Slider, &option,
                                                       QStyle::SC_SliderHandle, slider);
    dragMouse(slider, Qt::LeftButton, knob.center(), by);
}

/// Clicks a preset in the gallery of a window.
inline void clickPreset(QWidget &window, const QString &name) {
    auto *gallery = window.findChild<QListWidget *>("presetGallery");
    const auto item = gallery->findItems(name, Qt::MatchExactly).front();
    gallery->scrollToItem(item);
    QTest::mouseClick(gallery->viewport(), Qt::LeftButton, Qt::NoModifier,
                      gallery->visualItemRect(item).center());
}

/// Settings, presets, library and caches of a test's own.
inline void keepToFolder(const test::TemporaryFolder &folder) {
    QStandardPaths::setTestModeEnabled(true);
    QSettings().clear();
    qputenv("XDG_DATA_HOME", QByteArray::fromStdString((folder / "data").string()));
    // As the programs do: one plan of FFTW, and so the same bits, for all of them.
    qputenv("XDG_CACHE_HOME", QByteArray::fromStdString((folder / "cache").string()));
    fourier::keepWisdomIn(*files::userCacheFolder() / "fftw-wisdom");
}

/// How many textures, buffers, programs and render buffers the program has: names of objects are
/// small numbers, and contexts share them.
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

/// The real window, anew for each test, and a head to open in it.
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

    void init() { restart(); }
    void cleanup() {
        m_window.reset();
        m_bench.reset();
    }

protected:
    // As if the program had ended and been started again.
    void restart() {
        m_window.reset();
        m_bench.reset();
        m_bench = std::make_unique<ui::Workbench>();
        m_window = std::make_unique<ui::MainWindow>(*m_bench, ui::Theme::named("dark"));
        m_window->resize(1600, 1000);
        m_window->show();
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    }

    QString headPath() const { return QString::fromStdString((m_folder / "head").string()); }

    template <class T> T *find(const char *name) {
        T *found = m_window->findChild<T *>(name);
        if (found == nullptr)
            qFatal("no %s", name);
        return found;
    }
    ui::ProjectionView *projection() { return find<ui::ProjectionView>("projectionView"); }
    QImage grab(const char *name) { return find<QWidget>(name)->grab().toImage(); }

    void open(const QString &path) {
        drop(*m_window, {QUrl::fromLocalFile(path)});
        QTRY_VERIFY_WITH_TIMEOUT(projection()->showsFinalImage() && !m_window->jobs().isRunning(),
                                 patienceMs);
    }

    // What the scene asks for is there.
    void settle() {
        QTRY_VERIFY_WITH_TIMEOUT(projection()->showsFinalImage() && !m_window->jobs().isRunning(),
                                 patienceMs);
    }

    void save(const QString &name) {
        const QString folder = qEnvironmentVariable("PELLUCID_ARTIFACTS");
        if (folder.isEmpty())
            return;
        QDir().mkpath(folder);
        QVERIFY(m_window->grab().save(folder + "/workstation_" + name + ".png"));
    }

    test::TemporaryFolder m_folder;
    std::unique_ptr<ui::Workbench> m_bench;
    std::unique_ptr<ui::MainWindow> m_window;
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
