-- SPDX-License-Identifier: GPL-3.0-or-later
-- Renders each series that arrives in Orthanc by a recipe of Pellucid, and stores the pictures in
-- Orthanc again. In Orthanc's configuration:
--
--   "LuaScripts": ["/etc/orthanc/pellucid.lua"],
--   "Pellucid": {
--     "Recipe": "/etc/orthanc/recipe.json",
--     "Server": "orthanc",               the name of Orthanc in 'pellucid-cli server list'
--     "Modalities": ["CT", "MR", "PT"],  which series; default: these
--     "Program": "pellucid-cli"          default: this
--   }

-- Orthanc waits for the events of a script: this goes on in the background.
local work = [[
# A program that outlives Orthanc would keep its port.
for each in /proc/$$/fd/*; do
    fd=${each##*/}
    if [ "$fd" -gt 2 ] && [ "$fd" -ne 255 ]; then eval "exec $fd>&-"; fi
done
if [ ! -r "$2" ]; then echo "$2 cannot be read" >&2; exit 3; fi
# One series at a time: the recipe is the lock.
exec flock "$2" "$1" batch "$2" --from "$3" --find "study=$4" "series=$5" --send "$3" </dev/null
]]

local function quoted(text)
    return "'" .. string.gsub(text, "'", "'\\''") .. "'"
end

-- A file may contain anything as its UID.
local function isUid(text)
    return type(text) == 'string' and #text <= 64 and string.match(text, '^[0-9.]+$') ~= nil
end

-- Never OT, which the pictures are: each would be rendered in turn.
local function isRendered(modality, modalities)
    for _, one in ipairs(modalities) do
        if modality == one and modality ~= 'OT' then
            return true
        end
    end
    return false
end

local earlier = OnStableSeries -- of another script

function OnStableSeries(seriesId, tags, metadata)
    if earlier then
        earlier(seriesId, tags, metadata)
    end
    local settings = GetOrthancConfiguration()['Pellucid']
    if not settings or not settings['Recipe'] or not settings['Server'] then
        print('pellucid.lua: the configuration lacks "Pellucid" with "Recipe" and "Server"')
        return
    end
    if not isRendered(tags['Modality'], settings['Modalities'] or {'CT', 'MR', 'PT'}) then
        return
    end
    local study = ParseJson(RestApiGet('/series/' .. seriesId .. '/study'))
    local studyUid, seriesUid = study['MainDicomTags']['StudyInstanceUID'], tags['SeriesInstanceUID']
    if not isUid(studyUid) or not isUid(seriesUid) then
        print('pellucid.lua: the series ' .. seriesId .. ' has no valid UID')
        return
    end
    local command = 'bash -c ' .. quoted(work) .. ' pellucid.lua'
    for _, argument in ipairs({settings['Program'] or 'pellucid-cli', settings['Recipe'],
                               settings['Server'], studyUid, seriesUid}) do
        command = command .. ' ' .. quoted(argument)
    end
    os.execute(command .. ' &')
end
