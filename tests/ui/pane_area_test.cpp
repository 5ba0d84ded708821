// SPDX-License-Identifier: GPL-3.0-or-later
// The panes alone and in the window: layouts, dragging of borders, saved sizes.
#include "tests/ui/workstation.h"

#include <array>
#include <cstdlib>

#include <QSplitter>

#include "ui/views/pane_area.h"

namespace pellucid {

using namespace test;
using ui::PaneArea;
using ui::PaneLayout;

namespace {

enum Pane { axial, coronal, sagittal, projectionPane };

void moveTo(QWidget *widget, const QPoint &global) {
    QMouseEvent move(QEvent::MouseMove, widget->mapFromGlobal(global), global, Qt::NoButton,
                     Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &move);
}

// The handle moves with the mouse, so the path is in screen coordinates.
void dragHandle(QSplitterHandle *handle, const QPoint &by) {
    const QPoint grip = handle->rect().center(), from = handle->mapToGlobal(grip);
    QTest::mousePress(handle, Qt::LeftButton, Qt::NoModifier, grip);
    for (int step = 1; step <= 8; ++step)
        moveTo(handle, from + by * step / 8);
    QTest::mouseRelease(handle, Qt::LeftButton, Qt::NoModifier, handle->mapFromGlobal(from + by));
}

QSplitterHandle *handleOf(const PaneArea &area, const char *splitter, int n) {
    return area.findChild<QSplitter *>(splitter)->handle(n);
}

} // namespace

class PaneAreaTest : public Workstation {
    Q_OBJECT
private slots:
    void init() {
        for (QWidget *&pane : m_panes) {
            pane = new QWidget;
            pane->setFocusPolicy(Qt::StrongFocus);
        }
        m_area = std::make_unique<PaneArea>(m_panes);
        m_area->resize(900, 700);
        m_area->show();
        QVERIFY(QTest::qWaitForWindowExposed(m_area.get()));
    }
    void cleanup() {
        m_area.reset();
        Workstation::cleanup();
    }

    void theDefaultSizes_data() {
        QTest::addColumn<bool>("isTwoByTwo");
        QTest::addColumn<QSize>("area");
        QTest::addColumn<QList<QRect>>("panes"); // axial, coronal, sagittal, projection
        QTest::newRow("1 + 3") << false << QSize(900, 700)
                               << QList<QRect>{{0, 0, 232, 232},
                                               {0, 234, 232, 232},
                                               {0, 468, 232, 232},
                                               {234, 0, 666, 700}};
        QTest::newRow("1 + 3, odd")
            << false << QSize(901, 704)
            << QList<QRect>{
                   {0, 0, 233, 233}, {0, 235, 233, 233}, {0, 470, 233, 234}, {235, 0, 666, 704}};
        QTest::newRow("1 + 3, narrow")
            << false << QSize(500, 700)
            << QList<QRect>{
                   {0, 0, 200, 232}, {0, 234, 200, 232}, {0, 468, 200, 232}, {202, 0, 298, 700}};
        QTest::newRow("2 x 2") << true << QSize(900, 700)
                               << QList<QRect>{{0, 0, 449, 349},
                                               {0, 351, 449, 349},
                                               {451, 351, 449, 349},
                                               {451, 0, 449, 349}};
        QTest::newRow("2 x 2, odd")
            << true << QSize(901, 703)
            << QList<QRect>{
                   {0, 0, 449, 350}, {0, 352, 449, 351}, {451, 352, 450, 351}, {451, 0, 450, 350}};
    }
    void theDefaultSizes() {
        QFETCH(bool, isTwoByTwo);
        QFETCH(QSize, area);
        QFETCH(QList<QRect>, panes);
        m_area->setPaneLayout(isTwoByTwo ? PaneLayout::twoByTwo : PaneLayout::onePlusThree);
        m_area->resize(area);
        QTRY_COMPARE(places(), panes);
        for (int n = 0; n < 4; ++n) {
            m_area->toggleMaximized(m_panes[std::size_t(n)]);
            QCOMPARE(places()[n], m_area->rect());
            m_area->toggleMaximized(m_panes[std::size_t(n)]);
            QCOMPARE(places(), panes);
        }
        QCoreApplication::processEvents(); // queued events move nothing
        QCOMPARE(places(), panes);
    }

