// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme/icons.h"

#include <stdexcept>

#include <QAction>
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

void setActionIcons(QObject &window) {
    const struct {
        const char *action, *icon;
    } icons[] = {{"openFilesAction", "open"},
                 {"importAction", "import"},
                 {"savePictureAction", "picture"},
                 {"exportPictureAction", "export"},
                 {"preferencesAction", "preferences"},
                 {"undoAction", "undo"},
                 {"redoAction", "redo"},
                 {"findStudyAction", "search"},
                 {"windowToolAction", "window"},
                 {"panToolAction", "pan"},
                 {"zoomToolAction", "zoom"},
                 {"crosshairToolAction", "crosshair"},
                 {"slabAction", "slab"},
                 {"distanceToolAction", "distance"},
                 {"angleToolAction", "angle"},
                 {"cobbToolAction", "cobb"},
                 {"polylineToolAction", "polyline"},
                 {"arrowToolAction", "arrow"},
                 {"textToolAction", "text"},
                 {"copyPictureAction", "copy"},
                 {"printAction", "print"},
                 {"headerAction", "tags"},
                 {"ellipseToolAction", "ellipse"},
                 {"rectangleToolAction", "rectangle"},
                 {"cropToolAction", "crop"},
                 {"connectedToolAction", "connected"},
                 {"paintToolAction", "paint"},
                 {"scissorsToolAction", "scissors"},
                 {"playAction", "play"},
                 {"onePlusThreeAction", "one-plus-three"},
                 {"twoByTwoAction", "two-by-two"},
                 {"linkStudiesAction", "link"},
                 {"manualAction", "manual"}};
    for (const auto &[action, icon] : icons) {
        QAction *const found = window.findChild<QAction *>(action);
        found->setIcon(themedIcon(icon));
        // Menus show text only; icons beside it would add nothing.
        found->setIconVisibleInMenu(false);
    }
}

} // namespace pellucid::ui
