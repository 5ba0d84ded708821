// SPDX-License-Identifier: GPL-3.0-or-later
// The time from a move of the mouse to the picture on the screen, in the real window. `./dev
// interaction SERIES...` runs it for large panes; the test only checks that every move is followed
// by a picture.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <QElapsedTimer>
#include <fmt/format.h>

#include "core/volume/statistics.h"
#include "tests/ui/workstation.h"
#include "ui/document/commands.h"

namespace pellucid {

using namespace test;

namespace {

enum class Mode { plain, twoColors, light };
constexpr std::array modes{std::pair{Mode::plain, "X-ray"},
                           std::pair{Mode::twoColors, "two colored classes"},
                           std::pair{Mode::light, "one light"}};

// Classes below and above the middle of the brighter samples, whatever the modality.
classify::Look twoColors(const volume::Volume &volume) {
    const auto parts = volume::quantiles(volume, {0.6, 0.85, 0.999});
    return {
        {},
        {{"lower", parts[0], parts[1], 0.1 * (parts[1] - parts[0]), 0.5, {0.2, 0.5, 0.9}, {}, {}},
         {"upper", parts[1], parts[2], 0.1 * (parts[2] - parts[1]), 1.0, {1.0, 0.9, 0.7}, {}, {}}}};
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

} // namespace

class InteractionTest : public Workstation {
    Q_OBJECT
private slots:
    void init() { Workstation::init(); }

    void aPictureFollowsEveryMove() {
        const QStringList series =
            qEnvironmentVariable("PELLUCID_INTERACTION").split('\n', Qt::SkipEmptyParts);
        open(series.isEmpty() ? headPath() : series.front());
        QTest::mouseDClick(projection(), Qt::LeftButton); // fills the window
        if (series.isEmpty())
            measure(headPath(), {{600, 760}}, 4);
        for (const QString &path : series)
            measure(path, {{600, 760}, {1200, 1500}, {1800, 2000}}, 60);
    }

private:
    void measure(const QString &path, const std::vector<QSize> &sizes, int moves) {
        open(path);
        for (const QSize &size : sizes) {
            mainWindow().resize(mainWindow().size() + size - projection()->size());
            settle();
            for (const auto &[mode, name] : modes) {
                ui::editScene(document(), "Mode", ui::noDrag, [&](scene::Scene &scene) {
                    scene.look = mode == Mode::twoColors ? twoColors(*document().volume())
                                                         : classify::Look();
                    scene.shading.lights.clear();
                    if (mode == Mode::light)
                        scene.shading.lights.emplace_back();
                });
                settle();
                turn(path, name, moves);
            }
        }
    }

    void turn(const QString &path, const char *mode, int moves) {
        ui::ProjectionView *const view = projection();
        int frames = 0, drafts = 0;
        double frameMs = 0.0;
        const QObject whileHere; // ends the connection
        QObject::connect(view, &ui::ProjectionView::frameShown, &whileHere,
                         [&](const picture::FrameTimes &times, bool isDraft) {
                             ++frames;
                             drafts += isDraft ? 1 : 0;
                             frameMs = times.totalMs();
                         });
        std::vector<double> toPicture, ofFrame;
        const QPoint from = view->rect().center();
        QTest::mousePress(view, Qt::LeftButton, Qt::NoModifier, from);
        for (int move = 1; move <= moves; ++move) {
            const int before = frames;
            QElapsedTimer timer;
            timer.start();
            moveMouse(view, from + QPoint(3 * move, move), Qt::LeftButton);
            while (frames == before && timer.elapsed() < patienceMs)
                QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 20);
            QVERIFY(frames > before);
            QCoreApplication::processEvents(); // paints it
            toPicture.push_back(1e-6 * double(timer.nsecsElapsed()));
            ofFrame.push_back(frameMs);
        }
        QTest::mouseRelease(view, Qt::LeftButton, Qt::NoModifier, from);
        settle();
        fmt::print("{}, pane {} x {}, {}: {:.1f} ms from the move to the picture, {:.1f} of them "
                   "the frame; {} of {} are drafts\n",
                   path.section('/', -1).toStdString(), view->width(), view->height(), mode,
                   median(toPicture), median(ofFrame), drafts, frames);
        std::fflush(stdout);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::InteractionTest>(argc, argv);
}

#include "interaction_test.moc"
