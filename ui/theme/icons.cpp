// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme/icons.h"

#include <stdexcept>

#include <QFile>
#include <QIconEngine>
#include <QIconEnginePlugin>
#include <QPainter>
#include <QtPlugin>

#include "ui/theme/drawing.h"
#include "ui/theme/theme.h"

namespace pellucid::ui {

namespace {

QByteArray contentsOf(const QString &path) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        throw std::logic_error("no icon " + path.toStdString());
    return file.readAll();
}

// Rendered at the requested size, never scaled from a different one.
class DrawnIcon : public QIconEngine {
public:
    DrawnIcon() = default;
    explicit DrawnIcon(QByteArray drawing) : m_drawing(std::move(drawing)) {}

    void addFile(const QString &path, const QSize &, QIcon::Mode, QIcon::State) override {
        m_drawing = contentsOf(path);
    }
    void paint(QPainter *painter, const QRect &rect, QIcon::Mode mode,
               QIcon::State state) override {
        const char *const role = mode == QIcon::Disabled ? "muted"
                                 : state == QIcon::On    ? "accent"
                                                         : "text";
        QByteArray drawing = m_drawing;
        drawing.replace("currentColor", Theme::current().color(role).name().toUtf8());
        Drawing(drawing).paint(*painter, rect);
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
    QIconEngine *clone() const override { return new DrawnIcon(*this); }

private:
    QByteArray m_drawing;
};

} // namespace

// For style sheets, which name icons by their files. A suffix of its own leaves the desktop's icons
// to Qt.
class DrawnIcons : public QIconEnginePlugin {
    Q_OBJECT
    Q_PLUGIN_METADATA(IID QIconEngineFactoryInterface_iid FILE "drawn_icons.json")
public:
    QIconEngine *create(const QString &path) override {
        return path.isEmpty() ? new DrawnIcon : new DrawnIcon(contentsOf(path));
    }
};

QIcon themedIcon(const QString &name) {
    return QIcon(new DrawnIcon(contentsOf(":/pellucid/icons/" + name + ".svg")));
}

} // namespace pellucid::ui

using pellucid::ui::DrawnIcons;
Q_IMPORT_PLUGIN(DrawnIcons)
#include "icons.moc"
