// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentations in the window: opened, listed, searched, shown and hidden together, kept.
#include "tests/ui/file_dialog.h"
#include "tests/ui/workstation.h"

#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QTimer>
#include <QToolButton>

#include <fmt/format.h>

#include "core/decoding/client/reasons.h"
#include "core/segment/reasons.h"
#include "core/segment/write_segmentation.h"
#include "core/volume/nrrd.h"
#include "ui/panels/class_group.h"
#include "ui/panels/class_row.h"

namespace pellucid {

using namespace test;

class SegmentsTest : public Workstation {
    Q_OBJECT
private slots:
    void segmentsAreClassesThatAreFoundAndHiddenTogether() {
        open(headPath());
        const QImage before = projection()->picture();
        open(writeBlocks("blocks.dcm", 20));
        const auto &classes = document().scene().look.classes;
        QCOMPARE(classes.size(), std::size_t(20));
        QCOMPARE(QString::fromStdString(classes[3].segment), QString("block 3"));
        QVERIFY(changed(before, projection()->picture()) > 0.02);
        QVERIFY(document().problems().empty());
        auto *const group = find<ui::ClassGroup>("classGroup");
        const auto text = [&] { return group->findChild<QLabel *>("classGroupName")->text(); };
        QCOMPARE(text(), QString("Blocks of the head: 20 of 20"));
        QCOMPARE(visibleRows(), 20);
        save("segments");
        // The planes tint them, unless the user wants them plain.
        const QImage tinted = grab("axialView");
        QVERIFY(colorfulShare(tinted) > 0.1);
        find<QAction>("tintSegmentsAction")->trigger();
        QTRY_VERIFY(colorfulShare(grab("axialView")) < 0.05); // the crosshair and letters
        find<QAction>("tintSegmentsAction")->trigger();
        QTRY_VERIFY(changed(tinted, grab("axialView")) < 0.001);

        // The search finds names and terms; the eye of the group hides what is listed.
        auto *const search = find<QLineEdit>("classSearch");
        QVERIFY(search->isVisible());
        search->setText("block 1");
        QCOMPARE(visibleRows(), 11); // 1 and 10 to 19
        QTest::mouseClick(group->findChild<QToolButton *>("classGroupEye"), Qt::LeftButton);
        settle();
        QCOMPARE(shownCount(), 9);
        QCOMPARE(text(), QString("Blocks of the head: 0 of 11"));
        search->clear();
        QCOMPARE(text(), QString("Blocks of the head: 9 of 20"));
        const QImage nine = projection()->picture();
        document().undoStack()->undo();
        settle();
        QCOMPARE(shownCount(), 20);
        QVERIFY(changed(nine, projection()->picture()) > 0.01);
        search->setText("lung"); // the term of every third segment's code
        QCOMPARE(visibleRows(), 7);
        search->clear();

        // A folded group stays folded while a weight changes.
        QTest::mouseClick(group->findChild<QToolButton *>("classGroupFold"), Qt::LeftButton);
        QCOMPARE(visibleRows(), 0);
        document().undoStack()->undo(); // the classes go, the segments stay
        settle();
        QVERIFY(document().scene().look.classes.empty());
        QVERIFY(document().segments());
        document().undoStack()->redo();
        settle();
        QCOMPARE(shownCount(), 20);
    }

