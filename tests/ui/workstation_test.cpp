// SPDX-License-Identifier: GPL-3.0-or-later
// The workstation as a person uses it: drops, drags, wheels and keys on the real window.
#include <QtTest>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMimeData>
#include <QPushButton>
#include <QSlider>
#include <QStandardPaths>
#include <QStyleOptionSlider>
#include <QToolButton>
#include <QTreeWidget>

#include "core/dicom/write_series.h"
#include "core/phantom/phantom.h"
#include "tests/support/temporary_folder.h"
#include "ui/kept_studies.h"
#include "ui/main_window.h"
#include "ui/panels/curve_editor.h"
#include "ui/panels/series_panel.h"
#include "ui/views/mpr_view.h"
#include "ui/views/projection_view.h"

namespace pellucid {

namespace {

constexpr int patienceMs = 60000;

QString testData() {
    return qEnvironmentVariable("PELLUCID_TEST_DATA");
}

void drop(QWidget &window, const QList<QUrl> &urls) {
    QMimeData data;
    data.setUrls(urls);
    QDragEnterEvent enter(QPoint(400, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent dropped(QPointF(400, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &dropped);
}

double meanGrey(const QImage &image) {
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            sum += qGray(image.pixel(x, y));
    return sum / (double(image.width()) * image.height());
}

// The mean distance of the channels from each other.
double colorfulness(const QImage &image) {
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const QRgb p = image.pixel(x, y);
            sum +=
                std::max({qRed(p), qGreen(p), qBlue(p)}) - std::min({qRed(p), qGreen(p), qBlue(p)});
        }
    return sum / (double(image.width()) * image.height());
}

void moveMouse(QWidget *widget, QPoint to) {
    QMouseEvent move(QEvent::MouseMove, to, widget->mapToGlobal(to), Qt::NoButton, Qt::NoButton,
                     Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &move);
}

double meanGrey(const QImage &image, const QRect &area) {
    return meanGrey(image.copy(area));
}

// Share of pixels that differ clearly.
double changed(const QImage &a, const QImage &b) {
    if (a.size() != b.size())
        return 1.0;
    qint64 count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            count += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))) > 8 ? 1 : 0;
    return double(count) / (double(a.width()) * a.height());
}

void dragMouse(QWidget *widget, Qt::MouseButton button, QPoint from, QPoint by) {
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

void turnWheel(QWidget *widget, int steps) {
    const QPointF at = widget->rect().center();
    QWheelEvent event(at, widget->mapToGlobal(at), {}, QPoint(0, 120 * steps), Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(widget, &event);
}

} // namespace

class WorkstationTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        QStandardPaths::setTestModeEnabled(true);
        QSettings().clear();
        // The user's own presets stay out of it.
        qputenv("XDG_DATA_HOME", QByteArray::fromStdString((m_folder / "data").string()));
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{96, 96, 80}});
        dicom::writeCtSeries(
            m_folder / "head", phantom::makePhantom(phantom::Kind::head, lattice),
            {.patientName = "Secret^Name", .windows = {{40, 100, ""}, {300, 1500, ""}}},
            dicom::TransferSyntax::explicitLittle);
    }

    void init() {
        m_window = std::make_unique<ui::MainWindow>(ui::Theme::named("dark"));
        m_window->resize(1600, 1000);
        m_window->show();
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    }
    void cleanup() { m_window.reset(); }

    void showsTheStartPageAndNoPatientName() {
        QVERIFY(find<QWidget>("startPage")->isVisible());
        QVERIFY(!find<QWidget>("paneArea")->isVisible());
        open(headPath());
        QVERIFY(!find<QWidget>("startPage")->isVisible());
        QVERIFY(!m_window->windowTitle().contains("Secret"));
        // The open series is the selected row.
        QVERIFY(m_window->document().currentSource() == 0);
        QVERIFY(find<QTreeWidget>("seriesTree")->currentItem() != nullptr);
    }

    void everyPaneShowsTheVolume() {
        open(headPath());
        for (const char *name : {"axialView", "coronalView", "sagittalView", "projectionView"}) {
            const QImage pane = grab(name);
            QVERIFY2(meanGrey(pane) > 8.0, name);
            // The corner away from texts is outside the patient.
            QVERIFY2(meanGrey(pane, QRect(4, pane.height() / 4, 10, 10)) < 3.0, name);
        }
        // Radiological convention on the head: the nose is up in the axial pane, at the left in the
        // sagittal.
        const QImage sagittal = grab("sagittalView");
        const int w = sagittal.width(), h = sagittal.height();
        QVERIFY(meanGrey(sagittal, QRect(w / 8, h * 6 / 10, w / 4, h / 5)) > 5.0);
    }

    void orbitingTurnsThePictureAndTheLetters() {
        open(headPath());
        const QImage before = grab("projectionView");
        const auto camera = m_window->document().scene().camera;
        QSignalSpy finalShown(projection(), &ui::ProjectionView::finalImageShown);
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(),
                  {197, 0}); // 90 degrees
        QTRY_VERIFY_WITH_TIMEOUT(projection()->showsFinalImage(), patienceMs);
        QVERIFY(changed(before, grab("projectionView")) > 0.02);
        // Dragging to the right brings the patient's right side, at image left, to the front.
        const glm::dmat3 axes = m_window->document().scene().camera.axes();
        QVERIFY2(axes[2].x < -0.9, "the viewer now stands at the patient's right");
        QVERIFY(!(m_window->document().scene().camera == camera));
        // Looking is not undoable.
        QVERIFY(!m_window->document().undoStack()->canUndo());
        QTest::keyClick(projection(), Qt::Key_1, Qt::KeypadModifier);
        QTRY_VERIFY_WITH_TIMEOUT(projection()->showsFinalImage(), patienceMs);
        QVERIFY(glm::dot(m_window->document().scene().camera.axes()[2], glm::dvec3(0, -1, 0)) >
                0.999);
    }

    void thePlanesScrollAndTheCrosshairIsLinked() {
        open(headPath());
        const QImage before = grab("axialView");
        const QImage coronal = grab("coronalView");
        const double z = m_window->document().crosshair().mm.z;
        turnWheel(find<QWidget>("axialView"), 1);
        QVERIFY(m_window->document().crosshair().mm.z > z);
        turnWheel(find<QWidget>("axialView"), 1);
        turnWheel(find<QWidget>("axialView"), 1);
        QVERIFY(changed(before, grab("axialView")) > 0.005);
        QVERIFY(changed(coronal, grab("coronalView")) > 0.0005); // its crosshair line moved
        QTest::keyClick(find<QWidget>("axialView"), Qt::Key_Home);
        const auto &lattice = m_window->document().volume()->lattice();
        QVERIFY(std::abs(m_window->document().crosshair().mm.z - lattice.origin().mm.z) < 1e-6);
    }

    void windowingIsUndoneInOneStep() {
        open(headPath());
        const auto before = m_window->document().displayWindow();
        const QImage picture = grab("axialView");
        dragMouse(find<QWidget>("axialView"), Qt::LeftButton, {150, 150}, {80, -60});
        QVERIFY(m_window->document().displayWindow().width > before.width);
        QVERIFY(m_window->document().displayWindow().center > before.center);
        QVERIFY(changed(picture, grab("axialView")) > 0.02);
        QCOMPARE(m_window->document().undoStack()->count(), 1);
        find<QAction>("undoAction")->trigger();
        QVERIFY(m_window->document().displayWindow() == before);
        // A preset by its key, and back.
        QTest::keyClick(m_window.get(), Qt::Key_4);
        QCOMPARE(m_window->document().displayWindow().width, 1500.0);
        find<QAction>("undoAction")->trigger();
        QVERIFY(m_window->document().displayWindow() == before);
    }

    void reconstructionAndFilmAreUndoableEditsOfTheScene() {
        open(headPath());
        const QImage before = grab("projectionView");
        find<QAction>("filmAction")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(projection()->showsFinalImage(), patienceMs);
        QTRY_VERIFY(meanGrey(grab("projectionView")) > meanGrey(before) + 40.0);
        find<QAction>("bandLimitedAction")->trigger();
        QVERIFY(m_window->document().scene().image.reconstruction ==
                render::Reconstruction::bandLimited);
        find<QAction>("undoAction")->trigger();
        find<QAction>("undoAction")->trigger();
        QVERIFY(m_window->document().scene().tone == render::Tone());
        QVERIFY(!find<QAction>("filmAction")->isChecked());
    }

    void qualityIsAnUndoableChoiceThatShowsItsPrice() {
        open(headPath());
        const auto predicted = [&] {
            return find<QLabel>("predictedErrorLabel")->text().section(' ', 0, 0).toDouble();
        };
        const double standard = predicted();
        QVERIFY(standard > 0.0 && standard <= 0.11);
        QVERIFY(find<QLabel>("planLabel")->text().startsWith("LS4"));
        QVERIFY(find<QLabel>("frameTimeLabel")->text().endsWith("ms"));
        const QImage before = projection()->picture();

        auto *quality = find<QComboBox>("qualityBox");
        quality->setCurrentIndex(quality->findText("Fine"));
        emit quality->activated(quality->currentIndex());
        QTRY_VERIFY_WITH_TIMEOUT(!m_window->jobs().isRunning() && predicted() <= 0.01, patienceMs);
        QTRY_VERIFY_WITH_TIMEOUT(projection()->showsFinalImage(), patienceMs);
        QVERIFY(!find<QLabel>("planLabel")->text().startsWith("LS4"));
        QCOMPARE(find<QLineEdit>("toleranceEdit")->text(), QString("0.01 %"));
        // A tenth of a percent is below what the eye sees in 256 greys.
        QVERIFY(changed(before, projection()->picture()) < 0.001);

        // A kernel of the user's own choice is used though it misses the tolerance, and says so.
        auto *kernel = find<QComboBox>("kernelBox");
        kernel->setCurrentIndex(kernel->findText("trilinear"));
        emit kernel->activated(kernel->currentIndex());
        QTRY_VERIFY_WITH_TIMEOUT(find<QLabel>("planLabel")->text().startsWith("trilinear") &&
                                     !m_window->jobs().isRunning(),
                                 patienceMs);
        QVERIFY(predicted() > 1.0);
        QVERIFY(find<QLabel>("planReasonLabel")->text().startsWith("More error than allowed"));
        save("quality_trilinear");

        auto *tolerance = find<QLineEdit>("toleranceEdit");
        tolerance->setText("not a number");
        QTest::keyClick(tolerance, Qt::Key_Return);
        QCOMPARE(tolerance->text(), QString("0.01 %")); // refused, what holds is shown again
        QVERIFY(find<QLabel>("planReasonLabel")->text().contains("not a number"));

        // A cancelled preparation leaves the former plan; choosing the same again makes up for it.
        auto *padding = find<QComboBox>("paddingBox");
        padding->setCurrentIndex(padding->findText("1.25"));
        emit padding->activated(padding->currentIndex());
        m_window->jobs().cancel();
        QVERIFY(find<QLabel>("paddingLabel")->text().startsWith("2."));
        emit padding->activated(padding->currentIndex());
        QTRY_VERIFY_WITH_TIMEOUT(!m_window->jobs().isRunning() &&
                                     find<QLabel>("paddingLabel")->text().startsWith("1."),
                                 patienceMs);
        m_window->document().undoStack()->undo();

        m_window->document().undoStack()->undo();
        m_window->document().undoStack()->undo();
        QCOMPARE(m_window->document().scene().tolerance, render::Scene().tolerance);
        QCOMPARE(quality->currentText(), QString("Standard"));
        QTRY_VERIFY_WITH_TIMEOUT(!m_window->jobs().isRunning() && predicted() == standard,
                                 patienceMs);
    }

    void aBentSegmentIsShownUndoneSavedAndFoundAgain() {
        open(headPath());
        auto *editor = find<ui::CurveEditor>("curveEditor");
        const QImage before = projection()->picture();
        // The segment under the mouse is framed, and what the curve weighs there is told.
        const QImage calm = editor->grab().toImage();
        const QPoint handle = editor->handleAt(1).toPoint();
        moveMouse(editor, handle);
        QTRY_VERIFY(changed(calm, editor->grab().toImage()) > 0.005);
        // Bone and the brain are dense: the second of six segments is skin and fat, the third
        // water.
        dragMouse(editor, Qt::LeftButton, editor->handleAt(2).toPoint(), {0, 200});
        const auto &weights = m_window->document().scene().look.transferFunction.weights;
        QCOMPARE(weights[2], 0.0);
        QCOMPARE(m_window->document().undoStack()->count(), 1); // one drag, one step
        settle();
        QVERIFY(changed(before, projection()->picture()) > 0.02);
        save("transfer_function");
        // A typed weight, and a double-click that resets it.
        auto *weight = find<QDoubleSpinBox>("weightBox");
        weight->setFocus();
        weight->selectAll();
        QTest::keyClicks(weight, "1.45");
        QTest::keyClick(weight, Qt::Key_Return);
        QCOMPARE(weights[2], 1.45);
        QTest::mouseDClick(editor, Qt::LeftButton, Qt::NoModifier, editor->handleAt(2).toPoint());
        QCOMPARE(weights[2], 1.0);
        find<QAction>("undoAction")->trigger();
        find<QAction>("undoAction")->trigger();
        QCOMPARE(weights[2], 0.0);
        // More points hold the same curve.
        find<QSpinBox>("pointsBox")->setValue(9);
        QCOMPARE(int(weights.size()), 9);
        settle();
        find<QAction>("undoAction")->trigger();
        QCOMPARE(int(weights.size()), 6);
        // Copied, reset and pasted.
        QTest::mouseClick(find<QPushButton>("copyCurveButton"), Qt::LeftButton);
        QTest::mouseClick(find<QPushButton>("resetCurveButton"), Qt::LeftButton);
        QVERIFY(m_window->document().scene().look == classify::Look());
        QTest::mouseClick(find<QPushButton>("pasteCurveButton"), Qt::LeftButton);
        QCOMPARE(weights[2], 0.0);
        // Two clicks keep the look.
        QTest::mouseClick(find<QPushButton>("saveLookButton"), Qt::LeftButton);
        QTest::mouseClick(find<QPushButton>("keepLookButton"), Qt::LeftButton);
        auto *gallery = find<QListWidget>("presetGallery");
        QCOMPARE(int(gallery->findItems("Own look 1", Qt::MatchExactly).size()), 1);
        while (m_window->document().undoStack()->canUndo())
            find<QAction>("undoAction")->trigger();
        settle();
        QVERIFY(changed(before, projection()->picture()) < 0.001);

        // Another day: it is there, and shows the same.
        cleanup();
        init();
        open(headPath());
        gallery = find<QListWidget>("presetGallery");
        const auto found = gallery->findItems("Own look 1", Qt::MatchExactly);
        QCOMPARE(int(found.size()), 1);
        gallery->scrollToItem(found.front());
        QTest::mouseClick(gallery->viewport(), Qt::LeftButton, Qt::NoModifier,
                          gallery->visualItemRect(found.front()).center());
        QCOMPARE(m_window->document().scene().look.transferFunction.weights[2], 0.0);
        settle();
        QVERIFY(changed(before, projection()->picture()) > 0.02);
        find<QAction>("undoAction")->trigger();
        QVERIFY(m_window->document().scene().look == classify::Look());
    }

    void presetsShowClassesInColourAndTheirWeightsMoveThePicture() {
        open(headPath());
        auto *gallery = find<QListWidget>("presetGallery");
        // Pictures of the open study come by themselves; MR presets are not offered for CT.
        const auto item = [&](const char *name) {
            const auto items = gallery->findItems(name, Qt::MatchExactly);
            return items.isEmpty() ? nullptr : items.front();
        };
        QVERIFY(item("MR: brain") == nullptr);
        QTRY_VERIFY_WITH_TIMEOUT(meanGrey(item("Bone")->icon().pixmap(60, 52).toImage()) > 3.0,
                                 patienceMs);
        gallery->scrollToItem(item("Bone over soft tissue"));
        QTest::mouseClick(gallery->viewport(), Qt::LeftButton, Qt::NoModifier,
                          gallery->visualItemRect(item("Bone over soft tissue")).center());
        settle();
        const QImage colored = projection()->picture();
        QVERIFY2(colorfulness(colored) > 2.0, "bone is ivory, soft tissue blue");
        QCOMPARE(int(m_window->document().scene().look.classes.size()), 2);

        // The weight of soft tissue by its slider: the picture follows, one drag is one step.
        auto *slider = find<QSlider>("classSlider1");
        const int count = m_window->document().undoStack()->count();
        QStyleOptionSlider option;
        option.initFrom(slider);
        option.minimum = slider->minimum();
        option.maximum = slider->maximum();
        option.sliderPosition = option.sliderValue = slider->value();
        const QRect knob = slider->style()->subControlRect(QStyle::CC_Slider, &option,
                                                           QStyle::SC_SliderHandle, slider);
        dragMouse(slider, Qt::LeftButton, knob.center(), {40, 0});
        QVERIFY(m_window->document().scene().look.classes[1].weight > 0.8);
        QCOMPARE(m_window->document().undoStack()->count(), count + 1);
        settle();
        QVERIFY(changed(colored, projection()->picture()) > 0.02);
        save("classes");
        // The dot hides it and brings it back as it was.
        const double weight = m_window->document().scene().look.classes[1].weight;
        QTest::mouseClick(find<QToolButton>("classEye1"), Qt::LeftButton);
        QCOMPARE(m_window->document().scene().look.classes[1].weight, 0.0);
        settle();
        QVERIFY2(colorfulness(projection()->picture()) < colorfulness(colored), "bone alone");
        QTest::mouseClick(find<QToolButton>("classEye1"), Qt::LeftButton);
        QCOMPARE(m_window->document().scene().look.classes[1].weight, weight);

        // A range is edited with a tint on the planes.
        const QImage plane = grab("axialView");
        QTest::mouseDClick(find<QWidget>("classRow0"), Qt::LeftButton, Qt::NoModifier, {40, 8});
        auto *dialog = find<QDialog>("classDialog");
        find<QDoubleSpinBox>("classLowBox")->setValue(-100.0);
        QTRY_VERIFY(colorfulness(grab("axialView")) > colorfulness(plane) + 2.0);
        save("class_tint");
        dialog->accept();
        QTRY_VERIFY(colorfulness(grab("axialView")) < colorfulness(plane) + 1.0);
        QCOMPARE(m_window->document().scene().look.classes[0].low, -100.0);
        settle();
        while (m_window->document().undoStack()->canUndo())
            find<QAction>("undoAction")->trigger();
        QVERIFY(m_window->document().scene().look == classify::Look());
        settle();
        QVERIFY(colorfulness(projection()->picture()) < 0.01);
    }

    void aPresetThatCannotBeKeptIsRefusedAndNothingIsLost() {
        open(headPath());
        QTest::mouseClick(find<QPushButton>("saveLookButton"), Qt::LeftButton);
        auto *name = find<QLineEdit>("lookNameEdit");
        name->setText("X-ray");
        QTest::keyClick(name, Qt::Key_Return);
        QVERIFY(find<QLabel>("presetSaid")->isVisible());
        QVERIFY(find<QLabel>("presetSaid")->text().contains("comes with the program"));
        QVERIFY(name->isVisible()); // still there, to be given another name
        QTest::keyClick(name, Qt::Key_Escape);
        QVERIFY(!name->isVisible());
    }

    void aStudyThatWasOpenComesBackAtOnceAsItWas() {
        open(headPath());
        auto *gallery = find<QListWidget>("presetGallery");
        const auto bone = gallery->findItems("Bone", Qt::MatchExactly).front();
        gallery->scrollToItem(bone);
        QTest::mouseClick(gallery->viewport(), Qt::LeftButton, Qt::NoModifier,
                          gallery->visualItemRect(bone).center());
        settle();
        const QImage before = projection()->picture();
        find<QAction>("chestPhantomAction")->trigger();
        QTRY_VERIFY(m_window->document().currentSource() == 1);
        settle();
        QVERIFY(m_window->document().scene().look == classify::Look()); // a study of its own
        emit find<ui::SeriesPanel>("seriesPanel")->sourceActivated(0);
        QVERIFY(!m_window->jobs().isRunning());
        QVERIFY(!m_window->document().scene().look.classes.empty());
        settle();
        QVERIFY(changed(before, projection()->picture()) < 0.001);
    }

    void ofKeptStudiesTheSpectraGoFirstAndTheOldestFirst() {
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{32, 32, 32}});
        const auto volume = phantom::makePhantom(phantom::Kind::head, lattice);
        render::Scene scene;
        scene.camera = render::defaultCamera(lattice);
        const auto engine =
            render::prepareEngine(scene, {{classify::densityField(volume, {-900, 2000})}, {}}, {});
        ui::KeptStudies kept;
        for (int source = 0; source < 3; ++source)
            kept.keep({source, volume, {}, {}, scene, ui::PreparedFor(), engine, {}, {}});
        const std::size_t one = volume.bytes() + engine.bytes;
        QCOMPARE(kept.bytes(), 3 * one);
        kept.trim(3 * one - 1);
        QCOMPARE(int(kept.count()), 3); // a spectrum went
        QVERIFY(!kept.take(0)->engine);
        QVERIFY(kept.take(2)->engine);
        kept.trim(volume.bytes());
        QCOMPARE(int(kept.count()), 1);
        QVERIFY(!kept.take(1)->engine);
        QVERIFY(!kept.take(1));
        QCOMPARE(kept.bytes(), std::size_t(0));
    }

    void aPaneFillsTheWindowByDoubleClick() {
        open(headPath());
        auto *axial = find<QWidget>("axialView");
        const QSize before = axial->size();
        QTest::mouseDClick(axial, Qt::LeftButton);
        QVERIFY(axial->width() > 2 * before.width());
        QVERIFY(!projection()->isVisible());
        QTest::mouseDClick(axial, Qt::LeftButton);
        QCOMPARE(axial->size(), before);
        QVERIFY(projection()->isVisible());
    }

    void theReadoutNamesPositionAndValue() {
        open(headPath());
        auto *axial = find<QWidget>("axialView");
        QTest::mouseMove(axial, axial->rect().center());
        QMouseEvent move(QEvent::MouseMove, axial->rect().center(),
                         axial->mapToGlobal(axial->rect().center()), Qt::NoButton, Qt::NoButton,
                         Qt::NoModifier);
        QCoreApplication::sendEvent(axial, &move);
        const QString text = find<QLabel>("cursorReadout")->text();
        QVERIFY2(text.contains("HU") && text.contains("mm"), qPrintable(text));
    }

    void problemsAreListedAndNothingPopsUp() {
        const std::string file = (m_folder / "notes.txt").string();
        std::ofstream(file) << "this is a letter to the patient and no image at all";
        drop(*m_window, {QUrl::fromLocalFile(QString::fromStdString(file))});
        auto *list = find<QListWidget>("problemList");
        QTRY_VERIFY_WITH_TIMEOUT(list->count() == 1 && !m_window->jobs().isRunning(), patienceMs);
        QVERIFY(list->item(0)->text().contains("not a DICOM file"));
        QVERIFY(QApplication::activeModalWidget() == nullptr);
        drop(*m_window, {QUrl::fromLocalFile("/no/such/place")});
        QTRY_VERIFY_WITH_TIMEOUT(
            list->count() == 1 && list->item(0)->text().contains("does not exist"), patienceMs);
        QVERIFY(find<QWidget>("startPage")->isVisible());
    }

    void cancelGivesTheProgramBackAtOnce() {
        find<QPushButton>("headPhantomButton")->click();
        QTRY_VERIFY(m_window->jobs().isRunning());
        QTest::qWait(60);
        QElapsedTimer clock;
        clock.start();
        find<QPushButton>("cancelButton")->click();
        QVERIFY(!m_window->jobs().isRunning());
        QVERIFY2(clock.elapsed() < 100, "the promise is 100 ms");
        QTest::qWait(400); // a late result would arrive now
        QVERIFY(!m_window->document().volume());
        // And it can be opened again.
        open(headPath());
        QVERIFY(m_window->document().volume());
    }

    void thePhantomOpensFromTheStartPage() {
        find<QPushButton>("headPhantomButton")->click();
        QTRY_VERIFY_WITH_TIMEOUT(projection()->showsFinalImage(), patienceMs);
        save("phantom");
        QVERIFY(meanGrey(grab("projectionView")) > 5.0);
        QCOMPARE(find<QTreeWidget>("seriesTree")->topLevelItemCount(), 1);
    }

    void imagesWithoutPositionsOpenAsImages() {
        if (testData().isEmpty())
            QSKIP("PELLUCID_TEST_DATA is not set: the real series are absent");
        drop(*m_window, {QUrl::fromLocalFile(testData() + "/nasty_pydicom/image_dfl.dcm")});
        QTRY_VERIFY_WITH_TIMEOUT(m_window->document().volume() && !m_window->jobs().isRunning(),
                                 patienceMs);
        QVERIFY(!m_window->document().volume()->notes().placed);
        QVERIFY(meanGrey(grab("axialView")) > 5.0);
    }

    // The issue's own scene: drop, wait, orbit, scroll, window, and look.
    void theChestCtByDrop() {
        if (testData().isEmpty())
            QSKIP("PELLUCID_TEST_DATA is not set: the real series are absent");
        open(testData() + "/ct_chest_philips_64");
        save("chest");
        for (const char *name : {"axialView", "coronalView", "sagittalView", "projectionView"})
            QVERIFY2(meanGrey(grab(name)) > 10.0, name);
        // The lungs are darker than the mediastinum between them.
        const QImage front = grab("projectionView");
        const int w = front.width(), h = front.height();
        const double middle = meanGrey(front, QRect(w / 2 - 20, h / 2 - 20, 40, 40));
        const double lung = meanGrey(front, QRect(w * 38 / 100 - 20, h / 2 - 20, 40, 40));
        QVERIFY2(middle > lung + 30.0, "mediastinum over lung");
        // The heart lies to the patient's left, at image right; at image left there is lung.
        const double heart = meanGrey(front, QRect(w * 56 / 100 - 12, h * 60 / 100 - 12, 24, 24));
        const double mirror = meanGrey(front, QRect(w * 44 / 100 - 12, h * 60 / 100 - 12, 24, 24));
        QVERIFY2(heart > mirror + 15.0, "the heart is on the patient's left");

        const QImage coronal = grab("coronalView"), axial = grab("axialView");
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(), {120, -40});
        QTRY_VERIFY_WITH_TIMEOUT(projection()->showsFinalImage(), patienceMs);
        QVERIFY(changed(front, grab("projectionView")) > 0.05);
        for (int n = 0; n < 6; ++n)
            turnWheel(find<QWidget>("axialView"), 1);
        QVERIFY(changed(axial, grab("axialView")) > 0.02);
        QTest::keyClick(m_window.get(), Qt::Key_5); // lung window
        QVERIFY(changed(coronal, grab("coronalView")) > 0.1);
        save("chest_turned");
    }

private:
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
    std::unique_ptr<ui::MainWindow> m_window;
};

} // namespace pellucid

int main(int argc, char **argv) {
    QSurfaceFormat format;
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    QSurfaceFormat::setDefaultFormat(format);
    QApplication application(argc, argv);
    QApplication::setApplicationName("pellucid-test");
    QApplication::setOrganizationName("pellucid-test");
    pellucid::ui::Theme::named("dark").apply(application);
    pellucid::WorkstationTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "workstation_test.moc"
