// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/presets/preset_library.h"

#include <algorithm>
#include <functional>
#include <system_error>

#include <fmt/format.h>

#include "core/files/reasons.h"
#include "core/files/user_folders.h"
#include "core/presets/built_in.h"
#include "core/presets/reasons.h"
#include "core/system/text.h"
#include "core/task/error.h"

namespace pellucid::presets {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

} // namespace

std::string fileNameOf(const std::string &presetName) {
    std::string name;
    for (const char c : presetName) {
        const auto byte = static_cast<unsigned char>(c);
        const bool safe = std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 128;
        name += safe ? c : '_';
    }
    // Names that differ only in unsafe characters must not share a file.
    if (name != presetName)
        name += fmt::format("-{:08x}", std::uint32_t(std::hash<std::string>()(presetName)));
    return name + ".json";
}

PresetLibrary::PresetLibrary(fs::path userFolder) : m_folder(std::move(userFolder)) {
    for (const BuiltInFile &file : builtInFiles())
        m_entries.push_back({presetFromJson(file.text), {}});
    readUserFolder();
}

PresetLibrary PresetLibrary::ofUser() {
    const auto data = files::userDataFolder();
    return PresetLibrary(data ? *data / "presets" : fs::path());
}

void PresetLibrary::readUserFolder() {
    const auto builtInCount = std::ptrdiff_t(builtInFiles().size());
    m_entries.erase(m_entries.begin() + builtInCount, m_entries.end());
    m_skipped.clear();
    if (m_folder.empty())
        return;
    std::vector<fs::path> files;
    std::error_code failed;
    for (fs::directory_iterator it(m_folder, failed), end; !failed && it != end;
         it.increment(failed))
        // A name with a leading dot belongs to an unfinished file.
        if (it->path().extension() == ".json" && it->path().filename().string()[0] != '.')
            files.push_back(it->path());
    std::sort(files.begin(), files.end());
    for (const fs::path &path : files) {
        try {
            Preset preset = readPreset(path);
            if (find(preset.name) != nullptr)
                m_skipped.push_back({path, because::presetNameIsTaken(preset.name)});
            else
                m_entries.push_back({std::move(preset), path});
        } catch (const Error &error) {
            m_skipped.push_back({path, error.reason()});
        }
    }
    std::sort(m_entries.begin() + builtInCount, m_entries.end(), [](const auto &a, const auto &b) {
        return system::lowered(a.preset.name) < system::lowered(b.preset.name);
    });
}

const PresetEntry *PresetLibrary::find(const std::string &name) const {
    const auto found = std::find_if(m_entries.begin(), m_entries.end(), [&](const PresetEntry &e) {
        return system::lowered(e.preset.name) == system::lowered(name);
    });
    return found == m_entries.end() ? nullptr : &*found;
}

const PresetEntry &PresetLibrary::get(const std::string &name) const {
    if (const PresetEntry *found = find(name))
        return *found;
    std::string close;
    for (const PresetEntry &entry : m_entries)
        if (system::lowered(entry.preset.name).find(system::lowered(name)) != std::string::npos)
            close += (close.empty() ? "" : ", ") + entry.preset.name;
    throw Error(ErrorCode::usage,
                close.empty() ? because::noPreset(name) : because::noPresetBut(name, close));
}

void PresetLibrary::save(const Preset &preset) {
    if (m_folder.empty())
        throw Error(ErrorCode::output, because::noPresetFolder);
    const PresetEntry *const former = find(preset.name);
    if (former != nullptr && former->isBuiltIn())
        throw Error(ErrorCode::usage, because::builtInPresetNeedsAnotherName(former->preset.name));
    // A malformed preset would be lost at the next start.
    try {
        presetFromJson(toJson(preset));
    } catch (const Error &error) {
        // The line number of a text that nobody sees is useless.
        const task::Reason &reason = error.reason();
        throw Error(ErrorCode::usage,
                    because::presetCannotBeKept(reason.is(because::atLine) ? reason.arguments()[1]
                                                                           : reason));
    }
    std::error_code failed;
    fs::create_directories(m_folder, failed);
    if (failed)
        throw Error(ErrorCode::output, because::cannotBeMade(task::systemReason(failed)), m_folder);
    fs::path path = former != nullptr ? former->path : m_folder / fileNameOf(preset.name);
    // Does not overwrite a file of that name that is not this preset.
    for (int n = 2; former == nullptr && fs::exists(path, failed); ++n)
        path = m_folder / fileNameOf(fmt::format("{} {}", preset.name, n));
    writePreset(path, preset);
    readUserFolder();
}

void PresetLibrary::remove(const std::string &name) {
    const PresetEntry &entry = get(name);
    if (entry.isBuiltIn())
        throw Error(ErrorCode::usage, because::builtInPresetStays(entry.preset.name));
    std::error_code failed;
    fs::remove(entry.path, failed);
    if (failed)
        throw Error(ErrorCode::output, because::cannotBeRemoved(task::systemReason(failed)),
                    entry.path);
    readUserFolder();
}

} // namespace pellucid::presets
