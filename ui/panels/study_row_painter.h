// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStyledItemDelegate>

namespace pellucid::ui {

class StudyList;

/// Paints the list of studies: a study as its patient above date and description; a volume as a
/// card with thumbnail, name, size, spacing and geometry warnings.
class StudyRowPainter : public QStyledItemDelegate {
    Q_OBJECT
public:
    StudyRowPainter(const StudyList &list, QObject *parent = nullptr);

    void paint(QPainter *painter, const QStyleOptionViewItem &option,
               const QModelIndex &index) const override;
    QSize sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const override;

private:
    void paintStudy(QPainter &painter, const QStyleOptionViewItem &option,
                    const QModelIndex &index) const;
    void paintVolume(QPainter &painter, const QStyleOptionViewItem &option,
                     const QModelIndex &index) const;

    const StudyList &m_list;
};

} // namespace pellucid::ui
