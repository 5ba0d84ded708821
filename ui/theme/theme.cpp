// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme/theme.h"

#include <stdexcept>

#include <QApplication>
#include <QFile>
#include <QFont>
#include <QJsonDocument>
#include <QJsonObject>
#include <QPalette>
#include <QRegularExpression>
#include <QStyleFactory>
#include <QWidget>

#include "core/platform/display.h"

// A static library must register its resources explicitly; the macro needs the global namespace.
static void registerResources() {
    Q_INIT_RESOURCE(resources);
}

namespace pellucid::ui {

namespace {

QByteArray resource(const QString &path) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        throw std::logic_error("no resource " + path.toStdString());
    return file.readAll();
}

// Whoever works on the style reads it from a file, without a build.
QByteArray styleSheet() {
    if (const QString own = qEnvironmentVariable("PELLUCID_STYLE"); !own.isEmpty()) {
        QFile file(own);
        if (file.open(QIODevice::ReadOnly))
            return file.readAll();
        qWarning("PELLUCID_STYLE: %s: %s", qPrintable(own), qPrintable(file.errorString()));
    }
    return resource(":/pellucid/styles/workstation.qss");
}

Theme &appliedTheme() {
    static Theme theme = Theme::named("dark");
    return theme;
}

} // namespace

const Theme &Theme::current() {
    return appliedTheme();
}

Theme Theme::named(const QString &name) {
    registerResources();
    Theme theme;
    const QJsonObject roles = QJsonDocument::fromJson(resource(":/pellucid/styles/colors.json"))
                                  .object()[name]
                                  .toObject();
    for (auto it = roles.begin(); it != roles.end(); ++it)
        theme.m_colors.insert(it.key(), QColor(it.value().toString()));
    return theme;
}

QColor Theme::color(const QString &role) const {
    const auto it = m_colors.find(role);
    if (it == m_colors.end())
        throw std::logic_error("no color " + role.toStdString());
    return *it;
}

void Theme::apply(QApplication &application) const {
    appliedTheme() = *this;
    application.setStyle(QStyleFactory::create("Fusion"));
    QPalette palette;
    palette.setColor(QPalette::Window, color("background"));
    palette.setColor(QPalette::Base, color("panel"));
    palette.setColor(QPalette::AlternateBase, color("raised"));
    palette.setColor(QPalette::Button, color("raised"));
    for (const auto role :
         {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText})
        palette.setColor(role, color("text"));
    palette.setColor(QPalette::PlaceholderText, color("muted"));
    palette.setColor(QPalette::ToolTipBase, color("raised"));
    palette.setColor(QPalette::Highlight, color("accent"));
    palette.setColor(QPalette::Link, color("accent"));
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        palette.setColor(QPalette::Disabled, role, color("muted"));
    application.setPalette(palette);
    QFont font = application.font();
    font.setPointSizeF(9.0);
    // Without these, the fallback font may draw Chinese with Japanese glyphs, and too bold.
    QStringList families = font.families();
    for (const char *family : {"Noto Sans CJK TC", "Microsoft JhengHei", "PingFang TC"})
        if (!families.contains(family))
            families << family;
    font.setFamilies(families);
    application.setFont(font);

    QString sheet = QString::fromUtf8(styleSheet());
    static const QRegularExpression role("@([a-z]+)");
    for (auto match = role.match(sheet); match.hasMatch();
         match = role.match(sheet, match.capturedStart())) {
        // The comment that explains the notation contains no role.
        const auto it = m_colors.find(match.captured(1));
        const QString value = it == m_colors.end() ? match.captured(1) : it->name();
        sheet.replace(match.capturedStart(), match.capturedLength(), value);
    }
    application.setStyleSheet(sheet);
    for (const QWidget *const window : QApplication::topLevelWidgets())
        if (window->isVisible())
            matchTitleBar(*window);
}

void matchTitleBar(const QWidget &window) {
    constexpr int middle = 128;
    platform::setTitleBar(window.winId(),
                          Theme::current().color("background").lightness() < middle);
}

} // namespace pellucid::ui
