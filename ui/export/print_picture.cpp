// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/export/print_picture.h"

#include <QPagedPaintDevice>
#include <QPainter>

namespace pellucid::ui {

bool print(const PrintedPage &page, QPagedPaintDevice &device) {
    QPainter painter;
    if (!painter.begin(&device))
        return false;
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    QFont font = painter.font();
    font.setPointSizeF(9.0);
    painter.setFont(font);
    const QRect area = painter.viewport();
    const int line = painter.fontMetrics().lineSpacing() * 2;
    const auto text = [&](const QString &words, int flags) {
        painter.drawText(area, flags,
                         painter.fontMetrics().elidedText(words, Qt::ElideRight, area.width()));
    };
    text(page.heading, Qt::AlignLeft | Qt::AlignTop);
    text(page.footing, Qt::AlignLeft | Qt::AlignBottom);
    const QRect room = area.adjusted(0, line, 0, -line);
    QRect place(QPoint(), page.picture.deviceIndependentSize().toSize().scaled(
                              room.size(), Qt::KeepAspectRatio));
    place.moveCenter(room.center());
    painter.drawImage(place, page.picture);
    return painter.end();
}

} // namespace pellucid::ui
