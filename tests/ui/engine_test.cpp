// SPDX-License-Identifier: GPL-3.0-or-later
// The engine of the projection: the user's choice, a lost card, machines without one.
#include "tests/ui/workstation.h"

#include <atomic>

#include <QHelpEvent>
#include <QLabel>
#include <QOpenGLWidget>
#include <QProcess>
#include <QSignalSpy>
#include <QToolTip>

#include "app/exit_code.h"
#include "core/picture/compose.h"
#include "gpu/reasons.h"
#include "tests/support/fields.h"
#include "tests/support/fragile_context.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/engine/gl_probe.h"
#include "ui/engine/reasons.h"
#include "ui/export/scene_files.h"
#include "ui/views/projection_canvas.h"

namespace pellucid {

using namespace test;

namespace {

// The largest difference of two pictures in a channel.
int largestDifference(const QImage &a, const QImage &b) {
    if (a.size() != b.size())
        return 255;
    int largest = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
            largest = std::max({largest, std::abs(qRed(p) - qRed(q)),
                                std::abs(qGreen(p) - qGreen(q)), std::abs(qBlue(p) - qBlue(q))});
        }
    return largest;
}

} // namespace

class EngineTest : public Workstation {
    Q_OBJECT
private slots:
    void theProgramStartsNamesItsEngineAndWorks() {
        if (qEnvironmentVariable("PELLUCID_ENGINE") == "card")
            find<QAction>("cardEngineAction")->trigger();
        const QString reason =
            qEnvironmentVariable("PELLUCID_EXPECTED_REASON", "OpenGL runs on a software renderer");
        QVERIFY2(engineText().contains(reason), qPrintable(engineText()));
        open(headPath());
        QVERIFY2(engineText().startsWith("CPU engine, "), qPrintable(engineText()));
        QVERIFY2(engineText().contains(reason), qPrintable(engineText()));
        const QImage before = projection()->picture();
        QVERIFY(meanGrey(before) > 5.0);
        dragMouse(projection(), Qt::LeftButton, QPoint(200, 200), QPoint(90, 30));
        settle();
        QVERIFY(changed(before, projection()->picture()) > 0.02);
        find<QAction>("processorEngineAction")->trigger();
        settle();
        QVERIFY2(engineText().endsWith("the processor was chosen"), qPrintable(engineText()));
    }

    // A bound while the picture is new; what was measured of it when it rests.
    void theErrorOfAPictureAtRestIsMeasured() {
        useSmallWindow();
        open(headPath());
        const auto isMeasured = [&] {
            const auto &error = projection()->frames().error();
            return error && error->isMeasured();
        };
        const auto measure = [&] {
            QTRY_VERIFY_WITH_TIMEOUT(isMeasured(), patienceMs);
            const error::StatedError error = *projection()->frames().error();
            QVERIFY(error.relative > 0.0 && error.relative < 1.1e-3);
            QVERIFY(error.low <= error.relative && error.relative <= error.high);
            QVERIFY(error.frequencies > 0);
        };
        measure();
        QVERIFY(find<QLabel>("predictedErrorLabel")->text().startsWith("measured: "));
        QHelpEvent pointed(QEvent::ToolTip, QPoint(projection()->width() - 20, 14),
                           projection()->mapToGlobal(QPoint(projection()->width() - 20, 14)));
        QApplication::sendEvent(projection(), &pointed);
        QVERIFY2(QToolTip::text().contains("measured at"), qPrintable(QToolTip::text()));
        dragMouse(projection(), Qt::LeftButton, QPoint(100, 100), QPoint(60, 20));
        QVERIFY(!isMeasured()); // of the former view
        measure();
    }

