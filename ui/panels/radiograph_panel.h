// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QWidget>

#include "ui/document/commands.h"

class QCheckBox;
class QPushButton;

namespace pellucid::ui {

class Document;
class PlainLabel;
class ValueSlider;

/// How the projection is shown as a radiograph: detail and latitude of its multi-scale contrast,
/// sharpness, and whether the couch is left out.
class RadiographPanel : public QWidget {
    Q_OBJECT
public:
    explicit RadiographPanel(Document &document, QWidget *parent = nullptr);

    /// The controls beside the panel's heading: the couch, and a button that makes detail and
    /// latitude automatic.
    QWidget *corner();

private:
    using Share = std::optional<double> scene::Tone::*;
    void addRow(const QString &name, const QString &tip, ValueSlider *slider,
                PlainLabel *mark = nullptr);
    void connectShare(ValueSlider *slider, const QString &name, Share share);
    void set(const QString &what, DragId drag, Share share, const std::optional<double> &value);
    void showScene();

    Document &m_document;
    ValueSlider *m_detail, *m_latitude, *m_sharpness;
    PlainLabel *m_detailMark, *m_latitudeMark;
    QWidget *m_corner;
    QCheckBox *m_withoutCouch;
    QPushButton *m_automatic;
};

} // namespace pellucid::ui
