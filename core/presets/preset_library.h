// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/presets/preset.h"
#include "core/task/reason.h"

namespace pellucid::presets {

/// A preset and its location.
struct PresetEntry {
    Preset preset;
    std::filesystem::path path; ///< empty: built in
    bool isBuiltIn() const { return path.empty(); }
};

/// A file in the user's folder that is not a preset.
struct SkippedPreset {
    std::filesystem::path path;
    task::Reason reason;
};

/// The read-only presets that come with the program, and the user's own, one file each.
class PresetLibrary {
public:
    /// Unreadable files are skipped; a missing folder counts as empty.
    explicit PresetLibrary(std::filesystem::path userFolder);
    /// That of the user's data folder, or only built-in presets if there is none.
    static PresetLibrary ofUser();

    /// Built-in ones first, then the user's by name.
    const std::vector<PresetEntry> &entries() const { return m_entries; }
    const std::vector<SkippedPreset> &skipped() const { return m_skipped; }
    /// Finds a preset by name, ignoring case; nullptr if there is none.
    const PresetEntry *find(const std::string &name) const;
    /// *Throws* Error{usage} listing the closest names.
    const PresetEntry &get(const std::string &name) const;

    /// Saves a preset, replacing the user's one of that name. *Throws* Error{usage} for the name of
    /// a built-in one; Error{output}, and the old file is then unchanged.
    void save(const Preset &preset);
    /// *Throws* Error{usage} for a built-in one, Error{output}.
    void remove(const std::string &name);

private:
    /// Reads the user's presets again; the built-in ones stay.
    void readUserFolder();
    std::filesystem::path m_folder;
    std::vector<PresetEntry> m_entries;
    std::vector<SkippedPreset> m_skipped;
};

/// A file name for a preset's name: letters, digits and other characters that are safe everywhere.
std::string fileNameOf(const std::string &presetName);

} // namespace pellucid::presets
