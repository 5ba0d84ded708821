// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/study_row_painter.h"

#include <algorithm>

#include <QAbstractItemView>
#include <QPainter>
#include <QTextLayout>

#include "ui/panels/study_list.h"
#include "ui/theme/theme.h"

namespace pellucid::ui {

namespace {

constexpr int gap = 8, thumbnailSide = 48, cardSpace = 4, cornerRadius = 5;
// The tooltip and the details show long warnings in full.
constexpr int maxWarningLines = 4;

QFont bold(QFont font) {
    font.setBold(true);
    return font;
}

int lineHeight(const QFont &font) {
    return QFontMetrics(font).lineSpacing();
}

// The width for text beside a thumbnail.
int textWidth(int cardWidth) {
    return std::max(40, cardWidth - thumbnailSide - 3 * gap);
}

int cardWidth(const QStyleOptionViewItem &option) {
    // The height of a row is requested before it has a width, and kept when a scroll bar appears.
    const auto *const view = qobject_cast<const QAbstractItemView *>(option.widget);
    if (view == nullptr)
        return option.rect.width();
    const int bar = view->style()->pixelMetric(QStyle::PM_ScrollBarExtent, nullptr, view);
    const int indent = view->width() - view->viewport()->width();
    return view->width() - std::max(bar, indent);
}

// Wraps the first warning to a width and counts the others; the details have all of them.
QStringList warningLines(const QFont &font, int width, const QStringList &warnings) {
    QStringList lines;
    if (warnings.isEmpty())
        return lines;
    QString first = warnings.front();
    if (warnings.size() > 1)
        first += " (+" + QString::number(warnings.size() - 1) + ")";
    QTextLayout layout(first, font);
    layout.beginLayout();
    for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine()) {
        line.setLineWidth(width);
        lines << first.mid(line.textStart(), line.textLength()).trimmed();
    }
    layout.endLayout();
    if (lines.size() > maxWarningLines) {
        lines.resize(maxWarningLines);
        lines.back() += QString::fromUtf8("…");
    }
    return lines;
}

} // namespace

StudyRowPainter::StudyRowPainter(const StudyList &list, QObject *parent)
    : QStyledItemDelegate(parent), m_list(list) {}

QSize StudyRowPainter::sizeHint(const QStyleOptionViewItem &option,
                                const QModelIndex &index) const {
    const VolumeFacts *const volume = m_list.volume(index);
    if (volume == nullptr)
        return {0, (m_list.whereText(index).isEmpty() ? 2 : 3) * lineHeight(option.font) + 2 * gap};
    int texts = 3 * lineHeight(option.font);
    texts +=
        int(warningLines(option.font, textWidth(cardWidth(option)), warningTexts(*volume)).size()) *
        lineHeight(option.font);
    return {0, std::max(texts, thumbnailSide) + 2 * gap + cardSpace};
}

void StudyRowPainter::paint(QPainter *painter, const QStyleOptionViewItem &option,
                            const QModelIndex &index) const {
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    if (m_list.volume(index) == nullptr)
        paintStudy(*painter, option, index);
    else
        paintVolume(*painter, option, index);
    painter->restore();
}

void StudyRowPainter::paintStudy(QPainter &painter, const QStyleOptionViewItem &option,
                                 const QModelIndex &index) const {
    const StudyFacts &study = m_list.study(index);
    QRect rect = option.rect.adjusted(2, gap, -2, -gap / 2);
    if (option.state.testFlag(QStyle::State_HasFocus)) {
        painter.setPen(Theme::current().color("muted"));
        painter.drawRoundedRect(QRectF(option.rect).adjusted(0.5, 2.5, -0.5, -0.5), cornerRadius,
                                cornerRadius);
    }
    const QFont name = bold(option.font);
    painter.setFont(name);
    painter.setPen(Theme::current().color("text"));
    painter.drawText(
        rect, Qt::AlignTop | Qt::AlignLeft,
        QFontMetrics(name).elidedText(patientText(study), Qt::ElideRight, rect.width()));
    rect.adjust(0, lineHeight(name), 0, 0);
    painter.setFont(option.font);
    painter.setPen(Theme::current().color("muted"));
    painter.drawText(rect, Qt::AlignTop | Qt::AlignLeft,
                     option.fontMetrics.elidedText(studyText(study), Qt::ElideRight, rect.width()));
    if (const QString where = m_list.whereText(index); !where.isEmpty()) {
        rect.adjust(0, lineHeight(option.font), 0, 0);
        painter.setPen(Theme::current().color("accent"));
        painter.drawText(rect, Qt::AlignTop | Qt::AlignLeft,
                         option.fontMetrics.elidedText(where, Qt::ElideMiddle, rect.width()));
    }
}

void StudyRowPainter::paintVolume(QPainter &painter, const QStyleOptionViewItem &option,
                                  const QModelIndex &index) const {
    const VolumeFacts &volume = *m_list.volume(index);
    const QRectF card = QRectF(option.rect).adjusted(0.5, 0.5, -0.5, -0.5 - cardSpace);
    const bool isOpen = m_list.isOpen(index);
    const bool hasFocus = option.state.testFlag(QStyle::State_HasFocus);
    if (isOpen || hasFocus || option.state.testFlag(QStyle::State_MouseOver)) {
        painter.setBrush(Theme::current().color("raised"));
        painter.setPen(isOpen     ? QPen(Theme::current().color("accent"))
                       : hasFocus ? QPen(Theme::current().color("muted"))
                                  : QPen(Qt::NoPen));
        painter.drawRoundedRect(card, cornerRadius, cornerRadius);
    }
    const QRect frame(option.rect.left() + gap, option.rect.top() + gap, thumbnailSide,
                      thumbnailSide);
    painter.fillRect(frame, QColor(pictureBackground));
    if (const QImage thumbnail = m_list.thumbnail(index); !thumbnail.isNull()) {
        const QSize size = thumbnail.size().scaled(frame.size(), Qt::KeepAspectRatio);
        QRect at(QPoint(), size);
        at.moveCenter(frame.center());
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        painter.drawImage(at, thumbnail);
    }
    const int line = lineHeight(option.font);
    QRect texts(frame.right() + gap + 1, frame.top(), textWidth(option.rect.width()), line);
    const auto draw = [&](const QString &text, const char *role,
                          Qt::TextElideMode elide = Qt::ElideRight) {
        painter.setPen(Theme::current().color(role));
        painter.drawText(texts, Qt::AlignTop | Qt::AlignLeft,
                         option.fontMetrics.elidedText(text, elide, texts.width()));
        texts.translate(0, line);
    };
    // The end of the text distinguishes phases and stacks.
    draw(seriesText(volume), "text", volume.label.empty() ? Qt::ElideRight : Qt::ElideMiddle);
    for (const QString &text : sizeText(volume).split('\n'))
        draw(text, "muted");
    for (const QString &text :
         warningLines(option.font, textWidth(cardWidth(option)), warningTexts(volume)))
        draw(text, "warning");
}

} // namespace pellucid::ui
