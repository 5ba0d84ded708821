// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dialogs/angle_dialog.h"

#include <cmath>

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QListWidget>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QVBoxLayout>

#include "core/scene/positioner_angles.h"
#include "ui/document/document.h"
#include "ui/language/names.h"
#include "ui/views/projection_texts.h"
#include "ui/views/projection_view.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

/// An angle with the letters of its side instead of a sign: "LAO 30°". Typing either works.
class AngleBox : public QSpinBox {
public:
    AngleBox(int largest, const char *positive, const char *negative)
        : m_positive(positive), m_negative(negative) {
        setRange(-largest, largest);
        setSuffix("°");
        setKeyboardTracking(false);
        setAlignment(Qt::AlignRight);
    }

protected:
    QString textFromValue(int degrees) const override {
        const QString number = QString::number(std::abs(degrees));
        return degrees == 0 ? number : (degrees > 0 ? m_positive : m_negative) + " " + number;
    }
    int valueFromText(const QString &text) const override {
        // RAO may be typed as r or R, CAU as cau.
        const QString letters = text.trimmed().section(QRegularExpression("[^A-Za-z]"), 0, 0);
        const bool isNegative =
            text.contains('-') ||
            (!letters.isEmpty() && m_negative.startsWith(letters, Qt::CaseInsensitive) &&
             !m_positive.startsWith(letters, Qt::CaseInsensitive));
        return isNegative ? -number(text) : number(text);
    }
    QValidator::State validate(QString &text, int & /*at*/) const override {
        static const QRegularExpression form("^\\s*[A-Za-z]*\\s*-?\\s*\\d{0,3}\\s*°?\\s*$");
        if (!form.match(text).hasMatch() || number(text) > maximum())
            return QValidator::Invalid;
        return text.contains(QRegularExpression("\\d")) ? QValidator::Acceptable
                                                        : QValidator::Intermediate;
    }

private:
    static int number(const QString &text) {
        static const QRegularExpression digits("\\d+");
        return digits.match(text).captured().toInt();
    }
    QString m_positive, m_negative;
};

AngleDialog::AngleDialog(const Document &document, ProjectionView &projection, QWidget *parent)
    : QDialog(parent), m_document(document), m_projection(projection),
      m_primary(new AngleBox(180, "LAO", "RAO")), m_secondary(new AngleBox(90, "CRA", "CAU")),
      m_common(new QListWidget) {
    setObjectName("angleDialog");
    setWindowTitle(tr("C-arm angles"));
    setAttribute(Qt::WA_DeleteOnClose);
    m_primary->setObjectName("primaryAngleBox");
    m_primary->setToolTip(
        tr("Rotation of the detector toward the patient's left (LAO) or right (RAO)"));
    m_secondary->setObjectName("secondaryAngleBox");
    m_secondary->setToolTip(tr("Tilt of the detector toward the head (CRA) or the feet (CAU)"));
    m_common->setObjectName("commonAnglesList");
    m_common->setProperty("role", "plain");
    m_common->setAccessibleName(tr("Common angulations"));
    for (const scene::NamedAngles &named : scene::commonAngles) {
        const QString name = translatedName(named.name), angles = anglesText(named.angles);
        auto *item = new QListWidgetItem(name == angles ? name : tr("%1: %2").arg(name, angles));
        item->setData(Qt::UserRole, named.angles.primaryDeg);
        item->setData(Qt::UserRole + 1, named.angles.secondaryDeg);
        m_common->addItem(item);
    }
    auto *form = new QFormLayout;
    form->addRow(tr("LAO / RAO"), m_primary);
    form->addRow(tr("Cranial / caudal"), m_secondary);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    // Enter takes the angle that was typed; it does not close the dialog.
    buttons->button(QDialogButtonBox::Close)->setAutoDefault(false);
    auto *column = new QVBoxLayout(this);
    column->addLayout(form);
    column->addWidget(new PlainLabel(tr("Common angulations")));
    column->addWidget(m_common, 1);
    column->addWidget(buttons);
    resize(280, 420);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    // The other angle stays as it is, between whole degrees, too.
    connect(m_primary, &QSpinBox::valueChanged, this, [this](int degrees) {
        m_projection.showOrientation(scene::orientationOf({double(degrees), now().secondaryDeg}));
    });
    connect(m_secondary, &QSpinBox::valueChanged, this, [this](int degrees) {
        m_projection.showOrientation(scene::orientationOf({now().primaryDeg, double(degrees)}));
    });
    const auto choose = [this](const QListWidgetItem *item) {
        m_projection.showOrientation(scene::orientationOf(
            {item->data(Qt::UserRole).toDouble(), item->data(Qt::UserRole + 1).toDouble()}));
    };
    connect(m_common, &QListWidget::itemClicked, this, choose);
    connect(m_common, &QListWidget::itemActivated, this, choose);
    document.whenever(Change::pose, this, &AngleDialog::showView);
    showView();
    m_primary->setFocus();
    m_primary->selectAll();
}

AngleDialog::~AngleDialog() {
    // A box that loses the focus with the dialog reports what was typed.
    for (AngleBox *box : {m_primary, m_secondary})
        box->disconnect(this);
}

scene::PositionerAngles AngleDialog::now() const {
    return scene::positionerAngles(m_document.scene().camera.orientation);
}

void AngleDialog::showView() {
    const scene::PositionerAngles angles = now();
    const QSignalBlocker noPrimary(m_primary), noSecondary(m_secondary);
    m_primary->setValue(int(std::lround(angles.primaryDeg)));
    m_secondary->setValue(int(std::lround(angles.secondaryDeg)));
}

} // namespace pellucid::ui
