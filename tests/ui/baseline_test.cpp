// SPDX-License-Identifier: GPL-3.0-or-later
// The looks that somebody has looked at: the window in both themes and both languages, at the
// density of QT_SCALE_FACTOR, and every panel and dialog. With PELLUCID_ACCEPT_BASELINES the
// pictures are written in place of being compared (`./dev accept-pictures`), those of the panels
// into the manual.
#include "tests/ui/workstation.h"

#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPainter>
#include <QTreeView>

#include "ui/views/mpr_view.h"
#include "ui/views/spectrum_sampler.h"
#include "ui/window/file_menu.h"
#include "ui/window/workstation.h"

namespace pellucid {

using namespace test;

class BaselineTest : public test::Workstation {
    Q_OBJECT
private slots:
    void initTestCase() {
        Workstation::initTestCase();
        const auto lattice =
            phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{96, 96, 80}});
        dicom::writeCtSeries(m_folder / "shown", phantom::makePhantom(phantom::Kind::head, lattice),
                             {.patientName = "Doe^Jane",
                              .patientId = "PHANTOM",
                              .studyDescription = "Head",
                              .seriesDescription = "3 mm"},
                             dicom::TransferSyntax::explicitLittle);
    }
    void init() {
        QSettings().clear();
        std::filesystem::remove_all(m_folder / "data");
    }
    void cleanup() { m_program.reset(); }

    void theWindow_data() {
        QTest::addColumn<QString>("theme");
        QTest::addColumn<QString>("language");
        for (const char *theme : {"dark", "light"})
            for (const char *language : {"en", "zh_TW"})
                QTest::newRow(qPrintable(QString("%1 %2").arg(theme, language)))
                    << theme << language;
    }
    void theWindow() {
        QFETCH(QString, theme);
        QFETCH(QString, language);
        begin(theme, language);
        openHead();
        compare(window().grab().toImage(), "window_" + theme + "_" + language,
                changingParts(&window()));
    }

    void theStartPage() {
        begin("dark", "en");
        compare(window().grab().toImage(), "start_page", changingParts(&window()));
    }

    // Each is a picture of the manual.
    void thePanels() {
        if (density() != "1x")
            QSKIP("the manual's pictures have one density");
        begin("dark", "en");
        openHead();
        for (const char *dock :
             {"studyDock", "measurementsDock", "historyDock", "presetsDock", "classesDock",
              "transferFunctionDock", "shadingDock", "qualityDock"}) {
            auto *panel = window().findChild<QDockWidget *>(dock);
            QVERIFY2(panel != nullptr, dock);
            panel->show();
            rest();
            QCoreApplication::processEvents();
            compare(panel->grab().toImage(), "panel_" + QString(dock).remove("Dock"),
                    changingParts(panel));
        }
        window().findChild<QDockWidget *>("historyDock")->hide();
        for (const char *pane : {"axialView", "projectionView"})
            compare(of<QWidget>(pane)->grab().toImage(), "panel_" + QString(pane).remove("View"),
                    changingParts(of<QWidget>(pane)));
        of<QAction>("exportPictureAction")->trigger();
        of<QLineEdit>("exportPathEdit")->setText("/home/jane/projection.png");
        dialog("exportDialog", "panel_export");
        window().fileMenu().importPaths({"/media/cdrom"});
        dialog("importDialog", "panel_import");
        of<QAction>("preferencesAction")->trigger();
        dialog("preferencesDialog", "panel_preferences");
        of<QAction>("aboutAction")->trigger();
        dialog("aboutDialog", "panel_about");
        of<QAction>("spectrumAction")->trigger();
        const auto *sampler = window().findChild<ui::SpectrumSampler *>();
        QTRY_VERIFY_WITH_TIMEOUT(!sampler->isBehind(), patienceMs);
        compare(of<QDockWidget>("spectrumDock")->grab().toImage(), "panel_spectrum", {});
    }