    void theBordersAreWideEnoughToGrab() {
        for (int x = 230; x < 236; ++x) // the gap is at 232 and 233
            QVERIFY(qobject_cast<QSplitterHandle *>(m_area->childAt(x, 100)) != nullptr);
        QCOMPARE(m_area->childAt(229, 100), m_panes[axial]);
        QCOMPARE(m_area->childAt(236, 100), m_panes[projectionPane]);
        QCOMPARE(handleOf(*m_area, "paneColumns", 1)->cursor().shape(), Qt::SplitHCursor);
        QCOMPARE(handleOf(*m_area, "leftPanes", 1)->cursor().shape(), Qt::SplitVCursor);
    }

    void aBorderFollowsTheMouse() {
        dragHandle(handleOf(*m_area, "paneColumns", 1), {80, 0});
        dragHandle(handleOf(*m_area, "leftPanes", 2), {0, -40});
        QCOMPARE(
            places(),
            QList<QRect>(
                {{0, 0, 312, 232}, {0, 234, 312, 192}, {0, 428, 312, 272}, {314, 0, 586, 700}}));
        // No pane vanishes.
        m_panes[projectionPane]->setMinimumSize(200, 160);
        dragHandle(handleOf(*m_area, "paneColumns", 1), {5000, 0});
        QCOMPARE(m_panes[projectionPane]->width(), 200);
    }

    void theRowsOfTwoByTwoStayAligned() {
        m_panes[projectionPane]->setMinimumSize(200, 160);
        m_area->setPaneLayout(PaneLayout::twoByTwo);
        dragHandle(handleOf(*m_area, "rightPanes", 1), {0, 50});
        QCOMPARE(m_panes[axial]->height(), 399);
        QCOMPARE(m_panes[projectionPane]->height(), 399);
        dragHandle(handleOf(*m_area, "leftPanes", 1), {0, -5000});
        QCOMPARE(m_panes[axial]->height(), 160);
        QCOMPARE(m_panes[projectionPane]->height(), 160);
    }

    void aDoubleClickRestoresTheDefaultSizes() {
        const QList<QRect> before = places();
        auto *handle = handleOf(*m_area, "paneColumns", 1);
        dragHandle(handle, {80, 0});
        dragHandle(handleOf(*m_area, "leftPanes", 1), {0, 30});
        QVERIFY(places() != before);
        QTest::mouseDClick(handle, Qt::LeftButton);
        QCOMPARE(places(), before);
        // The mouse moves before the button is released.
        moveTo(handle, handle->mapToGlobal(handle->rect().center()) + QPoint(3, 0));
        QCOMPARE(places(), before);
    }

    void eachLayoutKeepsItsSizes() {
        dragHandle(handleOf(*m_area, "paneColumns", 1), {80, 0});
        const QList<QRect> first = places();
        m_area->setPaneLayout(PaneLayout::twoByTwo);
        QCOMPARE(m_panes[axial]->width(), 449);
        dragHandle(handleOf(*m_area, "paneColumns", 1), {-60, 0});
        dragHandle(handleOf(*m_area, "leftPanes", 1), {0, 20});
        const QList<QRect> second = places();
        m_area->toggleMaximized(m_panes[sagittal]);
        QCOMPARE(places()[sagittal], m_area->rect());
        m_area->setPaneLayout(PaneLayout::onePlusThree);
        QCOMPARE(places(), first);
        m_area->toggleMaximized(m_panes[sagittal]);
        m_area->toggleMaximized(m_panes[sagittal]);
        QCOMPARE(places(), first);
        m_area->setPaneLayout(PaneLayout::twoByTwo);
        QCOMPARE(places(), second);
    }