    // The picture follows the slider of one of many segments, without a spectrum for each of them.
    void theWeightOfOneOfManyFollowsTheHand() {
        open(headPath());
        open(writeBlocks("many.dcm", 48));
        QCOMPARE(document().scene().look.classes.size(), std::size_t(48));
        const std::size_t full = bench().study.preparer.fullEngine()->bytes;
        const QImage before = projection()->picture();
        std::size_t layers = 0;
        QObject listener; // ends the connection
        connect(&bench().study.preparer, &ui::LookPreparer::engineReady, &listener,
                [&](const prepare::PreparedEngine &engine, ui::EngineStage stage) {
                    if (stage == ui::EngineStage::live)
                        layers = std::max(layers, engine.bytes);
                });
        const ui::DragId drag = ui::nextDragId();
        const auto setWeight = [&](double weight) {
            ui::editScene(document(), "Weight", drag,
                          [&](scene::Scene &scene) { scene.look.classes[24].weight = weight; });
        };
        setWeight(1.4);
        QTRY_VERIFY_WITH_TIMEOUT(layers > 0, patienceMs);
        // The held class and the three channels of the rest, of one plan for all.
        QVERIFY2(layers <= 3 * full, qPrintable(QString("%1, %2").arg(layers).arg(full)));
        setWeight(0.0);
        settle();
        QVERIFY(changed(before, projection()->picture()) > 0.005);
        QCOMPARE(document().undoStack()->undoText(), QString("Weight"));
        document().undoStack()->undo();
        settle();
        QVERIFY(changed(before, projection()->picture()) < 0.01);
    }

    void aSegmentationOfAnotherStudyIsAProblemWithItsReason() {
        open(headPath());
        const QString other = writeBlocks("other.dcm", 2, "1.2.3.4");
        open(other);
        QVERIFY(document().scene().look.classes.empty());
        QVERIFY(!document().segments());
        QCOMPARE(document().problems().size(), std::size_t(1));
        QCOMPARE(document().problems().front().reason,
                 task::Reason(task::because::belongsToAnotherStudy));
    }

    // Labels beside the volume's samples are shown, and the list of problems says how far they are.
    void segmentsBesideTheSamplesAreAProblemThatSaysHowFar() {
        open(headPath());
        const volume::Lattice lattice = document().volume()->lattice();
        const auto moved =
            volume::Lattice::make(lattice.size(), {lattice.origin().mm + 0.25 * lattice.step(0)},
                                  {lattice.step(0), lattice.step(1), lattice.step(2)});
        const auto path = m_folder / "labels.nrrd";
        volume::writeNrrd(path, volume::Volume(moved,
                                               std::vector<std::int16_t>(lattice.size().count(), 1),
                                               volume::ValueUnit::none));
        bench().study.segments.open({QString::fromStdString(path.string())});
        settle();
        QCOMPARE(document().scene().look.classes.size(), std::size_t(1));
        QCOMPARE(document().problems().size(), std::size_t(1));
        QCOMPARE(document().problems().front().reason,
                 task::because::segmentsBetweenSamples(
                     fmt::format("{:.3g}", 0.25 * lattice.spacingMm(0))));
    }

    void withoutImagesASegmentationIsAProblem() {
        open(headPath());
        const QString blocks = writeBlocks("alone.dcm", 2);
        restart();
        drop(mainWindow(), {QUrl::fromLocalFile(blocks)});
        QTRY_COMPARE(document().problems().size(), std::size_t(1));
        QCOMPARE(document().problems().front().reason,
                 task::Reason(task::because::isASegmentation));
        QVERIFY(!find<QAction>("openSegmentationAction")->isEnabled());
    }

    // A segmentation beside the images is offered by the panel; the classes come back with the
    // session.
    void theStudysOwnSegmentationIsOfferedAndResumed() {
        open(headPath());
        const QString blocks = writeBlocks("head/blocks.dcm", 3);
        restart();
        open(headPath());
        QVERIFY(document().problems().empty());
        QTimer::singleShot(0, this, [] {
            auto *const menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
            QVERIFY(menu != nullptr);
            for (QAction *action : menu->actions())
                if (action->text() == "Segments of Blocks of the head")
                    action->trigger();
            menu->close();
        });
        find<QPushButton>("addClassButton")->click();
        settle();
        QCOMPARE(document().scene().look.classes.size(), std::size_t(3));
        const QImage shown = projection()->picture();
        restart();
        QTRY_VERIFY(find<QPushButton>("resumeButton")->isVisible());
        find<QPushButton>("resumeButton")->click();
        waitForVolume();
        settle();
        QCOMPARE(document().scene().look.classes.size(), std::size_t(3));
        QVERIFY(changed(shown, projection()->picture()) < 0.01);
        // Without the file, the rest of the session comes back.
        restart();
        std::filesystem::remove(blocks.toStdString());
        QTRY_VERIFY(find<QPushButton>("resumeButton")->isVisible());
        find<QPushButton>("resumeButton")->click();
        waitForVolume();
        settle();
        QVERIFY(document().scene().look.classes.empty());
        // One for the file and one for the classes that go with it.
        QCOMPARE(document().problems().size(), std::size_t(2));
    }

