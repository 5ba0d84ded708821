// SPDX-License-Identifier: GPL-3.0-or-later
// Exports: pictures in every format, captures, turntables.
#include "tests/ui/file_dialog.h"
#include "tests/ui/workstation.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QStatusBar>
#include <QTimer>

#include "core/batch/recipe.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/files/video_file.h"
#include "tests/support/files.h"
#include "ui/views/mpr_view.h"

namespace pellucid {

using namespace test;
namespace fs = std::filesystem;

class ExportTest : public Workstation {
    Q_OBJECT
private slots:
    void init() {
        Workstation::init();
        open(headPath());
    }

    void picturesAreExportedInEveryFormat() {
        const QSize pane = projection()->size();
        const QImage plain = exported("Projection", 0, 1, false);
        QCOMPARE(plain.size(), pane);
        // In a large pane a small volume is shown with fewer pixels than it is exported with.
        const QImage shown =
            projection()->picture().scaled(pane, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
        QVERIFY(changed(plain, shown) < 0.02);
        QCOMPARE(plain.text("Comment"), QString("Not for diagnostic use"));
        const QImage annotated = exported("Projection", 0, 2, true);
        QCOMPARE(annotated.size(), 2 * pane);
        // The picture is computed, not magnified: scaled down it is the same, with letters.
        const QImage small =
            annotated.scaled(pane, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
        QVERIFY(changed(small, plain) > 0.002 && changed(small, plain) < 0.1);
        QVERIFY(colorfulness(annotated) > colorfulness(plain));
        const QImage grey = exported("Projection", 1, 1, true);
        QCOMPARE(grey.format(), QImage::Format_Grayscale16);
        const QImage axial = exported("Axial", 0, 4, true);
        QCOMPARE(axial.size(), 4 * find<QWidget>("axialView")->size());
        if (const QString folder = qEnvironmentVariable("PELLUCID_ARTIFACTS"); !folder.isEmpty()) {
            QVERIFY(annotated.save(folder + "/exported_projection.png"));
            QVERIFY(axial.save(folder + "/exported_axial.png"));
        }
        // The values of the file are those of the picture.
        exported("Projection", 3, 1, false);
        const volume::Volume values = decoding::readVolumeFile(m_folder / "out.nrrd");
        const picture::ProjectionImage image =
            projection()->frames().renderer()(projection()->sceneOfPicture().camera);
        QCOMPARE(values.lattice().size(), (volume::GridSize{image.width, image.height, 1}));
        QCOMPARE(float(values.value({100, 200, 0})),
                 image.samples[200 * std::size_t(image.width) + 100]);
    }

    // Texts that only an exported picture has get their own lines.
    void annotationsOfAPlaneAreAsInItsPane() {
        auto *const axial = find<ui::MprView>("axialView");
        projection()->setFocus(); // the frame of the focus is not exported
        const int line = axial->fontMetrics().height() + 3, width = axial->width();
        const QRect left(8, 8, width / 2 - 20, 2 * line),
            right(width / 2 + 12, 8, width / 2 - 20, 2 * line), below(left.translated(0, 2 * line)),
            belowRight(right.translated(0, 2 * line));
        const QImage shown = axial->grab().toImage(), picture = exported("Axial", 0, 1, true);
        QVERIFY(picture.size() == shown.size());
        const auto differ = [&](const QRect &part) {
            return changed(shown.copy(part), picture.copy(part)) > 0.0;
        };
        QVERIFY(!differ(left) && !differ(right));
        QVERIFY(differ(below) && differ(belowRight));
    }

    // What is exported of this study can be made of others on the command line.
    void anExportIsSavedAsARecipe() {
        find<QAction>("exportPictureAction")->trigger();
        auto *const save = find<QPushButton>("saveRecipeButton");
        find<QComboBox>("exportPaneBox")->setCurrentText("Coronal");
        QVERIFY(!save->isEnabled()); // recipes make projections
        find<QComboBox>("exportPaneBox")->setCurrentText("Projection");
        find<QComboBox>("exportFormatBox")->setCurrentIndex(7);
        find<QSpinBox>("exportFramesBox")->setValue(9);
        find<QComboBox>("exportScaleBox")->setCurrentIndex(1);
        QVERIFY(save->isEnabled());
        const fs::path path = m_folder / "made.json";
        answerFileDialog(this, QString::fromStdString(path.string()));
        QTest::mouseClick(save, Qt::LeftButton);
        QVERIFY(find<QLabel>("exportMessage")->text().contains("made.json"));
        const batch::Recipe recipe = batch::readRecipe(path);
        QCOMPARE(recipe.outputs.size(), std::size_t(1));
        const batch::Output &output = recipe.outputs.front();
        QVERIFY(output.format == batch::Format::captureLoop);
        QCOMPARE(output.views.size(), std::size_t(9));
        const scene::Scene made = batch::sceneOf(output, *document().volume());
        QVERIFY(made.look == document().scene().look);
        QVERIFY(made.shading == document().scene().shading);
        QCOMPARE(made.tolerance, document().scene().tolerance);
        QCOMPARE(made.camera.width, 2 * document().scene().camera.width);
        const glm::dquat &shown = document().scene().camera.orientation;
        QVERIFY(std::abs(glm::dot(made.camera.orientation, shown)) > 1.0 - 1e-9);
        find<QDialog>("exportDialog")->close();
    }

    void aFailedExportIsReported() {
        find<QAction>("exportPictureAction")->trigger();
        find<QComboBox>("exportPaneBox")->setCurrentText("Coronal");
        find<QComboBox>("exportFormatBox")->setCurrentIndex(2);
        QVERIFY(!find<QPushButton>("exportWriteButton")->isEnabled());
        QVERIFY(find<QLabel>("exportMessage")->text().contains("Only the projection"));
        find<QComboBox>("exportFormatBox")->setCurrentIndex(0);
        find<QLineEdit>("exportPathEdit")->setText("/nowhere/at/all/x.png");
        find<QPushButton>("exportWriteButton")->click();
        QTRY_VERIFY(find<QLabel>("exportMessage")->text().contains("cannot be written"));
        QVERIFY(find<QDialog>("exportDialog")->isVisible());
        QVERIFY(find<QPushButton>("exportWriteButton")->isEnabled());
    }

    void aCaptureBelongsToTheStudy() {
        exported("Projection", 4, 1, true);
        const QString file = QString::fromStdString((m_folder / "out.dcm").string());
        QProcess dump;
        dump.start("dcmdump", {"-q", file});
        QVERIFY(dump.waitForFinished() && dump.exitCode() == 0);
        const QString text = QString::fromUtf8(dump.readAll());
        const ui::StudyFacts study = mainWindow().document().sources().at(0).study;
        QVERIFY(text.contains("=SecondaryCaptureImageStorage"));
        QVERIFY(text.contains("[" + study.uid + "]"));
        QVERIFY(text.contains("[Secret^Name]"));
        QVERIFY(text.contains("[L\\F]"));
        QVERIFY(text.contains("(0028,0301) CS [YES]")); // the annotations name the patient
        // The capture of a grey projection is grey, despite colored letters: every program reads
        // it, this one too.
        QVERIFY(text.contains("MONOCHROME2"));
        const auto &sources = mainWindow().document().sources();
        QCOMPARE(sources.size(), std::size_t(2));
        QVERIFY(!sources[1].volume.placed);
        QCOMPARE(sources[1].study.uid, study.uid);
        // Another program reads the same picture.
        const QString png = file + ".png";
        QCOMPARE(QProcess::execute("dcm2pnm", {"+on", file, png}), 0);
        const QImage back(png), direct = exported("Projection", 0, 1, true);
        QCOMPARE(back.size(), direct.size());
        QVERIFY(changed(back, direct.convertToFormat(QImage::Format_Grayscale8)) < 0.001);
        // A plane without annotations is grey as well.
        exported("Axial", 4, 1, false);
        dump.start("dcmdump", {"-q", "+P", "0028,0004", file});
        QVERIFY(dump.waitForFinished() && dump.exitCode() == 0);
        QVERIFY(dump.readAll().contains("MONOCHROME2"));
        // Neither a picture without annotations nor one without a name identifies the patient.
        dump.start("dcmdump", {"-q", "+P", "0028,0301", file});
        QVERIFY(dump.waitForFinished() && dump.readAll().contains("[NO]"));
    }

    // One object, whose frames are those of the other turntables.
    void aTurntableIsWrittenAsOneDicomObject() {
        const QString file = QString::fromStdString((m_folder / "turn.dcm").string());
        dialogFor("Projection", 7, 1, false);
        find<QSpinBox>("exportFramesBox")->setValue(720);
        find<QComboBox>("exportScaleBox")->setCurrentIndex(3);
        QVERIFY(!find<QPushButton>("exportWriteButton")->isEnabled());
        QVERIFY(find<QLabel>("exportMessage")->text().contains("choose fewer frames"));
        find<QComboBox>("exportScaleBox")->setCurrentIndex(0);
        find<QSpinBox>("exportFramesBox")->setValue(4);
        QVERIFY(find<QPushButton>("exportWriteButton")->isEnabled());
        find<QLineEdit>("exportPathEdit")->setText(file);
        finish();
        QProcess dump;
        dump.start("dcmdump", {"-q", file});
        QVERIFY(dump.waitForFinished() && dump.exitCode() == 0);
        const QString text = QString::fromUtf8(dump.readAll());
        for (const char *there :
             {"=MultiframeGrayscaleByteSecondaryCaptureImageStorage", "(0028,0008) IS [4]",
              "(0018,1063) DS [40]", "(0028,0009) AT (0018,1063)", "[Secret^Name]", "[IDENTITY]"})
            QVERIFY2(text.contains(there), there);
        const auto &sources = mainWindow().document().sources();
        QCOMPARE(sources.size(), std::size_t(2));
        QCOMPARE(sources[1].study.uid, sources[0].study.uid);
        // Another program reads the same frames.
        dialogFor("Projection", 5, 1, false);
        find<QSpinBox>("exportFramesBox")->setValue(4);
        finish();
        for (int n = 0; n < 4; ++n) {
            const QString png = file + ".png";
            QCOMPARE(QProcess::execute("dcm2pnm", {"+on", "+F", QString::number(n + 1), file, png}),
                     0);
            QVERIFY(changed(QImage(png), frame(n).convertToFormat(QImage::Format_Grayscale8)) <
                    0.001);
            QFile::remove(framePath(n));
        }
    }

    // Another study has another patient.
    void aPictureNamesThePatientThatItShows() {
        dialogFor("Projection", 0, 1, true);
        auto *const patient = find<QComboBox>("exportPatientBox");
        QVERIFY(patient->currentText().startsWith("Secret Name"));
        patient->setEditText("Case 12");
        find<QAction>("chestPhantomAction")->trigger();
        QTRY_VERIFY(mainWindow().document().currentSource() == 1);
        settle();
        QVERIFY2(patient->currentText().isEmpty(), qPrintable(patient->currentText()));
        find<QDialog>("exportDialog")->close();
    }

    void aDeidentifiedCaptureHasNoPatientData() {
        const QString file = QString::fromStdString((m_folder / "nobody.dcm").string());
        dialogFor("Projection", 4, 1, true);
        find<QCheckBox>("exportDeidentifiedBox")->click();
        QVERIFY(find<QLabel>("exportMessage")->text().contains("does not identify"));
        find<QLineEdit>("exportPathEdit")->setText(file);
        finish();
        QProcess dump;
        dump.start("dcmdump", {"-q", file});
        QVERIFY(dump.waitForFinished() && dump.exitCode() == 0);
        const QString text = QString::fromUtf8(dump.readAll());
        const ui::StudyFacts study = mainWindow().document().sources().at(0).study;
        for (const QString &of : {study.patientName, study.patientId, study.uid, study.date})
            QVERIFY2(of.isEmpty() || !text.contains("[" + of + "]"), qPrintable(of));
        // PS3.15, E.1 and table E.1-1.
        for (const char *there : {"(0012,0062) CS [YES]", "[113100]", "(0028,0303) CS [REMOVED]"})
            QVERIFY2(text.contains(there), there);
        for (const char *gone : {"(0008,1030)", "(0008,103e)", "(0008,2111)", "(0020,4000)"})
            QVERIFY2(!text.contains(gone), gone);
        QCOMPARE(mainWindow().document().sources().size(), std::size_t(1));
    }

    void anExistingFileIsReplacedOnlyAfterAQuestion() {
        const QImage first = exported("Projection", 0, 1, false);
        dialogFor("Projection", 0, 2, false);
        find<QPushButton>("exportWriteButton")->click();
        answer(QMessageBox::RejectRole);
        QVERIFY(find<QDialog>("exportDialog")->isVisible());
        const QString path = find<QLineEdit>("exportPathEdit")->text();
        QCOMPARE(QImage(path).size(), first.size());
        find<QPushButton>("exportWriteButton")->click();
        answer(QMessageBox::AcceptRole);
        waitForEnd();
        QCOMPARE(QImage(path).size(), 2 * first.size());
        QVERIFY(mainWindow().statusBar()->currentMessage().contains("out.png"));
    }

    void noExportOverwritesAFileOfAnOpenStudy() {
        const fs::path series = m_folder / "kept";
        fs::copy(headPath().toStdString(), series);
        open(QString::fromStdString(series.string()));
        const fs::path slice = series / "IM0003.dcm", link = m_folder / "other name.dcm";
        fs::create_hard_link(slice, link);
        const std::string before = readText(slice);
        for (const fs::path &path : {slice, link}) {
            dialogFor("Projection", 4, 1, false);
            find<QLineEdit>("exportPathEdit")->setText(QString::fromStdString(path.string()));
            find<QPushButton>("exportWriteButton")->click();
            answer(QMessageBox::AcceptRole);
            QCOMPARE(find<QLabel>("exportMessage")->text(),
                     QString("IM0003.dcm belongs to an open study; choose another name"));
            QVERIFY(readText(slice) == before);
            find<QDialog>("exportDialog")->close();
            QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        }
        fs::remove(link);
    }

    void aTurntableIsWrittenAsFramesAndACancelLeavesNothing() {
        dialogFor("Projection", 5, 1, false);
        find<QSpinBox>("exportFramesBox")->setValue(4);
        finish();
        for (int n = 0; n < 4; ++n)
            QVERIFY(!frame(n).isNull());
        QVERIFY(frame(4).isNull());
        QVERIFY(changed(frame(0), exported("Projection", 0, 1, false)) == 0.0);
        QVERIFY(changed(frame(0), frame(1)) > 0.05);
        // Half a turn gives the mirrored view: rays pass through the same samples either way.
        QVERIFY(changed(frame(2), frame(0).mirrored(true, false)) < 0.02);
        // A longer turntable of the same name is cancelled: the former frames stay.
        const QImage before = frame(0);
        dialogFor("Projection", 5, 4, true);
        find<QSpinBox>("exportFramesBox")->setValue(200);
        find<QPushButton>("exportWriteButton")->click();
        answer(QMessageBox::AcceptRole);
        const QDir folder(QString::fromStdString(m_folder.path().string()));
        const auto unfinished = [&] {
            return folder.entryList({".*"}, QDir::Hidden | QDir::Dirs | QDir::NoDotAndDotDot);
        };
        QTRY_VERIFY(!unfinished().isEmpty());
        QTest::mouseClick(find<QPushButton>("exportCancel"), Qt::LeftButton);
        QVERIFY(find<QDialog>("exportDialog")->isVisible());
        QTRY_VERIFY_WITH_TIMEOUT(unfinished().isEmpty(), patienceMs);
        QVERIFY(frame(0) == before);
        QVERIFY(frame(4).isNull());
        QVERIFY(find<QPushButton>("exportWriteButton")->isEnabled());
        find<QDialog>("exportDialog")->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    void aVideoNeedsFfmpeg() {
        const auto restored = qScopeGuard([before = qgetenv("PATH")] { qputenv("PATH", before); });
        qputenv("PATH", QByteArray::fromStdString((m_folder / "no programs").string()));
        dialogFor("Projection", 6, 1, true);
        QVERIFY(!find<QPushButton>("exportWriteButton")->isEnabled());
        QVERIFY(find<QLabel>("exportMessage")->text().contains("ffmpeg"));
        find<QDialog>("exportDialog")->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    void aVideoIsWrittenWithFfmpeg() {
        QVERIFY2(files::VideoFile::isAvailable(), "ffmpeg is missing: ./dev deps installs it");
        dialogFor("Projection", 6, 1, true);
        const QString path = find<QLineEdit>("exportPathEdit")->text();
        find<QSpinBox>("exportFramesBox")->setValue(10);
        finish();
        QVERIFY(QFileInfo(path).size() > 2000);
        QProcess probe;
        probe.start("ffprobe", {"-v", "error", "-count_frames", "-show_entries",
                                "stream=nb_read_frames,codec_name", path});
        QVERIFY(probe.waitForFinished() && probe.exitCode() == 0);
        const QByteArray report = probe.readAll();
        QVERIFY(report.contains("h264") && report.contains("nb_read_frames=10"));
        QVERIFY(QDir(QString::fromStdString(m_folder.path().string()))
                    .entryList(QDir::Hidden | QDir::Files | QDir::Dirs | QDir::NoDotAndDotDot)
                    .filter(QRegularExpression("^\\."))
                    .isEmpty());
    }

private:
    QString framePath(int n) {
        return QString::fromStdString(
            (m_folder / ("out_000" + std::to_string(n) + ".png")).string());
    }
    QImage frame(int n) { return QImage(framePath(n)); }

    void dialogFor(const QString &pane, int format, int times, bool isAnnotated) {
        find<QAction>("exportPictureAction")->trigger();
        find<QComboBox>("exportPaneBox")->setCurrentText(pane);
        find<QComboBox>("exportScaleBox")->setCurrentIndex(times - 1);
        find<QCheckBox>("exportAnnotatedBox")->setChecked(isAnnotated);
        auto *path = find<QLineEdit>("exportPathEdit");
        path->setText(QString::fromStdString((m_folder / "out.png").string()));
        find<QComboBox>("exportFormatBox")->setCurrentIndex(format);
    }
    // Answers the question whether to replace a file.
    void answer(QMessageBox::ButtonRole role) {
        const auto *const question = find<QMessageBox>("replaceQuestion");
        for (QAbstractButton *button : question->buttons())
            if (question->buttonRole(button) == role)
                QTest::mouseClick(button, Qt::LeftButton);
    }
    // Exports and waits until the dialog is closed.
    void finish() {
        find<QPushButton>("exportWriteButton")->click();
        waitForEnd();
    }
    void waitForEnd() {
        QTRY_VERIFY_WITH_TIMEOUT(mainWindow().findChild<QDialog *>("exportDialog") == nullptr,
                                 patienceMs);
    }
    QImage exported(const QString &pane, int format, int times, bool isAnnotated) {
        dialogFor(pane, format, times, isAnnotated);
        const QString written = find<QLineEdit>("exportPathEdit")->text();
        QFile::remove(written);
        finish();
        return QImage(written);
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::ExportTest>(argc, argv);
}

#include "export_test.moc"
