// SPDX-License-Identifier: GPL-3.0-or-later
// Differences of two volumes in the window: chosen, listed, aligned, shown beside and reopened.
#include "tests/ui/studies_window.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>

#include "ui/beside/study_beside.h"

namespace pellucid {

using namespace test;

namespace {

constexpr int contrast = 300;

volume::Volume head() {
    return phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{96, 96, 80}}));
}

// The head after contrast has come into one block of it, on another lattice of the same size.
volume::Volume withContrast(const volume::Volume &before, const volume::Lattice &lattice) {
    return before.visit([&](auto samples) {
        std::vector<std::int16_t> values(samples.begin(), samples.end());
        for (int k = 30; k < 50; ++k)
            for (int j = 40; j < 56; ++j)
                for (int i = 40; i < 56; ++i)
                    values[before.lattice().size().offsetOf(i, j, k)] += contrast;
        return volume::Volume(lattice, std::move(values), before.unit(), before.notes());
    });
}

volume::Lattice shifted(const volume::Lattice &lattice, glm::dvec3 mm) {
    return volume::Lattice::make(lattice.size(), {lattice.origin().mm + mm},
                                 {lattice.step(0), lattice.step(1), lattice.step(2)});
}

} // namespace

class DifferenceTest : public StudiesWindow {
    Q_OBJECT
private slots:
    void initTestCase() {
        StudiesWindow::initTestCase();
        const volume::Volume before = head();
        write("native", before, 1);
        write("contrast", withContrast(before, before.lattice()), 2);
        write("moved", withContrast(before, shifted(before.lattice(), {6.0, -4.0, 0.0})), 3);
    }

    void theContrastAloneIsShownAndReopened() {
        open(path("native"));
        const QImage whole = projection()->picture();
        open(path("contrast"));
        subtract("1: native", false);
        const volume::Volume &volume = *document().volume();
        QVERIFY(volume.notes().isDifference);
        QCOMPARE(volume.value({45, 50, 40}), float(contrast));
        QCOMPARE(volume.value({20, 50, 40}), 0.0F);
        QVERIFY(!find<QAction>("subtractAction")->isEnabled());
        // The block covers a small part of what the head does.
        QVERIFY(changed(whole, projection()->picture()) > 0.05);
        QCOMPARE(listed("2: contrast minus 1: native"), 1);
        save("difference");
        QVERIFY(document().problems().empty());

        const QImage shown = projection()->picture();
        restart();
        QTRY_VERIFY(find<QPushButton>("resumeButton")->isVisible());
        find<QPushButton>("resumeButton")->click();
        waitForVolume();
        settle();
        QVERIFY(document().volume()->notes().isDifference);
        QCOMPARE(document().volume()->value({45, 50, 40}), float(contrast));
        QVERIFY(changed(shown, projection()->picture()) < 0.01);
        QVERIFY(document().problems().empty());
    }

    void aPatientWhoMovedIsAlignedAndTheResidualIsSaid() {
        open(path("native"));
        open(path("moved"));
        subtract("1: native", true);
        const QString &name =
            document().sources()[std::size_t(document().currentSource())].volume.description;
        QVERIFY2(name.startsWith("moved minus 1: native; aligned: turned by 0."), qPrintable(name));
        QCOMPARE(listed("3: " + name), 1);
        const volume::Volume &volume = *document().volume();
        QVERIFY(std::abs(volume.value({45, 50, 40}) - contrast) < 0.1F * contrast);
        // The native head stays what it is, beside the difference.
        auto *const beside = mainWindow().findChild<ui::StudyBeside *>("studyBeside");
        QVERIFY(beside != nullptr);
        QTRY_VERIFY_WITH_TIMEOUT(beside->document().volume() && !beside->document().isPreview() &&
                                     !beside->jobs().isRunning(),
                                 patienceMs);
        QVERIFY(!beside->document().volume()->notes().isDifference);
        QVERIFY(find<QLabel>("besideName")->text().contains("3: moved"));
        save("difference_beside");
    }

