// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDropEvent>
#include <QListWidget>
#include <QMimeData>
#include <QMouseEvent>
#include <QSlider>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QUrl>
#include <QWheelEvent>
#include <QtTest>

/// Acts on widgets as a person does, by mouse.
namespace pellucid::test {

/// Drops files and folders on a window.
inline void drop(QWidget &window, const QList<QUrl> &urls) {
    QMimeData data;
    data.setUrls(urls);
    QDragEnterEvent enter(QPoint(400, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent dropped(QPointF(400, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &dropped);
}

/// Moves the mouse with these buttons held. QTest's own moves hold none.
inline void moveMouse(QWidget *widget, QPoint to, Qt::MouseButtons buttons = Qt::NoButton) {
    QMouseEvent move(QEvent::MouseMove, to, widget->mapToGlobal(to), Qt::NoButton, buttons,
                     Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &move);
}

/// Drags in eight moves. The program handles everything that a move causes before the next one.
inline void dragMouse(QWidget *widget, Qt::MouseButton button, QPoint from, QPoint by) {
    QTest::mousePress(widget, button, Qt::NoModifier, from);
    for (int step = 1; step <= 8; ++step) {
        moveMouse(widget, from + by * step / 8, button);
        QCoreApplication::processEvents();
    }
    QTest::mouseRelease(widget, button, Qt::NoModifier, from + by);
}

inline void turnWheel(QWidget *widget, int steps) {
    const QPointF at = widget->rect().center();
    QWheelEvent event(at, widget->mapToGlobal(at), {}, QPoint(0, 120 * steps), Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(widget, &event);
}

/// Drags the handle of a slider.
inline void dragSlider(QSlider *slider, QPoint by) {
    QStyleOptionSlider option;
    option.initFrom(slider);
    option.minimum = slider->minimum();
    option.maximum = slider->maximum();
    option.sliderPosition = option.sliderValue = slider->value();
    const QRect handle = slider->style()->subControlRect(QStyle::CC_Slider, &option,
                                                         QStyle::SC_SliderHandle, slider);
    dragMouse(slider, Qt::LeftButton, handle.center(), by);
}

/// Clicks an entry of a list.
inline void clickItem(QListWidget &list, QListWidgetItem &item) {
    list.scrollToItem(&item);
    QTest::mouseClick(list.viewport(), Qt::LeftButton, Qt::NoModifier,
                      list.visualItemRect(&item).center());
}

/// Clicks a preset in the gallery of a window.
inline void clickPreset(QWidget &window, const QString &name) {
    auto *gallery = window.findChild<QListWidget *>("presetGallery");
    const auto items = gallery->findItems(name, Qt::MatchExactly);
    QVERIFY2(!items.isEmpty(), qPrintable("no preset " + name));
    clickItem(*gallery, *items.front());
}

} // namespace pellucid::test
