// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QWidget>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;

namespace pellucid::ui {

class Document;
class PlainLabel;
struct RegionOptions;

/// The options of the tool that marks regions, above the panes while such a tool is chosen.
class RegionBar : public QWidget {
    Q_OBJECT
public:
    explicit RegionBar(Document &document, QWidget *parent = nullptr);

private:
    void showMarking();
    void showClasses();
    void change(const std::function<void(RegionOptions &)> &edit);
    QDoubleSpinBox *makeNumber(const char *name, const QString &text, const QString &tip,
                               double low, double high, double RegionOptions::*number);

    Document &m_document;
    QComboBox *m_use, *m_where;
    PlainLabel *m_text, *m_found;
    QCheckBox *m_erases, *m_isBone;
    QDoubleSpinBox *m_leak, *m_ball, *m_slab;
};

} // namespace pellucid::ui
