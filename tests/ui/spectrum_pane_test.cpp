// SPDX-License-Identifier: GPL-3.0-or-later
// The pane with the spectrum of the view: shown on demand, follows the view, costs nothing hidden.
#include "tests/ui/workstation.h"

#include <QDockWidget>
#include <QLabel>
#include <QSignalSpy>
#include <QToolButton>

#include "ui/panels/spectrum_plot.h"
#include "ui/views/spectrum_sampler.h"

namespace pellucid {

using namespace test;

class SpectrumPaneTest : public Workstation {
    Q_OBJECT
private slots:
    void theSpectrumTurnsWithTheView() {
        open(headPath());
        QVERIFY(!dock()->isVisible());
        QTest::keyClick(&mainWindow(), Qt::Key_S, Qt::ShiftModifier);
        QVERIFY(dock()->isVisible());
        QVERIFY(find<QAction>("spectrumAction")->isChecked());
        follow();
        const QImage anterior = plot()->picture();
        QCOMPARE(anterior, expected());
        QCOMPARE(qGray(anterior.pixel(128, 128)), 255); // 0 dB at frequency 0
        save("spectrum");
        QTest::keyClick(projection(), Qt::Key_3, Qt::KeypadModifier);
        follow();
        QVERIFY(changed(anterior, plot()->picture()) > 0.1);
        QCOMPARE(plot()->picture(), expected());
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(), {60, 40});
        settle();
        follow();
        QCOMPARE(plot()->picture(), expected());
        save("spectrum_oblique");
        QTest::keyClick(&mainWindow(), Qt::Key_S, Qt::ShiftModifier);
        QVERIFY(!dock()->isVisible());
    }

    // Of many views at once only the first and the last are sampled.
    void onlyTheLatestViewIsSampledWhileItTurns() {
        open(headPath());
        find<QAction>("spectrumAction")->trigger();
        follow();
        const QSignalSpy sampled(sampler(), &ui::SpectrumSampler::sampled);
        for (int n = 0; n < 40; ++n)
            projection()->turnAroundPatient(3.0);
        follow();
        QVERIFY2(sampled.size() <= 2, qPrintable(QString::number(sampled.size())));
        QCOMPARE(plot()->picture(), expected());
    }

    void aHiddenSpectrumCostsNothing() {
        const QSignalSpy sampled(sampler(), &ui::SpectrumSampler::sampled);
        const auto turn = [&] {
            projection()->turnAroundPatient(20.0);
            QVERIFY(!sampler()->isBehind()); // nothing runs, nothing waits
            settle();
            QVERIFY(!sampler()->isBehind());
        };
        open(headPath());
        turn();
        QCOMPARE(sampled.size(), 0);
        find<QAction>("spectrumAction")->trigger();
        follow();
        QCOMPARE(sampled.size(), 1);
        QTest::mouseClick(find<QToolButton>("spectrumDockHeading"), Qt::LeftButton); // folded
        turn();
        QCOMPARE(sampled.size(), 1);
        QTest::mouseClick(find<QToolButton>("spectrumDockHeading"), Qt::LeftButton);
        follow();
        QCOMPARE(sampled.size(), 2);
        QCOMPARE(plot()->picture(), expected());
        find<QAction>("spectrumAction")->trigger();
        turn();
        QCOMPARE(sampled.size(), 2);
    }

    void withoutAStudyThePaneShowsAHint() {
        find<QAction>("spectrumAction")->trigger();
        QVERIFY(find<QLabel>("spectrumHint")->isVisible());
        QVERIFY(!plot()->isVisible());
        open(headPath());
        follow();
        QVERIFY(plot()->isVisible());
        QVERIFY(!find<QLabel>("spectrumHint")->isVisible());
        mainWindow().document().closeVolume();
        QVERIFY(find<QLabel>("spectrumHint")->isVisible());
        QVERIFY(plot()->picture().isNull());
    }

    void theWindowRemembersThePane() {
        find<QAction>("spectrumAction")->trigger();
        mainWindow().close();
        restart();
        QVERIFY(dock()->isVisible());
        find<QAction>("spectrumAction")->trigger();
        mainWindow().close();
        restart();
        QVERIFY(!dock()->isVisible());
    }

    void theMouseReadsFrequencyAndStrength() {
        open(headPath());
        find<QAction>("spectrumAction")->trigger();
        follow();
        const auto *readout = find<QLabel>("spectrumReadout");
        const QRectF square = plot()->square();
        const double pixel = square.width() / ui::SpectrumSampler::side;
        moveMouse(plot(), (square.center() + QPointF(0.5 * pixel, 0.5 * pixel)).toPoint());
        QVERIFY2(readout->text().contains("dB"), qPrintable(readout->text()));
        // The upper edge is at the frequency of the band's circle: that of the samples, or of the
        // picture where its pixels are larger. A logical pixel of the plot is at most a few
        // hundredths of the limit.
        ui::Document &document = mainWindow().document();
        const volume::Lattice &lattice = document.volume()->lattice();
        const QSizeF small(100.0, 100.0); // a pane where the zoom allows both
        document.setProjectionSize(small);
        for (const double pixelMm : {0.5, 7.0}) {
            const double fitMm = ui::fittingPixelMm(lattice.radiusMm(), small);
            document.setPose({.zoom = fitMm / pixelMm});
            QVERIFY(std::abs(document.scene().camera.pixelMm - pixelMm) < 1e-9);
            follow();
            moveMouse(plot(), square.center().toPoint());
            moveMouse(plot(), QPointF(square.center().x(), square.top() + 1.0).toPoint());
            const double limit = 0.5 / std::max(pixelMm, lattice.shortestStepMm());
            const double read = readout->text().section(' ', 0, 0).toDouble();
            QVERIFY2(std::abs(read - limit) < 0.03 * limit, qPrintable(readout->text()));
        }
        QEvent leave(QEvent::Leave);
        QCoreApplication::sendEvent(plot(), &leave);
        QVERIFY(readout->text().isEmpty());
    }

private:
    QDockWidget *dock() { return find<QDockWidget>("spectrumDock"); }
    ui::SpectrumPlot *plot() { return find<ui::SpectrumPlot>("spectrumPlot"); }
    ui::SpectrumSampler *sampler() { return mainWindow().findChild<ui::SpectrumSampler *>(); }
    void follow() {
        QTRY_VERIFY_WITH_TIMEOUT(!sampler()->isBehind() && !plot()->picture().isNull(), patienceMs);
    }
    // Zoomed in, the band is that of the samples.
    scene::Camera camera() {
        const ui::Document &document = mainWindow().document();
        scene::Camera camera = document.scene().camera;
        camera.pixelMm = std::max(camera.pixelMm, document.volume()->lattice().shortestStepMm());
        return camera;
    }
    // By the core alone, of the prepared engine and the present view.
    QImage expected() {
        const auto slice =
            render::spectrumSlice(bench().study.preparer.fullEngine()->engine->parts(), camera(),
                                  ui::SpectrumSampler::side);
        const auto rgba = render::greyLevels(slice);
        return QImage(rgba.data(), slice.side, slice.side, QImage::Format_RGBA8888).copy();
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::SpectrumPaneTest>(argc, argv);
}

#include "spectrum_pane_test.moc"
