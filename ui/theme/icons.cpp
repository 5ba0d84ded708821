// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme/icons.h"

#include <stdexcept>

#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QSvgRenderer>

#include "ui/theme/theme.h"

namespace pellucid::ui {

namespace {

// Rendered at the requested size, never scaled from a different one.
class ThemedIcon : public QIconEngine {
public:
    explicit ThemedIcon(QByteArray drawing) : m_drawing(std::move(drawing)) {}

    void paint(QPainter *painter, const QRect &rect, QIcon::Mode mode,
               QIcon::State state) override {
        const char *const role = mode == QIcon::Disabled ? "muted"
                                 : state == QIcon::On    ? "accent"
                                                         : "text";
        QByteArray drawing = m_drawing;
        drawing.replace("currentColor", Theme::current().color(role).name().toUtf8());
        QSvgRenderer(drawing).render(painter, rect);
    }
    QPixmap pixmap(const QSize &size, QIcon::Mode mode, QIcon::State state) override {
        if (size.isEmpty()) // a squeezed button asks for it; QPainter would warn
            return {};
        QPixmap pixmap(size);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        paint(&painter, QRect(QPoint(), size), mode, state);
        return pixmap;
    }
    QIconEngine *clone() const override { return new ThemedIcon(*this); }

private:
    QByteArray m_drawing;
};

} // namespace

QIcon themedIcon(const QString &name) {
    QFile file(":/pellucid/icons/" + name + ".svg");
    if (!file.open(QIODevice::ReadOnly))
        throw std::logic_error("no icon " + name.toStdString());
    return QIcon(new ThemedIcon(file.readAll()));
}

} // namespace pellucid::ui
