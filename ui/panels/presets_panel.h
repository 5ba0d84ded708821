// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/presets/preset_library.h"
#include "core/task/reason.h"

class QLabel;
class QLineEdit;
class QListWidget;
class QListWidgetItem;
class QPushButton;

namespace pellucid::ui {

class Document;

/// The presets that suit the open study, each with a small picture of it; choosing one shows the
/// study through it, and the look that is shown is kept by two clicks.
class PresetsPanel : public QWidget {
    Q_OBJECT
public:
    explicit PresetsPanel(Document &document, QWidget *parent = nullptr);

    /// Stands beside the panel's heading.
    QWidget *corner();
    void setPicture(const QString &preset, const QImage &picture);
    /// Asks for the name that the shown look is to be kept under.
    void askForName();
    void importPreset();
    void exportPreset();
    const presets::PresetLibrary &library() const { return m_library; }

signals:
    /// The presets that are listed; pictures are wanted of them.
    void presetsListed(const std::vector<pellucid::presets::Preset> &presets);
    /// The name of the preset that is shown, or that it is one's own.
    void lookNamed(const QString &name);
    void failed(const pellucid::task::Reason &what, const QString &path);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void list();
    QListWidgetItem *itemOf(const QString &preset) const;
    void showCurrent();
    void apply(QListWidgetItem *item);
    void saveLook();
    void remove(const QString &name);
    void showMenu(const QPoint &at);
    /// Runs it and reports what it throws.
    template <class F> void attempt(const F &what);
    bool suits(const presets::Preset &preset) const;

    Document &m_document;
    presets::PresetLibrary m_library;
    QPushButton *m_save;
    QListWidget *m_gallery;
    QLineEdit *m_name;
    QWidget *m_nameRow;
    QLabel *m_said;
};

} // namespace pellucid::ui
