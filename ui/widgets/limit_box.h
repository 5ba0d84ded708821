// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDoubleSpinBox>

namespace pellucid::ui {

/// A number box that shows "no limit" for a number that no value is beyond. A number that the user
/// does not edit keeps its full precision.
class LimitBox : public QDoubleSpinBox {
    Q_OBJECT
public:
    /// `scale`: a typical range of the values; the decimals resolve a thousandth of it.
    LimitBox(const char *name, double low, double high, double scale, QWidget *parent = nullptr);

    void setNumber(double value);
    /// The value as typed, or as given if it was not edited.
    double exact() const;

    /// From "no limit" to zero first.
    void stepBy(int steps) override;

protected:
    QString textFromValue(double value) const override;
    double valueFromText(const QString &text) const override;
    QValidator::State validate(QString &text, int &at) const override;

private:
    bool isNoLimit(double value) const;
    static QString noLimit();
    double m_given = 0.0, m_shown = 0.0;
};

} // namespace pellucid::ui
