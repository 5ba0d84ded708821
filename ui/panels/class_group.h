// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include <QWidget>

class QToolButton;

namespace pellucid::ui {

class PlainLabel;

/// The heading of the classes that come from one file of segments: it folds them, and shows or
/// hides them together.
class ClassGroup : public QWidget {
    Q_OBJECT
public:
    ClassGroup(const QString &title, std::filesystem::path path, QWidget *parent);

    const QString &title() const { return m_title; }
    const std::filesystem::path &path() const { return m_path; }
    bool isFolded() const { return m_isFolded; }
    void showCounts(int shownCount, int count);

signals:
    void toggled();
    void folded();

protected:
    void mousePressEvent(QMouseEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    void showFold();

    QString m_title;
    std::filesystem::path m_path;
    bool m_isFolded = false;
    int m_shownCount = 0, m_count = 0;
    QToolButton *m_fold, *m_eye;
    PlainLabel *m_name;
};

} // namespace pellucid::ui
