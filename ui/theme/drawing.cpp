// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme/drawing.h"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include <QLinearGradient>
#include <QPainter>
#include <QXmlStreamReader>

namespace pellucid::ui {

namespace {

// Numbers and letters of a path, which need no separators: "a2 2 0 0 0-.5.5".
class PathText {
public:
    explicit PathText(const QString &text) : m_text(text) {}

    bool isAtEnd() {
        skip();
        return m_at == m_text.size();
    }
    bool isAtLetter() {
        skip();
        return m_at < m_text.size() && m_text[m_at].isLetter();
    }
    char letter() { return m_text[m_at++].toLatin1(); }
    double flag() {
        skip();
        return m_text[m_at++].digitValue();
    }
    double number() {
        skip();
        const qsizetype from = m_at;
        bool hasDot = false;
        for (; m_at < m_text.size(); ++m_at) {
            const QChar c = m_text[m_at];
            const bool isSign = c == '-' || c == '+', isDot = c == '.';
            if ((isSign && m_at > from) || (isDot && hasDot) || (!isSign && !isDot && !c.isDigit()))
                break;
            hasDot = hasDot || isDot;
        }
        bool isNumber = false;
        const double value = m_text.mid(from, m_at - from).toDouble(&isNumber);
        if (!isNumber)
            throw std::logic_error("no number in the path " + m_text.toStdString());
        return value;
    }

private:
    void skip() {
        while (m_at < m_text.size() && (m_text[m_at].isSpace() || m_text[m_at] == ','))
            ++m_at;
    }
    QString m_text;
    qsizetype m_at = 0;
};

// From the current point (SVG 1.1, F.6.5), for axes that are not turned.
void addArc(QPainterPath &path, double rx, double ry, bool isLarge, bool isClockwise, QPointF to) {
    const QPointF from = path.currentPosition(), half = (from - to) / 2.0;
    const double x = half.x() / rx, y = half.y() / ry, square = x * x + y * y;
    if (square > 1.0) { // too small to reach the end
        rx *= std::sqrt(square);
        ry *= std::sqrt(square);
    }
    const double away = square > 0.0 && square < 1.0 ? std::sqrt((1.0 - square) / square) : 0.0;
    const double side = isLarge == isClockwise ? -away : away;
    const QPointF center =
        (from + to) / 2.0 + QPointF(side * rx * half.y() / ry, -side * ry * half.x() / rx);
    const auto angle = [&](QPointF at) { // counterclockwise, as Qt has it
        return std::atan2((center.y() - at.y()) / ry, (at.x() - center.x()) / rx) * 180.0 /
               std::numbers::pi;
    };
    double sweep = angle(to) - angle(from);
    if (isClockwise && sweep > 0.0)
        sweep -= 360.0;
    if (!isClockwise && sweep < 0.0)
        sweep += 360.0;
    path.arcTo(QRectF(center.x() - rx, center.y() - ry, 2.0 * rx, 2.0 * ry), angle(from), sweep);
}

QPainterPath pathOf(const QString &data) {
    PathText text(data);
    QPainterPath path;
    QPointF control; // of the last curve, which a smooth one mirrors
    for (char command = 'M', before = ' '; !text.isAtEnd(); before = command) {
        if (text.isAtLetter())
            command = text.letter();
        else if (command == 'Z' || command == 'z')
            throw std::logic_error("a path goes on after its end");
        else if (command == 'M' || command == 'm') // further points are joined by lines
            command = command == 'M' ? 'L' : 'l';
        const bool isRelative = command >= 'a';
        const QPointF here = path.currentPosition(), origin = isRelative ? here : QPointF();
        const auto point = [&] {
            const double x = text.number();
            return origin + QPointF(x, text.number());
        };
        switch (isRelative ? command : char(command - 'A' + 'a')) {
        case 'm':
            path.moveTo(point());
            break;
        case 'l':
            path.lineTo(point());
            break;
        case 'h':
            path.lineTo(origin.x() + text.number(), here.y());
            break;
        case 'v':
            path.lineTo(here.x(), origin.y() + text.number());
            break;
        case 'c':
        case 's': {
            const bool isSmooth = command == 's' || command == 'S';
            const bool follows = before == 'c' || before == 'C' || before == 's' || before == 'S';
            const QPointF first = !isSmooth ? point() : follows ? 2.0 * here - control : here;
            control = point();
            path.cubicTo(first, control, point());
            break;
        }
        case 'a': {
            const double rx = text.number(), ry = text.number();
            text.number(); // how far the axes are turned
            const bool isLarge = text.flag() != 0.0, isClockwise = text.flag() != 0.0;
            addArc(path, rx, ry, isLarge, isClockwise, point());
            break;
        }
        case 'z':
            path.closeSubpath();
            break;
        default:
            throw std::logic_error(std::string("a path has ") + command);
        }
    }
    return path;
}

// The attributes of an element and of those around it.
using Style = std::map<QString, QString>;

double numberIn(const Style &style, const QString &name, double otherwise) {
    const auto found = style.find(name);
    return found == style.end() ? otherwise : found->second.toDouble();
}

QString textIn(const Style &style, const QString &name, const QString &otherwise) {
    const auto found = style.find(name);
    return found == style.end() ? otherwise : found->second;
}

using Gradients = std::map<QString, QLinearGradient>;

QBrush paintOf(const Style &style, const QString &name, const QString &otherwise,
               const Gradients &gradients) {
    const QString paint = textIn(style, name, otherwise);
    if (paint == "none")
        return Qt::NoBrush;
    if (paint.startsWith("url(#"))
        return gradients.at(paint.mid(5).chopped(1));
    QColor color(paint);
    color.setAlphaF(float(numberIn(style, name + "-opacity", 1.0)));
    return color;
}

QPainterPath outlineOf(const QString &element, const Style &style) {
    const auto number = [&](const char *name) { return numberIn(style, name, 0.0); };
    QPainterPath path;
    if (element == "path")
        return pathOf(style.at("d"));
    if (element == "rect")
        path.addRoundedRect(number("x"), number("y"), number("width"), number("height"),
                            number("rx"), number("rx"));
    else if (element == "circle")
        path.addEllipse(QPointF(number("cx"), number("cy")), number("r"), number("r"));
    else if (element == "ellipse")
        path.addEllipse(QPointF(number("cx"), number("cy")), number("rx"), number("ry"));
    else
        throw std::logic_error("an icon has the element " + element.toStdString());
    return path;
}

} // namespace

Drawing::Drawing(const QByteArray &svg) {
    QXmlStreamReader xml(svg);
    std::vector<Style> around(1);
    Gradients gradients;
    QString gradient;
    while (!xml.atEnd()) {
        const auto token = xml.readNext();
        if (token == QXmlStreamReader::EndElement)
            around.pop_back();
        if (token != QXmlStreamReader::StartElement)
            continue;
        Style style = around.back();
        for (const QXmlStreamAttribute &attribute : xml.attributes())
            style[attribute.name().toString()] = attribute.value().toString();
        const QString element = xml.name().toString();
        if (element == "svg") {
            const QStringList box = style.at("viewBox").split(' ');
            m_box =
                QRectF(box[0].toDouble(), box[1].toDouble(), box[2].toDouble(), box[3].toDouble());
            for (const char *const own : {"width", "height", "viewBox"})
                style.erase(own);
        } else if (element == "linearGradient") {
            gradient = style.at("id");
            gradients[gradient] = QLinearGradient(0.0, 0.0, 0.0, 1.0);
            gradients[gradient].setCoordinateMode(QGradient::ObjectMode);
        } else if (element == "stop") {
            QColor color(style.at("stop-color"));
            color.setAlphaF(float(numberIn(style, "stop-opacity", 1.0)));
            gradients[gradient].setColorAt(numberIn(style, "offset", 0.0), color);
        } else if (element != "defs") {
            Shape shape{outlineOf(element, style), paintOf(style, "fill", "#000000", gradients),
                        QPen(Qt::NoPen)};
            if (const QBrush stroke = paintOf(style, "stroke", "none", gradients);
                stroke.style() != Qt::NoBrush)
                shape.pen = QPen(
                    stroke, numberIn(style, "stroke-width", 1.0), Qt::SolidLine,
                    textIn(style, "stroke-linecap", "") == "round" ? Qt::RoundCap : Qt::FlatCap,
                    textIn(style, "stroke-linejoin", "") == "round" ? Qt::RoundJoin
                                                                    : Qt::SvgMiterJoin);
            m_shapes.push_back(shape);
        }
        around.push_back(style);
    }
    if (xml.hasError())
        throw std::logic_error(xml.errorString().toStdString());
}

void Drawing::paint(QPainter &painter, const QRectF &to) const {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(to.topLeft());
    painter.scale(to.width() / m_box.width(), to.height() / m_box.height());
    painter.translate(-m_box.topLeft());
    for (const Shape &shape : m_shapes) {
        painter.setBrush(shape.brush);
        painter.setPen(shape.pen);
        painter.drawPath(shape.path);
    }
    painter.restore();
}

} // namespace pellucid::ui