    void classesOfOnesOwnAreSavedAndOpenedAgain() {
        open(headPath());
        choosePreset("Bone over soft tissue");
        const std::size_t classes = document().scene().look.classes.size();
        for (const char *name : {"own.dcm", "own.nrrd"}) {
            const QString path = QString::fromStdString((m_folder / name).string());
            answerFileDialog(this, path);
            find<QAction>("saveSegmentsAction")->trigger();
            QTRY_VERIFY_WITH_TIMEOUT(!bench().exports.isRunning(), patienceMs);
            for (const dicom::Skipped &problem : document().problems())
                QFAIL(problem.reason.english().c_str());
            QVERIFY(QFileInfo::exists(path));
            bench().study.segments.open({path});
            settle();
            QCOMPARE(document().segments()->segmentations().back().segments.size(), classes);
            // Its classes would be saved with the others.
            document().undoStack()->undo();
            settle();
        }
        const auto &saved = document().segments()->segmentations();
        QCOMPARE(saved.size(), std::size_t(2));
        for (std::size_t n = 0; n < classes; ++n)
            QVERIFY(*saved[0].segments[n].coverage == *saved[1].segments[n].coverage);
        QCOMPARE(QString::fromStdString(saved[0].segments[0].name), QString("Bone"));
    }

private:
    // Blocks of the head, as a segmentation of its study or of another one.
    QString writeBlocks(const std::string &name, int count, const std::string &study = "") {
        const volume::Volume &volume = *document().volume();
        const volume::GridSize size = volume.lattice().size();
        std::vector<segment::Segment> segments;
        for (int n = 0; n < count; ++n) {
            volume::Coverage block;
            const int low = size.i * n / count, high = size.i * (n + 1) / count;
            block.box = {{low, 10, 10}, {high, size.j - 10, size.k - 10}};
            block.shares.assign(block.box.size().count(), volume::Coverage::whole);
            segment::Segment segment;
            segment.name = "block " + std::to_string(n);
            segment.color = glm::dvec3(n % 2, 0.5, 1.0 - n / double(count));
            if (n % 3 == 0)
                segment.type = {"39607008", "SCT", "Lung"};
            segment.coverage = std::make_shared<const volume::Coverage>(std::move(block));
            segments.push_back(segment);
        }
        segment::SegmentationLabels labels;
        labels.seriesDescription = "Blocks of the head";
        labels.study.patientName = "Secret^Name";
        labels.study.studyUid = study.empty() ? volume.notes().studyUid : study;
        labels.frameOfReferenceUid = volume.notes().frameOfReferenceUid;
        const std::filesystem::path path = m_folder / name;
        segment::writeSegmentation(path, segments, volume.lattice(), labels);
        return QString::fromStdString(path.string());
    }

    static double colorfulShare(const QImage &image) {
        int count = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                count += image.pixelColor(x, y).saturation() > 40;
        return double(count) / (image.width() * image.height());
    }
    int visibleRows() {
        int count = 0;
        for (const auto *const row : mainWindow().findChildren<ui::ClassRow *>())
            count += !row->isHidden();
        return count;
    }
    int shownCount() const {
        int count = 0;
        for (const auto &tissue : document().scene().look.classes)
            count += tissue.weight > 0.0;
        return count;
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::SegmentsTest>(argc, argv);
}

#include "segments_test.moc"
