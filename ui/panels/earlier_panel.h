// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QComboBox;
class QTreeWidget;
class QTreeWidgetItem;

namespace pellucid::ui {

class EarlierStudies;
class PlainLabel;
struct EarlierStudy;

/// The other studies of the patient. A click opens one beside the open study.
class EarlierPanel : public QWidget {
    Q_OBJECT
public:
    explicit EarlierPanel(EarlierStudies &studies, QWidget *parent = nullptr);

signals:
    void besideRequested(const pellucid::ui::EarlierStudy &study);

protected:
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;
    void changeEvent(QEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void list();
    void activate(const QTreeWidgetItem &item);

    EarlierStudies &m_studies;
    QTreeWidget *m_tree;
    PlainLabel *m_state;
    QComboBox *m_inAdvance;
};

} // namespace pellucid::ui