    // Beside the body there is little to be accurate about: a part that may miss the tolerance is
    // rendered again with one kernel, until the view moves.
    void aPartThatMissesTheToleranceIsRenderedAgain() {
        useSmallWindow();
        open(headPath());
        const auto widths = [&] {
            const auto &shares = projection()->frames().frame()->times.widthShares;
            return std::count_if(shares.begin(), shares.end(), [](double of) { return of > 0.0; });
        };
        choosePreset("Bone");
        settle();
        QVERIFY(widths() > 1);
        const scene::Camera whole = document().scene().camera;
        scene::Camera part = whole;
        part.pixelMm /= 8.0;
        part.panMm = {78.0, 60.0};
        document().setPose(document().poseOf(part), true);
        settle();
        QVERIFY(widths() > 1);
        QTRY_COMPARE_WITH_TIMEOUT(widths(), 1, patienceMs);
        const auto &error = projection()->frames().error();
        QVERIFY(error->relative < 1.1e-3); // the bound of the new picture
        QTRY_VERIFY_WITH_TIMEOUT(error->isMeasured(), patienceMs);
        QTest::qWait(500);
        QCOMPARE(widths(), 1);
        QVERIFY(error->isMeasured());
        // Beside the former look, pictures choose their widths; alone, it comes closer again.
        QTest::keyPress(projection(), Qt::Key_Q);
        QVERIFY(projection()->isComparing());
        settle();
        QVERIFY(widths() > 1);
        QTest::keyRelease(&mainWindow(), Qt::Key_Q);
        QTRY_COMPARE_WITH_TIMEOUT(widths(), 1, patienceMs);
        document().setPose(document().poseOf(whole), true);
        settle();
        QVERIFY(widths() > 1);
    }

    void theCardStatesTheErrorOfTheProcessor() {
        needCard();
        useSmallWindow();
        open(headPath());
        const auto measured = [&] {
            const auto &error = projection()->frames().error();
            return error && error->isMeasured() ? error->relative : 0.0;
        };
        // Estimates follow each other until one is good enough.
        const auto lastMeasured = [&] {
            const QDeadlineTimer late(patienceMs);
            for (double before = 0.0; !late.hasExpired() && (measured() != before || before == 0.0);
                 QTest::qWait(1000))
                before = measured();
            return measured();
        };
        const double byProcessor = lastMeasured();
        QVERIFY(byProcessor > 0.0);
        chooseCard();
        QTRY_VERIFY_WITH_TIMEOUT(isOnCard(), patienceMs);
        // Both read the same cells by the same kernels.
        QVERIFY(std::abs(lastMeasured() - byProcessor) < 0.05 * byProcessor);
    }

    void theCardShowsWhatTheProcessorShows() {
        needCard();
        useSmallWindow();
        open(headPath());
        const QImage processor = projection()->picture();
        const double lightness = meanGrey(canvas());
        chooseCard();
        QVERIFY(!projection()->picture().isNull());
        QVERIFY(largestDifference(projection()->picture(), processor) <= 1);
        // The screen is drawn from the card's texture.
        QVERIFY(std::abs(meanGrey(canvas()) - lightness) < 0.2);
        QVERIFY(largestDifference(canvas(), projection()->picture()) <= 1);
        save("on_the_card");
        // The view turns, and takes a light.
        dragMouse(projection(), Qt::LeftButton, QPoint(100, 100), QPoint(60, 20));
        settle();
        QVERIFY(changed(processor, projection()->picture()) > 0.02);
        find<QAction>("addLightAction")->trigger();
        settle();
        QTRY_VERIFY_WITH_TIMEOUT(isOnCard() && !jobs().isRunning(), patienceMs);
        settle();
        QVERIFY(largestDifference(canvas(), projection()->picture()) <= 1);
    }

    // As with a graphics card and a picture of the processor.
    void openGlDrawsAPictureOfTheProcessor() {
        needCard();
        const auto canvas = ui::makeOpenGlCanvas(nullptr);
        auto *const widget = qobject_cast<QOpenGLWidget *>(canvas->widget());
        widget->setAttribute(Qt::WA_DontShowOnScreen);
        widget->resize(40, 30);
        picture::ProjectionImage image{.width = 40, .height = 30, .channels = 3};
        for (int n = 0; n < 40 * 30 * 3; ++n)
            image.samples.push_back(float(n % 113) / 113.0F);
        const picture::Display display{{0.1, 0.8}, true, 1.2, {0.5, 0.5, 0.9, 0.5, 2.0}, 0.0, 0.05};
        const auto rgba = picture::compose(image, display);
        const QImage expected(rgba.data(), 40, 30, QImage::Format_RGBA8888);
        canvas->setDisplay(display);
        canvas->setImage(std::make_shared<const picture::ProjectionImage>(std::move(image)));
        widget->show();
        QVERIFY(
            largestDifference(widget->grabFramebuffer().convertToFormat(QImage::Format_RGBA8888),
                              expected) <= 1);
    }

