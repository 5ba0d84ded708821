// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/presets/preset.h"
#include "core/task/reason.h"

namespace pellucid::presets {

/// A preset and where it is kept.
struct PresetEntry {
    Preset preset;
    std::filesystem::path path; ///< empty: built in
    bool isBuiltIn() const { return path.empty(); }
};

/// A file of the user's folder that is no preset.
struct SkippedPreset {
    std::filesystem::path path;
    task::Reason reason;
};

/// The presets that come with the program, which stay as they are, and the user's own, a file each.
class PresetLibrary {
public:
    /// What cannot be read is skipped; a folder that is not there is an empty one.
    explicit PresetLibrary(std::filesystem::path userFolder);
    /// Of the user's data folder; without one, of built-in presets only.
    static PresetLibrary ofUser();

    /// Built-in ones first, then the user's by name.
    const std::vector<PresetEntry> &entries() const { return m_entries; }
    const std::vector<SkippedPreset> &skipped() const { return m_skipped; }
    /// By name, whatever its case; nullptr if there is none.
    const PresetEntry *find(const std::string &name) const;
    /// *Throws* Error{usage} naming the closest ones.
    const PresetEntry &get(const std::string &name) const;

    /// Keeps a preset, in place of the user's one of that name. *Throws* Error{usage} for the name
    /// of a built-in one, Error{output}; the former file is then untouched.
    void save(const Preset &preset);
    /// *Throws* Error{usage} for a built-in one, Error{output}.
    void remove(const std::string &name);

private:
    void read();
    std::filesystem::path m_folder;
    std::vector<PresetEntry> m_entries;
    std::vector<SkippedPreset> m_skipped;
};

/// A file's name for a preset's: letters, digits and what else is safe everywhere.
std::string fileNameOf(const std::string &presetName);

} // namespace pellucid::presets