private:
    void begin(const QString &theme, const QString &language) {
        QSettings().setValue("theme", theme);
        QSettings().setValue("language", language);
        m_program.reset();
        m_program = std::make_unique<ui::Workstation>();
        window().resize(1280, 800);
        QVERIFY(QTest::qWaitForWindowExposed(&window()));
        window().activateWindow();
    }

    // With a look, a measurement, and everything that is made aside.
    void openHead() {
        drop(window(),
             {QUrl::fromLocalFile(QString::fromStdString((m_folder / "shown").string()))});
        rest();
        QTest::keyClick(&window(), Qt::Key_M);
        auto *axial = of<ui::MprView>("axialView");
        dragMouse(axial, Qt::LeftButton, {axial->width() / 3, axial->height() / 2},
                  {axial->width() / 4, -axial->height() / 8});
        QTest::keyClick(&window(), Qt::Key_W);
        auto *gallery = of<QListWidget>("presetGallery");
        QListWidgetItem *wanted = nullptr;
        for (int n = 0; n < gallery->count(); ++n)
            if (gallery->item(n)->data(Qt::UserRole) == "Bone over soft tissue")
                wanted = gallery->item(n);
        QVERIFY(wanted != nullptr);
        gallery->scrollToItem(wanted);
        QTest::mouseClick(gallery->viewport(), Qt::LeftButton, {},
                          gallery->visualItemRect(wanted).center());
        gallery->scrollToTop();
        rest();
        const auto isBlack = [&](int n) {
            return meanGrey(gallery->item(n)->icon().pixmap(40, 40).toImage()) == 0.0;
        };
        QTRY_VERIFY_WITH_TIMEOUT(!isBlack(0) && !isBlack(gallery->count() - 1), patienceMs);
        auto *tree = of<QTreeView>("seriesTree");
        const QModelIndex row = tree->model()->index(0, 0, tree->model()->index(0, 0));
        QTRY_VERIFY(!row.data(Qt::DecorationRole).value<QImage>().isNull());
        projectionOf()->setFocus();
        rest();
        QCoreApplication::processEvents();
    }

    ui::MainWindow &window() { return m_program->window(); }
    ui::ProjectionView *projectionOf() { return of<ui::ProjectionView>("projectionView"); }
    template <class T> T *of(const char *name) {
        T *found = window().findChild<T *>(name);
        if (found == nullptr)
            qFatal("no %s", name);
        return found;
    }
    void rest() {
        QTRY_VERIFY_WITH_TIMEOUT(projectionOf()->showsFinalImage() &&
                                     !m_program->bench().study.jobs.isRunning(),
                                 patienceMs);
    }
    QString density() const {
        return QString("%1x").arg(m_program
                                      ? m_program->window().devicePixelRatioF()
                                      : qEnvironmentVariable("QT_SCALE_FACTOR", "1").toDouble());
    }

    void dialog(const char *name, const QString &picture) {
        auto *shown = of<QDialog>(name);
        QVERIFY(QTest::qWaitForWindowExposed(shown));
        compare(shown->grab().toImage(), picture, changingParts(shown));
        shown->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    // Times, instruction sets, versions and folders are another each time.
    QList<QRect> changingParts(QWidget *in) const {
        QList<QRect> parts;
        const auto add = [&](const QWidget *part, QRect rect) {
            if (part->isVisibleTo(in))
                parts << QRect(part->mapTo(in, rect.topLeft()), rect.size());
        };
        for (const char *name : {"frameTimeLabel", "engineLabel", "aboutLibraries", "jobStrip"})
            for (const QWidget *part : in->findChildren<QWidget *>(name))
                add(part, part->rect());
        QList<const QWidget *> projections;
        for (const QWidget *part : in->findChildren<QWidget *>("projectionView"))
            projections << part;
        if (in->objectName() == "projectionView")
            projections << in;
        for (const QWidget *part : projections)
            add(part, QRect(part->width() - 300, 4, 300, 24));
        return parts;
    }

    // Same size; few pixels clearly other, and little in the mean: the vector code of another
    // processor rounds a grey value here and there.
    void compare(QImage actual, const QString &name, const QList<QRect> &masked) {
        actual = actual.convertToFormat(QImage::Format_RGB32);
        const double ratio = actual.devicePixelRatio();
        actual.setDevicePixelRatio(1.0);
        {
            QPainter painter(&actual);
            for (const QRect &part : masked)
                painter.fillRect(QRectF(part.topLeft() * ratio, part.size() * ratio),
                                 QColor(90, 100, 110));
        }
        const bool isOfManual = name.startsWith("panel_");
        const QString path =
            isOfManual
                ? QString(PELLUCID_SOURCE "/resources/manual/%1.png").arg(name)
                : QString(PELLUCID_SOURCE "/tests/ui/baselines/%1_%2.png").arg(name, density());
        if (qEnvironmentVariableIsSet("PELLUCID_ACCEPT_BASELINES")) {
            QVERIFY2(actual.save(path, "PNG", 0), qPrintable(path));
            return;
        }
        const QImage wanted = QImage(path).convertToFormat(QImage::Format_RGB32);
        QVERIFY2(!wanted.isNull(), qPrintable("there is no " + path));
        double sum = 0.0;
        qint64 other = 0;
        QImage difference(actual.size(), QImage::Format_Grayscale8);
        const bool isOfSize = wanted.size() == actual.size();
        for (int y = 0; isOfSize && y < actual.height(); ++y)
            for (int x = 0; x < actual.width(); ++x) {
                const QRgb a = actual.pixel(x, y), b = wanted.pixel(x, y);
                const int d =
                    std::max({std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)),
                              std::abs(qBlue(a) - qBlue(b))});
                sum += d;
                other += d > 24 ? 1 : 0;
                difference.scanLine(y)[x] = uchar(std::min(255, 4 * d));
            }
        const double count = double(actual.width()) * actual.height();
        if (isOfSize && sum / count < 0.5 && double(other) / count < 0.001)
            return;
        const QString folder = qEnvironmentVariable("PELLUCID_ARTIFACTS", QDir::tempPath());
        QDir().mkpath(folder);
        actual.save(folder + "/" + name + "_" + density() + "_actual.png");
        if (isOfSize)
            difference.save(folder + "/" + name + "_" + density() + "_difference.png");
        QFAIL(
            qPrintable(QString("%1: mean difference %2, %3 % of the pixels are other; the picture "
                               "is %4 x %5, wanted %6 x %7; see %8")
                           .arg(name)
                           .arg(sum / count)
                           .arg(100.0 * double(other) / count)
                           .arg(actual.width())
                           .arg(actual.height())
                           .arg(wanted.width())
                           .arg(wanted.height())
                           .arg(folder)));
    }

    std::unique_ptr<ui::Workstation> m_program;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::BaselineTest>(argc, argv);
}

#include "baseline_test.moc"