    // Pixel for pixel on the processor; on the card within the rounding of two engines to eight
    // bits.
    void theCommandLineMakesTheSamePicture() {
        useSmallWindow();
        find<QAction>("processorEngineAction")->trigger();
        open(headPath());
        dragMouse(projection(), Qt::LeftButton, QPoint(100, 100), QPoint(-80, 35));
        find<QAction>("depthCueAction")->trigger();
        settle();
        const QImage byProcessor = byCommandLine("cpu");
        QCOMPARE(largestDifference(byProcessor, composed(projection()->frames().renderer()(
                                                    projection()->sceneOfPicture().camera))),
                 0);
        QCOMPARE(largestDifference(byProcessor, projection()->picture()), 0);
        const auto &window = ui::windowCapabilities();
        if (!window || !window->canRender())
            return;
        chooseCard();
        const QImage expected = byCommandLine("gpu");
        QVERIFY(largestDifference(projection()->picture(), expected) <= 1);
        QVERIFY(largestDifference(canvas(), expected) <= 1);
    }

    void aMissingDisplayIsReportedInOneLine() {
        QProcess program;
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        for (const char *name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"})
            environment.remove(name);
        program.setProcessEnvironment(environment);
        program.start(PELLUCID_WORKSTATION, {});
        QVERIFY(program.waitForFinished(patienceMs));
        QCOMPARE(program.exitCode(), exitCode(task::ErrorCode::noSuchDevice));
        const QByteArray output = program.readAllStandardError();
        QVERIFY2(output.contains("there is no display") && output.count('\n') == 1, output);
    }

    void theProcessorReplacesAFailedCardUntilItIsChosenAgain() {
        needCard();
        open(headPath());
        chooseCard();
        const QImage before = projection()->picture();
        // A failure of the former passes does not concern the card that was chosen since.
        emit projection()->frames().cardFailed(task::because::cardWasLost, nullptr);
        QTRY_VERIFY_WITH_TIMEOUT(isOnCard(), patienceMs);
        emit projection()->frames().cardFailed(task::because::cardWasReset,
                                               mainWindow().graphicsCard().passes());
        settle();
        QVERIFY2(engineText().startsWith("CPU engine, "), qPrintable(engineText()));
        QVERIFY(engineText().contains("its driver was reset"));
        QVERIFY(largestDifference(projection()->picture(), before) <= 1);
        chooseCard();
    }

    void theProcessorMakesTheFramesOfALostCard() {
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{32, 32, 32}});
        const auto volume = phantom::makePhantom(phantom::Kind::head, lattice);
        scene::Scene scene;
        scene.camera = scene::defaultCamera(lattice);
        const auto prepared = prepare::prepareEngine(
            {scene, classify::ShownFields{{classify::densityField(volume, {-900, 2000})}, {}}});
        auto lost = std::make_shared<std::atomic<bool>>(false);
        const auto card = std::make_shared<gpu::FramePasses>(
            std::make_shared<gpu::Device>(std::make_unique<FragileContext>(lost)));
        ui::RenderWorker worker;
        // Frames arrive from the worker's thread, maybe before the test waits for them.
        std::vector<std::shared_ptr<const ui::RenderedFrame>> frames;
        int failures = 0;
        QObject receiver;
        connect(&worker, &ui::RenderWorker::frameReady, &receiver,
                [&](const std::shared_ptr<const ui::RenderedFrame> &frame) {
                    frames.push_back(frame);
                });
        connect(&worker, &ui::RenderWorker::cardFailed, &receiver, [&] { ++failures; });
        worker.setEngine(prepared, gpu::copyToCard(card, *prepared.engine), 1);
        const auto next = [&]() -> std::shared_ptr<const ui::RenderedFrame> {
            frames.clear();
            worker.request(scene.camera, scene.image, {}, {},
                           ui::RenderWorker::Exposed{
                               volume::Lattice::centred({100, 100, 100}, {1.2, 1.2, 1.2}), {}, {}});
            return QTest::qWaitFor([&] { return !frames.empty(); }, patienceMs) ? frames.front()
                                                                                : nullptr;
        };
        // Compiling on the GPU takes longer than a user waits: the CPU makes the first frame.
        auto onCard = next();
        QVERIFY(onCard &&
                (onCard->onCard || onCard->refusal == task::because::cardIsBeingPrepared));
        QVERIFY(onCard->onCard ||
                QTest::qWaitFor([&] { return frames.back()->onCard != nullptr; }, patienceMs));
        onCard = frames.back();
        QVERIFY(onCard->exposure);
        const auto picture = onCard->onCard->download();
        *lost = true;
        // On a busy machine, the loss is found after the processor has made a frame.
        QVERIFY(next());
        QTRY_VERIFY_WITH_TIMEOUT(frames.back()->refusal == task::because::cardWasReset, patienceMs);
        const auto after = frames.back();
        QVERIFY(!after->onCard);
        QCOMPARE(failures, 1);
        QCOMPARE(after->image.samples.size(), picture.samples.size());
        QVERIFY(relativeL2(picture.samples, after->image.samples) < 3e-4);
        QVERIFY(after->exposure);
        const auto later = next();
        QVERIFY(later && !later->refusal); // the lost one is not asked again
    }

    // The pane moves to another window, as when it is dragged to a second screen.
    void thePictureSurvivesAMoveToAnotherWindow() {
        needCard();
        open(headPath());
        chooseCard();
        const QImage before = canvas();
        auto *canvasWidget = find<QOpenGLWidget>("projectionCanvas");
        QWidget *const home = projection()->parentWidget();
        const QRect place = projection()->geometry();
        ui::ProjectionView *const view = projection();
        view->setParent(nullptr);
        view->resize(place.size());
        view->show();
        QVERIFY(QTest::qWaitForWindowExposed(view));
        QTRY_VERIFY_WITH_TIMEOUT(view->frames().showsFinalImage(), patienceMs);
        const QImage moved = canvasWidget->grabFramebuffer();
        view->setParent(home);
        view->show();
        QVERIFY(meanGrey(moved) > 5.0);
        QVERIFY(isOnCard());
        QCOMPARE(moved.size(), before.size());
        QVERIFY(largestDifference(moved, before) <= 1);
    }

    void layersOnTheCardFollowTheirWeights() {
        needCard();
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{32, 32, 32}});
        const auto volume = phantom::makePhantom(phantom::Kind::head, lattice);
        scene::Scene scene;
        scene.camera = scene::defaultCamera(lattice);
        const auto layers = prepare::LayerSet::prepare(
            scene, 3,
            [&](std::size_t n, const task::Progress &) {
                return classify::densityField(volume, {-900.0 + 400.0 * double(n), 2000.0});
            },
            {});
        ui::Document document;
        ui::JobRunner jobs;
        ui::GraphicsCard card;
        card.choose(ui::EngineChoice::card);
        ui::CardCopier copier(document, jobs, card);
        std::vector<ui::ShownEngine> shown;
        connect(&copier, &ui::CardCopier::engineReady, this,
                [&](const ui::ShownEngine &engine) { shown.push_back(engine); });
        const auto show = [&](double share) {
            copier.show({.engine = std::make_shared<prepare::MixtureEngine>(
                             layers, std::vector<render::ChannelWeights>{{share, 0.5, 0.5},
                                                                         {0.1, share, 0.0},
                                                                         {0.0, 0.2, 0.7}}),
                         .plan = layers->plan(),
                         .bytes = layers->bytes()},
                        ui::EngineStage::live);
        };
        show(1.0);
        QVERIFY(!shown.back().onCard); // at once, on the processor
        QTRY_VERIFY_WITH_TIMEOUT(shown.back().onCard && !jobs.isRunning(), patienceMs);
        const auto textures = &shown.back().onCard->textures();
        show(0.25);
        QVERIFY(shown.back().onCard);
        QCOMPARE(&shown.back().onCard->textures(), textures); // nothing is copied again
        QCOMPARE(shown.back().onCard->parts().channelWeights[1][1], 0.25);
        const auto expected = shown.back().prepared.engine->render(scene.camera, scene.image);
        const auto found = shown.back().onCard->render(scene.camera, scene.image);
        QCOMPARE(found.channels, expected.channels);
        QVERIFY(relativeL2(found.samples, expected.samples) < 3e-4); // the bound of both engines
        card.choose(ui::EngineChoice::automatic);
    }

    void aCancelledCopyLeavesTheProcessorInUse() {
        needCard();
        open(headPath());
        QSignalSpy started(&jobs(), &ui::JobRunner::started);
        connect(&jobs(), &ui::JobRunner::started, &mainWindow(), [this] { jobs().cancel(); });
        find<QAction>("cardEngineAction")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(started.count(), 1, patienceMs);
        QTRY_VERIFY_WITH_TIMEOUT(engineText().contains("cancelled"), patienceMs);
        QVERIFY(engineText().startsWith("CPU engine, "));
        settle();
        QVERIFY(!projection()->picture().isNull());
        // The copier decides in a queued call, which settle() has run: it does not begin again.
        QCOMPARE(started.count(), 1);
    }

    // Spectra and pictures: three studies leave no more than one.
    void aClosedStudyFreesItsMemoryOnTheCard() {
        needCard();
        open(headPath());
        chooseCard();
        const auto closeAndCount = [&] {
            bench().study.opener.closeSource(0);
            awaitCard();
            int count = -1;
            const bool rests = QTest::qWaitFor( // while the window paints
                [&] {
                    const int former = std::exchange(count, sharedGlObjects());
                    return former == count;
                },
                patienceMs);
            return rests ? count : -1;
        };
        const auto show = [&] {
            const int closed = sharedGlObjects();
            open(headPath());
            QTRY_VERIFY_WITH_TIMEOUT(isOnCard() && !jobs().isRunning(), patienceMs);
            // The check renders a grid of its own: without it, a study may need fewer tables than
            // the next one.
            QTRY_VERIFY_WITH_TIMEOUT(projection()->frames().error() &&
                                         projection()->frames().error()->isMeasured(),
                                     patienceMs);
            QVERIFY(sharedGlObjects() > closed);
        };
        // Studies leave what the next ones use again: pictures and tables, of which a few are kept.
        // A leak grows with every study.
        constexpr int first = 3, next = 5;
        const auto countAfter = [&](int studies) {
            int count = -1;
            for (int n = 0; n < studies; ++n) {
                show();
                count = closeAndCount();
            }
            return count;
        };
        closeAndCount();
        const int before = countAfter(first), after = countAfter(next);
        QVERIFY(before > 0 && after > 0);
        QVERIFY2(after < before + next, qPrintable(QString("%1 %2").arg(after).arg(before)));
        find<QAction>("automaticEngineAction")->trigger();
    }

    void theEngineChoiceIsRemembered() {
        find<QAction>("processorEngineAction")->trigger();
        restart();
        QVERIFY(find<QAction>("processorEngineAction")->isChecked());
        QVERIFY(engineText().contains("the processor was chosen"));
        find<QAction>("automaticEngineAction")->trigger();
        restart();
        QVERIFY(find<QAction>("automaticEngineAction")->isChecked());
    }

