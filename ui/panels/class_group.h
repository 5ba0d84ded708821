// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLabel;
class QToolButton;

namespace pellucid::ui {

/// The heading of the classes that come from one file of segments: it folds them, and shows or
/// hides them together.
class ClassGroup : public QWidget {
    Q_OBJECT
public:
    explicit ClassGroup(const QString &title, QWidget *parent = nullptr);

    const QString &title() const { return m_title; }
    bool isFolded() const { return m_isFolded; }
    void show(int shownCount, int count);

signals:
    void toggled(const QString &title);
    void folded();

protected:
    void mousePressEvent(QMouseEvent *event) override;

private:
    void showFold();

    QString m_title;
    bool m_isFolded = false;
    QToolButton *m_fold, *m_eye;
    QLabel *m_name;
};

} // namespace pellucid::ui
