// SPDX-License-Identifier: GPL-3.0-or-later
// Annotations of the planes (Cobb angles, polylines, arrows, texts), the commands that hide them,
// and the menus of the panes.
#include "tests/ui/workstation.h"

#include <utility>

#include <QClipboard>
#include <QLineEdit>
#include <QMenu>
#include <QPdfWriter>
#include <QPrintDialog>
#include <QTableWidget>
#include <QToolButton>
#include <QTreeWidget>

#include "ui/export/print_picture.h"
#include "ui/views/mpr_view.h"

namespace pellucid {

using namespace test;

class AnnotationsTest : public Workstation {
    Q_OBJECT
private slots:
    void init() {
        Workstation::init();
        open(headPath());
        // Room for figures.
        emit plane()->maximizeRequested(plane());
        QCoreApplication::processEvents();
    }

    void aCobbAngleTakesTwoDrags() {
        key(Qt::Key_A, Qt::ShiftModifier);
        dragMouse(plane(), Qt::LeftButton, QPoint(300, 300), QPoint(200, 0));
        QVERIFY(measured().empty());
        QTest::mouseClick(plane(), Qt::LeftButton, {}, QPoint(320, 520)); // makes no line
        QVERIFY(measured().empty());
        // Drawn from right to left: the smaller angle counts.
        dragMouse(plane(), Qt::LeftButton, QPoint(500, 500), QPoint(-200, -100));
        QCOMPARE(measured().size(), std::size_t(1));
        QCOMPARE(measured()[0].measurement.kind, measure::Kind::cobbAngle);
        const double expected = std::atan2(100.0, 200.0) * 180.0 / std::acos(-1.0);
        QVERIFY(std::abs(*measured()[0].result.angleDegrees - expected) < 1e-6);
        QCOMPARE(find<QTreeWidget>("measurementList")->topLevelItem(0)->text(0),
                 QString("Cobb angle 1"));
        save("cobb");
        key(Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(measured().empty());
    }

    void aPolylineEndsWithADoubleClickOrEnter() {
        key(Qt::Key_M, Qt::ShiftModifier);
        const auto click = [&](const QPoint &at) {
            moveMouse(plane(), at);
            QTest::mouseClick(plane(), Qt::LeftButton, {}, at);
        };
        for (const QPoint &at : {QPoint(300, 300), QPoint(400, 300), QPoint(400, 420)})
            click(at);
        moveMouse(plane(), QPoint(430, 460));
        QTest::mouseClick(plane(), Qt::LeftButton, {}, QPoint(430, 460));
        QTest::mouseDClick(plane(), Qt::LeftButton, {}, QPoint(430, 460));
        QCOMPARE(measured().size(), std::size_t(1));
        QCOMPARE(measured()[0].measurement.pointsMm.size(), std::size_t(4));
        const double pixels = plane()->mapping().pixelsPerMm();
        QVERIFY(std::abs(*measured()[0].result.lengthMm - (100.0 + 120.0 + 50.0) / pixels) < 1e-6);
        // The pane was not maximized by the double-click, which would show the others again.
        QVERIFY(!find<QWidget>("coronalView")->isVisible());
        for (const QPoint &at : {QPoint(500, 300), QPoint(560, 300)})
            click(at);
        moveMouse(plane(), QPoint(600, 600));
        QTest::keyClick(plane(), Qt::Key_Return);
        QCOMPARE(measured().size(), std::size_t(2));
        QVERIFY(std::abs(*measured()[1].result.lengthMm - 60.0 / pixels) < 1e-6);
        // Esc drops one.
        click(QPoint(600, 500));
        click(QPoint(640, 500));
        QTest::keyClick(plane(), Qt::Key_Escape);
        QTest::keyClick(plane(), Qt::Key_Return);
        QCOMPARE(measured().size(), std::size_t(2));
    }

    void arrowsAndTextsSayWhatTheUserTypes() {
        key(Qt::Key_Y);
        dragMouse(plane(), Qt::LeftButton, QPoint(420, 400), QPoint(90, -70));
        QVERIFY(measured().empty());
        type("Stone, 4 mm"); // letters are no keys of tools here
        QCOMPARE(measured().size(), std::size_t(1));
        QCOMPARE(measured()[0].measurement.kind, measure::Kind::arrow);
        QCOMPARE(measured()[0].measurement.name, std::string("Stone, 4 mm"));
        // The tip is where the drag began.
        const QPointF tip = plane()->mapping().positionOf({measured()[0].measurement.pointsMm[0]});
        QVERIFY((tip - QPointF(420, 400)).manhattanLength() < 0.01);
        key(Qt::Key_T, Qt::ShiftModifier);
        QTest::mouseClick(plane(), Qt::LeftButton, {}, QPoint(300, 500));
        type("Left");
        QCOMPARE(measured().size(), std::size_t(2));
        QTest::mouseClick(plane(), Qt::LeftButton, {}, QPoint(300, 560));
        QTest::keyClick(field(), Qt::Key_Escape);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QCOMPARE(measured().size(), std::size_t(2));
        save("annotations");
        // A double-click changes it.
        QTest::mouseDClick(plane(), Qt::LeftButton, {}, QPoint(300, 500));
        type("Right");
        QCOMPARE(measured()[1].measurement.name, std::string("Right"));
        key(Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(measured()[1].measurement.name, std::string("Left"));
        restart();
        open(headPath());
        QCOMPARE(measured().size(), std::size_t(2));
        QCOMPARE(measured()[1].measurement.name, std::string("Left"));
    }

    void aCobbAngleIsMeasuredInTheProjection() {
        emit plane()->maximizeRequested(plane());
        settle();
        key(Qt::Key_A, Qt::ShiftModifier);
        const auto camera = document().scene().camera;
        dragMouse(projection(), Qt::LeftButton, QPoint(300, 300), QPoint(120, 0));
        dragMouse(projection(), Qt::LeftButton, QPoint(300, 420), QPoint(120, 60));
        QCOMPARE(measured().size(), std::size_t(1));
        QVERIFY(measured()[0].measurement.isProjected);
        QVERIFY(std::abs(*measured()[0].result.angleDegrees -
                         std::atan2(60.0, 120.0) * 180.0 / std::acos(-1.0)) < 1e-6);
        QVERIFY(document().scene().camera == camera);
    }

    void aSmallPaneShowsTheMainFigureOnly() {
        key(Qt::Key_E);
        const QPoint middle = plane()->rect().center();
        dragMouse(plane(), Qt::LeftButton, middle - QPoint(30, 20), QPoint(60, 40));
        document().selectMeasurement(-1);
        const QImage large = grab("axialView");
        emit plane()->maximizeRequested(plane());
        mainWindow().resize(900, 640);
        QCoreApplication::processEvents();
        const auto share = [&](QImage picture) {
            // The yellow of figures and texts.
            int count = 0;
            for (int y = 0; y < picture.height(); ++y)
                for (int x = 0; x < picture.width(); ++x) {
                    const QColor c = picture.pixelColor(x, y);
                    count += c.red() > 200 && c.green() > 160 && c.blue() < 120 ? 1 : 0;
                }
            return double(count) / (picture.width() * picture.height());
        };
        // Four lines of text would be more than the outline and one line.
        const QImage small = grab("axialView");
        QVERIFY(small.width() < 0.6 * large.width());
        QVERIFY2(share(small) < 0.02, qPrintable(QString::number(share(small))));
        save("small_pane");
    }

    void annotationsAndCrosshairAreHiddenAndComeBack() {
        key(Qt::Key_M);
        dragMouse(plane(), Qt::LeftButton, QPoint(300, 300), QPoint(100, 50));
        key(Qt::Key_W);
        document().selectMeasurement(-1);
        const QImage all = rested();
        key(Qt::Key_H, Qt::ShiftModifier);
        const QImage withoutCrosshair = grab("axialView");
        QVERIFY(changed(all, withoutCrosshair) > 0.001);
        key(Qt::Key_H);
        const QImage bare = grab("axialView");
        QVERIFY(changed(withoutCrosshair, bare) > 0.001);
        // Without annotations, the corners are black.
        QVERIFY(meanGrey(bare.copy(10, 10, 120, 40)) < 1.0);
        // A hidden measurement is not dragged by accident.
        const auto before = measured()[0].measurement;
        dragMouse(plane(), Qt::LeftButton, QPoint(300, 300), QPoint(30, 30));
        QVERIFY(measured()[0].measurement == before);
        key(Qt::Key_Z, Qt::ControlModifier); // the window that the drag set
        // Choosing a measuring tool shows annotations again.
        key(Qt::Key_M);
        QVERIFY(find<QAction>("annotationsAction")->isChecked());
        key(Qt::Key_W);
        key(Qt::Key_H, Qt::ShiftModifier);
        document().selectMeasurement(-1);
        QCOMPARE(changed(all, rested()), 0.0);
    }

    void theBannerNamesThePatientAndIsHidden() {
        auto *banner = find<QLabel>("studyHeading");
        QVERIFY(banner->isVisible());
        QVERIFY(banner->text().startsWith("Secret Name"));
        key(Qt::Key_B, Qt::ShiftModifier);
        QVERIFY(!banner->isVisible());
        restart();
        open(headPath());
        QVERIFY(!find<QLabel>("studyHeading")->isVisible());
    }

    void aTurnOfThePlanesIsUndone() {
        key(Qt::Key_C);
        const QPoint at = plane()->mapping().positionOf(document().crosshair()).toPoint();
        const int reach = int(0.36 * std::min(plane()->width(), plane()->height()));
        dragMouse(plane(), Qt::LeftButton, at + QPoint(reach, 0), QPoint(-20, -reach / 3));
        const mpr::PlaneAxes turned = document().cut().axes;
        QVERIFY(!turned.areStandard());
        key(Qt::Key_C, Qt::ShiftModifier);
        QVERIFY(document().cut().axes.areStandard());
        key(Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(document().cut().axes == turned);
        key(Qt::Key_Z, Qt::ControlModifier); // the whole drag at once
        QVERIFY(document().cut().axes.areStandard());
    }

    void aRightClickOpensTheMenuOfThePane() {
        key(Qt::Key_M);
        dragMouse(plane(), Qt::LeftButton, QPoint(300, 300), QPoint(100, 0));
        QMenu *menu = rightClick(plane(), QPoint(350, 300));
        QVERIFY(action(*menu, "Delete Distance 1"));
        QVERIFY(action(*menu, "Show all panes"));
        action(*menu, "Delete Distance 1")->trigger();
        QVERIFY(measured().empty());
        menu->close();
        menu = rightClick(plane(), QPoint(350, 300));
        QVERIFY(!action(*menu, "Delete Distance 1"));
        action(*menu, "Show all panes")->trigger();
        menu->close();
        settle();
        QVERIFY(find<QWidget>("coronalView")->isVisible());
        // A drag with the right button sets the brightness of the projection, and opens no menu.
        dragMouse(projection(), Qt::RightButton, QPoint(300, 300), QPoint(60, 40));
        QVERIFY(!projection()->findChild<QMenu *>("paneMenu"));
        menu = rightClick(projection(), QPoint(300, 300));
        QVERIFY(action(*menu, "C-arm angles..."));
        save("menu");
        menu->close();
    }

    void thePictureIsCopiedAndPrinted() {
        plane()->setFocus();
        QGuiApplication::clipboard()->clear();
        key(Qt::Key_C, Qt::ControlModifier);
        QTRY_VERIFY(!QGuiApplication::clipboard()->image().isNull());
        const QImage copied = QGuiApplication::clipboard()->image();
        QCOMPARE(copied.size(), plane()->size() * plane()->devicePixelRatioF());
        // As on the screen, but for crosshair, focus and the words of an exported picture.
        QVERIFY(changed(copied.convertToFormat(QImage::Format_RGB32), grab("axialView")) < 0.05);
        find<QAction>("printAction")->trigger();
        QTRY_VERIFY(mainWindow().findChild<QPrintDialog *>("printDialog"));
        find<QPrintDialog>("printDialog")->reject();

        const QString path = QString::fromStdString((m_folder / "page.pdf").string());
        {
            QPdfWriter pdf(path);
            QVERIFY(ui::print({copied, "Heading", "Footing"}, pdf));
        }
        QVERIFY(QFileInfo(path).size() > 10000);
        QPdfWriter nowhere(QString::fromStdString((m_folder / "gone" / "page.pdf").string()));
        QVERIFY(!ui::print({copied, "Heading", "Footing"}, nowhere));
    }

    void theHeaderIsShownSearchedAndCopied() {
        key(Qt::Key_D, Qt::ControlModifier);
        auto *tree = find<QTreeWidget>("headerTree");
        QTRY_VERIFY(tree->topLevelItemCount() > 20);
        // The file of the slice that is shown.
        const int slice =
            int(std::lround(document().volume()->lattice().voxel(document().crosshair()).v.z));
        QCOMPARE(find<QSpinBox>("headerFileBox")->value(), slice + 1);
        auto *search = find<QLineEdit>("headerSearch");
        const auto shown = [&] {
            QStringList names;
            for (int n = 0; n < tree->topLevelItemCount(); ++n)
                if (!tree->topLevelItem(n)->isHidden())
                    names << tree->topLevelItem(n)->text(1);
            return names;
        };
        search->setText("pixel spacing"); // each word for itself
        QCOMPARE(shown(), QStringList{"PixelSpacing"});
        search->setText("no such attribute");
        QCOMPARE(shown(), QStringList());
        QCOMPARE(find<QLabel>("headerMessage")->text(), QString("Nothing found"));
        search->setText("pixelspac");
        QCOMPARE(shown(), QStringList{"PixelSpacing"});
        search->setText("0010,0010");
        QCOMPARE(shown(), QStringList{"PatientName"});
        find<QPushButton>("copyHeaderButton")->click();
        QCOMPARE(QGuiApplication::clipboard()->text(),
                 QString("(0010,0010)\tPN\tPatientName\tSecret^Name\n"));
        save("header");
    }

    void theVolumesOfTheClassesAreMeasured() {
        emit plane()->maximizeRequested(plane());
        choosePreset("Bone over soft tissue");
        key(Qt::Key_V, Qt::ShiftModifier);
        auto *table = find<QTableWidget>("classVolumesTable");
        QTRY_COMPARE_WITH_TIMEOUT(table->rowCount(), 2, patienceMs);
        // Against a count of the samples.
        const volume::Volume &volume = *document().volume();
        const auto &bone = document().scene().look.classes[0];
        std::size_t count = 0;
        double sum = 0.0;
        volume.visit([&](auto samples) {
            for (const auto value : samples)
                if (bone.membership(double(value)) >= 0.5) {
                    ++count;
                    sum += double(value);
                }
        });
        const double ml = double(count) * volume.lattice().cellVolumeMm3() / 1000.0;
        if (bone.steps.empty()) {
            QVERIFY(std::abs(table->item(0, 1)->text().toDouble() - ml) < 1e-3 * ml);
            QVERIFY(std::abs(table->item(0, 2)->text().toDouble() - sum / double(count)) < 0.1);
        }
        find<QPushButton>("copyVolumesButton")->click();
        QCOMPARE(QGuiApplication::clipboard()->text().count('\n'), 3);
    }

private:
    ui::MprView *plane() { return find<ui::MprView>("axialView"); }
    // On a slow machine, the plane is a draft until nothing has moved for a moment.
    QImage rested() {
        QImage last = grab("axialView");
        (void)QTest::qWaitFor(
            [&] {
                QTest::qWait(300);
                const QImage before = std::exchange(last, grab("axialView"));
                return last == before;
            },
            patienceMs);
        return last;
    }
    const std::vector<ui::Measured> &measured() { return document().measured(); }
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
        QTest::keyClick(&mainWindow(), key, modifiers);
    }
    QLineEdit *field() { return find<QLineEdit>("annotationField"); }
    void type(const QString &text) {
        QTest::keyClicks(field(), text);
        QTest::keyClick(field(), Qt::Key_Return);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
    static QAction *action(const QMenu &menu, const QString &text) {
        for (QAction *candidate : menu.actions())
            if (candidate->text().remove('&') == text)
                return candidate;
        return nullptr;
    }
    QMenu *rightClick(QWidget *pane, const QPoint &at) {
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QTest::mouseClick(pane, Qt::RightButton, {}, at);
        auto *menu = pane->findChild<QMenu *>("paneMenu");
        if (menu == nullptr)
            qFatal("no menu");
        return menu;
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::AnnotationsTest>(argc, argv);
}

#include "annotations_test.moc"