private:
    QString engineText() { return find<QLabel>("engineLabel")->text(); }
    bool isOnCard() { return engineText().startsWith("GPU engine, "); }
    QString path(const char *name) { return QString::fromStdString((m_folder / name).string()); }
    // A software renderer draws only the card's pictures; the others are drawn by the processor.
    QImage canvas() {
        for (auto *const widget : projection()->findChildren<QWidget *>("projectionCanvas")) {
            if (!widget->isVisible())
                continue;
            auto *const onCard = qobject_cast<QOpenGLWidget *>(widget);
            const QImage shown =
                onCard != nullptr ? onCard->grabFramebuffer() : widget->grab().toImage();
            return shown.convertToFormat(QImage::Format_RGBA8888);
        }
        return {};
    }
    QImage byCommandLine(const QString &engine) {
        const QString scene = path("scene.json"), out = path("picture.png");
        ui::writeSceneFile(scene, projection()->sceneOfPicture());
        QProcess command;
        command.start(PELLUCID_CLI,
                      {"render", headPath(), "-o", out, "--scene", scene, "--engine", engine});
        if (!command.waitForFinished(patienceMs) || command.exitCode() != 0)
            qWarning("%s", command.readAllStandardError().constData());
        return QImage(out).convertToFormat(QImage::Format_RGBA8888);
    }
    QImage composed(const picture::ProjectionImage &image) {
        const scene::Scene scene = projection()->sceneOfPicture();
        const auto rgba =
            picture::compose(image, picture::displayOf(scene.tone, scene.camera.orientation));
        return QImage(rgba.data(), image.width, image.height, QImage::Format_RGBA8888).copy();
    }
    // Waits until jobs, render worker and queued frames have released their objects on the card,
    // and the card has deleted them.
    void awaitCard() {
        jobs().join();
        // The worker drops the card first, then it answers: without a study there is no picture.
        QVERIFY_EXCEPTION_THROWN(projection()->frames().renderer()(document().scene().camera),
                                 task::Error);
        QCoreApplication::processEvents();
        mainWindow().graphicsCard().passes()->device().run([] {});
    }
    void chooseCard() {
        find<QAction>("cardEngineAction")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(isOnCard() && !jobs().isRunning(), patienceMs);
        settle();
    }
    // A pane whose pixels are no finer than the picture's: each is one pixel of the picture.
    void useSmallWindow() { restart({1000, 640}); }
    void needCard() {
        const auto &window = ui::windowCapabilities();
        if (!window || !window->canRender())
            QSKIP("no OpenGL 4.3 here");
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::EngineTest>(argc, argv);
}

#include "engine_test.moc"
