// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that somebody has accepted: the window in both themes and both languages, at the density
// of QT_SCALE_FACTOR, and every panel and dialog. With PELLUCID_ACCEPT_BASELINES the test writes
// the pictures instead of comparing them (`./dev accept-pictures`), those of the panels into the
// manual.
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
#include "ui/window/file_actions.h"

namespace pellucid {

using namespace test;

class BaselineTest : public Workstation {
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
    void init() { forgetEverything(); }

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
        compare(mainWindow().grab().toImage(), "window_" + theme + "_" + language,
                changingParts(&mainWindow()));
    }

    void theStartPage() {
        begin("dark", "en");
        compare(mainWindow().grab().toImage(), "start_page", changingParts(&mainWindow()));
    }

    // Each is a picture of the manual.
    void thePanels() {
        if (density() != "1x")
            QSKIP("the manual's pictures have one density");
        begin("dark", "en");
        openHead();
        for (const char *dock :
             {"studyDock", "measurementsDock", "historyDock", "presetsDock", "classesDock",
              "transferFunctionDock", "radiographDock", "shadingDock", "qualityDock"}) {
            auto *panel = mainWindow().findChild<QDockWidget *>(dock);
            QVERIFY2(panel != nullptr, dock);
            panel->show();
            settle();
            compare(panel->grab().toImage(), "panel_" + QString(dock).remove("Dock"),
                    changingParts(panel));
        }
        mainWindow().findChild<QDockWidget *>("historyDock")->hide();
        for (const char *pane : {"axialView", "projectionView"})
            compare(find<QWidget>(pane)->grab().toImage(), "panel_" + QString(pane).remove("View"),
                    changingParts(find<QWidget>(pane)));
        find<QAction>("exportPictureAction")->trigger();
        find<QLineEdit>("exportPathEdit")->setText("/home/jane/projection.png");
        dialog("exportDialog", "panel_export");
        mainWindow().files().importPaths({"/media/cdrom"});
        dialog("importDialog", "panel_import");
        find<QAction>("preferencesAction")->trigger();
        dialog("preferencesDialog", "panel_preferences");
        find<QAction>("aboutAction")->trigger();
        dialog("aboutDialog", "about");
    }

    // The window after the manual's first chapter. It is not compared, because its panels are.
    void theFirstStudy() {
        if (!isAccepting() || density() != "1x")
            QSKIP("a picture of the manual, made by ./dev accept-pictures");
        begin("dark", "en", {1440, 900});
        mainWindow().openPhantom("head");
        waitForVolume();
        choosePreset("Bone over soft tissue");
        dragMouse(projection(), Qt::LeftButton, projection()->rect().center(), {-120, 25});
        settle();
        const auto &error = projection()->frames().error();
        QTRY_VERIFY_WITH_TIMEOUT(error && error->isMeasured(), patienceMs);
        find<QListWidget>("presetGallery")->scrollToTop();
        QVERIFY(mainWindow().grab().save(manual("workstation"), "PNG", 0));
    }

private:
    static bool isAccepting() { return qEnvironmentVariableIsSet("PELLUCID_ACCEPT_BASELINES"); }
    static QString manual(const QString &picture) {
        return QString(PELLUCID_SOURCE "/resources/manual/%1.png").arg(picture);
    }

    void begin(const QString &theme, const QString &language, QSize size = {1280, 800}) {
        QSettings().setValue("theme", theme);
        QSettings().setValue("language", language);
        restart(size);
    }

    // With a look, a measurement, and the pictures of gallery and list.
    void openHead() {
        open(QString::fromStdString((m_folder / "shown").string()));
        QTest::keyClick(&mainWindow(), Qt::Key_M);
        auto *axial = find<ui::MprView>("axialView");
        dragMouse(axial, Qt::LeftButton, {axial->width() / 3, axial->height() / 2},
                  {axial->width() / 4, -axial->height() / 8});
        QTest::keyClick(&mainWindow(), Qt::Key_W);
        auto *gallery = find<QListWidget>("presetGallery");
        QListWidgetItem *wanted = nullptr;
        for (int n = 0; n < gallery->count(); ++n)
            if (gallery->item(n)->data(Qt::UserRole) == "Bone over soft tissue")
                wanted = gallery->item(n);
        QVERIFY(wanted != nullptr);
        clickItem(*gallery, *wanted);
        gallery->scrollToTop();
        settle();
        const auto isBlack = [&](int n) {
            return meanGrey(gallery->item(n)->icon().pixmap(40, 40).toImage()) == 0.0;
        };
        QTRY_VERIFY_WITH_TIMEOUT(!isBlack(0) && !isBlack(gallery->count() - 1), patienceMs);
        auto *tree = find<QTreeView>("seriesTree");
        const QModelIndex row = tree->model()->index(0, 0, tree->model()->index(0, 0));
        QTRY_VERIFY(!row.data(Qt::DecorationRole).value<QImage>().isNull());
        projection()->setFocus();
        settle();
    }

    QString density() const {
        return QString("%1x").arg(m_program
                                      ? mainWindow().devicePixelRatioF()
                                      : qEnvironmentVariable("QT_SCALE_FACTOR", "1").toDouble());
    }

    void dialog(const char *name, const QString &picture) {
        auto *shown = find<QDialog>(name);
        QVERIFY(activate(*shown)); // which draws the focus
        compare(shown->grab().toImage(), picture, changingParts(shown));
        shown->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    // Times, instruction sets, versions and folders differ from run to run.
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

    // The same size, few pixels that differ clearly, and a small mean difference: the vector code
    // of another processor rounds a few grey values differently.
    void compare(QImage actual, const QString &name, const QList<QRect> &masked) {
        actual = actual.convertToFormat(QImage::Format_RGB32);
        const double ratio = actual.devicePixelRatio();
        actual.setDevicePixelRatio(1.0);
        const bool isOfManual = name.startsWith("panel_");
        const QString path =
            isOfManual
                ? manual(name)
                : QString(PELLUCID_SOURCE "/tests/ui/baselines/%1_%2.png").arg(name, density());
        const auto hide = [&](QImage &picture) {
            QPainter painter(&picture);
            for (const QRect &part : masked)
                painter.fillRect(QRectF(part.topLeft() * ratio, part.size() * ratio),
                                 QColor(90, 100, 110));
        };
        // The manual shows everything.
        if (!isAccepting() || !isOfManual)
            hide(actual);
        if (isAccepting()) {
            QVERIFY2(actual.save(path, "PNG", 0), qPrintable(path));
            return;
        }
        QImage wanted = QImage(path).convertToFormat(QImage::Format_RGB32);
        QVERIFY2(!wanted.isNull(), qPrintable("there is no " + path));
        hide(wanted);
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
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::BaselineTest>(argc, argv);
}

#include "baseline_test.moc"