    void sizesScaleWithTheWindow() {
        dragHandle(handleOf(*m_area, "paneColumns", 1), {217, 0}); // to the middle
        const QList<QRect> before = places();
        QCOMPARE(before[axial].width(), 449);
        m_area->resize(602, 500);
        QTRY_COMPARE(m_panes[axial]->width(), 300);
        m_area->resize(900, 700);
        QTRY_COMPARE(places(), before);
    }

    void aChangeOfLayoutKeepsTheKeyboardFocus() {
        QVERIFY(activate(*m_area));
        m_panes[sagittal]->setFocus();
        m_area->setPaneLayout(PaneLayout::twoByTwo);
        QVERIFY(m_panes[sagittal]->hasFocus());
    }

    void aLinkedAreaIsArrangedAlike() {
        std::array<QWidget *, 4> panes{new QWidget, new QWidget, new QWidget, new QWidget};
        PaneArea other(panes);
        other.resize(m_area->size());
        other.show();
        QVERIFY(QTest::qWaitForWindowExposed(&other));
        // The areas follow each other, as for studies side by side.
        connect(m_area.get(), &PaneArea::arranged, &other, [&] { other.arrangeAs(*m_area); });
        connect(&other, &PaneArea::arranged, m_area.get(), [&] { m_area->arrangeAs(other); });
        dragHandle(handleOf(*m_area, "paneColumns", 1), {80, 0});
        QCOMPARE(panes[axial]->size(), m_panes[axial]->size());
        QCOMPARE(panes[axial]->width(), 312);
        QTest::mouseDClick(handleOf(other, "paneColumns", 1), Qt::LeftButton);
        QCOMPARE(panes[axial]->width(), 232);
        QCOMPARE(m_panes[axial]->width(), 232);
    }

    void invalidSettingsAreIgnored() {
        const QList<QRect> before = places();
        QSettings settings;
        for (const QVariant &value :
             {QVariant("wide"), QVariant(QVariantList{1, 2, 3}),
              QVariant(QVariantList{1, 2, 3, 4, -5}), QVariant(QVariantList{1, 2, 3, 4, "wide"})}) {
            settings.setValue("panes/onePlusThree", value);
            m_area->restoreSizes(settings);
            QCOMPARE(places(), before);
        }
        settings.remove("panes");
    }

    void theNextWindowRestoresTheSizes() {
        const auto width = [this] { return find<QWidget>("axialView")->width(); };
        const auto columns = [this] {
            return handleOf(*find<PaneArea>("paneArea"), "paneColumns", 1);
        };
        restart();
        open(headPath());
        const int byDefault = width();
        dragHandle(columns(), {100, 0});
        QCOMPARE(width(), byDefault + 100);
        QVERIFY(mainWindow().close());
        restart();
        open(headPath());
        // The docks beside the panes may round their own sizes by a pixel.
        QVERIFY2(std::abs(width() - byDefault - 100) <= 2, qPrintable(QString::number(width())));
        QTest::mouseDClick(columns(), Qt::LeftButton);
        QVERIFY(std::abs(width() - byDefault) <= 2);
        QVERIFY(mainWindow().close());
        restart();
        open(headPath());
        QVERIFY(std::abs(width() - byDefault) <= 2);
    }

private:
    // In the order of the panes.
    QList<QRect> places() const {
        QList<QRect> places;
        for (const QWidget *pane : m_panes)
            places << QRect(pane->mapTo(m_area.get(), QPoint()), pane->size());
        return places;
    }

    std::array<QWidget *, 4> m_panes{};
    std::unique_ptr<PaneArea> m_area;
};

} // namespace pellucid

int main(int argc, char **argv) {
    return pellucid::test::run<pellucid::PaneAreaTest>(argc, argv);
}

#include "pane_area_test.moc"