    void theAlignedVolumeIsShownBesideToCheckIt() {
        open(path("native"));
        const volume::Volume before = *document().volume();
        open(path("moved"));
        find<QAction>("subtractAction")->trigger();
        auto *const beside = find<QComboBox>("besideBox");
        QCOMPARE(beside->count(), 2); // nothing to check unless it is aligned
        find<QCheckBox>("alignBox")->setChecked(true);
        QCOMPARE(beside->count(), 3);
        beside->setCurrentIndex(2);
        find<QPushButton>("subtractNowButton")->click();
        waitForVolume();
        settle();
        const QString &name =
            document().sources()[std::size_t(document().currentSource())].volume.description;
        QVERIFY2(name.startsWith("moved minus 1: native; aligned"), qPrintable(name));
        auto *const shown = mainWindow().findChild<ui::StudyBeside *>("studyBeside");
        QTRY_VERIFY_WITH_TIMEOUT(shown->document().volume() && !shown->document().isPreview() &&
                                     !shown->jobs().isRunning(),
                                 patienceMs);
        // It is the native head on the lattice of the moved one, with its unit.
        const volume::Volume &aligned = *shown->document().volume();
        QVERIFY(aligned.lattice() == document().volume()->lattice());
        QVERIFY(aligned.unit() == volume::ValueUnit::hounsfield);
        QVERIFY(!aligned.notes().isDifference);
        double sum = 0.0, size = 0.0;
        for (int k = 20; k < 60; ++k)
            for (int j = 20; j < 76; ++j)
                for (int i = 20; i < 76; ++i) {
                    sum += std::abs(aligned.value({i, j, k}) - before.value({i, j, k}));
                    size += std::abs(before.value({i, j, k}));
                }
        QVERIFY2(sum < 0.05 * size, qPrintable(QString::number(sum / size)));
        save("difference_check");
    }

    void aVolumeElsewhereCannotBeSubtracted() {
        const volume::Volume before = head();
        write("elsewhere", withContrast(before, shifted(before.lattice(), {5000.0, 0.0, 0.0})), 4);
        open(path("native"));
        open(path("elsewhere"));
        choose("1: native", false);
        QTRY_VERIFY_WITH_TIMEOUT(!document().problems().empty(), patienceMs);
        QVERIFY(problems().contains("do not overlap"));
        // The former study comes back, and the list does not offer what cannot be made.
        waitForVolume();
        settle();
        QVERIFY(!document().volume()->notes().isDifference);
        QCOMPARE(listed("4: elsewhere minus 1: native"), 0);
        QCOMPARE(listed("4: elsewhere"), 1);
    }

    void nothingOfThePatientIsThereToSubtract() {
        open(path("native"));
        find<QAction>("subtractAction")->trigger();
        QVERIFY(find<QDialog>("subtractionDialog")->isVisible());
        QVERIFY(find<QLabel>("noSubtrahend")->isVisible());
        QVERIFY(!find<QPushButton>("subtractNowButton")->isEnabled());
        find<QDialog>("subtractionDialog")->reject();
    }

private:
    QString path(const char *name) const {
        return QString::fromStdString((m_folder / name).string());
    }

    void write(const char *name, const volume::Volume &volume, int number) const {
        dicom::writeCtSeries(m_folder / name, volume,
                             {.patientName = "Zhang^Wei",
                              .patientId = "7",
                              .seriesDescription = name,
                              .seriesNumber = number},
                             dicom::TransferSyntax::explicitLittle);
    }

    // Chooses the volume in the dialog; aligned ones with the open volume beside.
    void choose(const QString &name, bool isAligned) {
        find<QAction>("subtractAction")->trigger();
        auto *const list = find<QListWidget>("subtrahendList");
        const auto found = list->findItems(name, Qt::MatchStartsWith);
        QCOMPARE(found.size(), 1);
        list->setCurrentItem(found.front());
        find<QCheckBox>("alignBox")->setChecked(isAligned);
        find<QComboBox>("besideBox")->setCurrentIndex(isAligned ? 1 : 0);
        find<QPushButton>("subtractNowButton")->click();
    }
    void subtract(const QString &name, bool isAligned) {
        choose(name, isAligned);
        waitForVolume();
        settle();
    }

    // The number of listed volumes whose text begins so.
    int listed(const QString &text) {
        int count = 0;
        for (int row = 0; row < list().rowCount(); ++row) {
            const QModelIndex study = list().index(row, 0);
            tree()->expand(study);
            for (int n = 0; n < list().rowCount(study); ++n)
                if (ui::seriesText(*list().volume(list().index(n, 0, study))).startsWith(text))
                    ++count;
        }
        return count;
    }
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::DifferenceTest>(argc, argv);
}

#include "difference_test.moc"
