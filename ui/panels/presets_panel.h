// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/presets/preset_library.h"
#include "core/task/reason.h"

class QLineEdit;
class QListWidget;
class QListWidgetItem;
class QPushButton;

namespace pellucid::ui {

class Document;
class PlainLabel;

/// The presets that suit the open study, each with a small picture of it. A click applies a preset;
/// two clicks save the current look as one.
class PresetsPanel : public QWidget {
    Q_OBJECT
public:
    explicit PresetsPanel(Document &document, QWidget *parent = nullptr);

    /// The buttons beside the panel's heading.
    QWidget *corner();
    void setPicture(const QString &preset, const QImage &picture);
    /// Asks for a name under which to save the current look.
    void askForName();
    void importPreset();
    void exportPreset();
    const presets::PresetLibrary &library() const { return m_library; }

signals:
    /// The presets in the list, which need pictures.
    void presetsListed(const std::vector<pellucid::presets::Preset> &presets);
    /// The name of the current preset, or text for a look that is not a preset.
    void lookNamed(const QString &name);
    void failed(const pellucid::task::Reason &what, const QString &path);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void connectControls();
    void list();
    QListWidgetItem *itemOf(const QString &preset) const;
    void showCurrent();
    void apply(QListWidgetItem *item);
    void saveLook();
    class Removal;
    void askToRemove(const QString &name);
    void showMenu(const QPoint &at);
    /// Runs `what` and reports a task::Error that it throws.
    template <class F> void attempt(const F &what);
    bool suits(const presets::Preset &preset) const;
    /// Whether it is listed: the built-in ones only for studies of their region.
    bool isOffered(const presets::PresetEntry &entry) const;

    Document &m_document;
    presets::PresetLibrary m_library;
    QWidget *m_corner;
    QPushButton *m_listsAll, *m_save;
    QListWidget *m_gallery;
    QLineEdit *m_name;
    QPushButton *m_confirm;
    QWidget *m_nameRow;
    PlainLabel *m_message, *m_empty;
    QString m_chosen; ///< the preset that was chosen or saved last
};

} // namespace pellucid::ui
