-- SPDX-License-Identifier: GPL-3.0-or-later
-- Renders each series that arrives in Orthanc by a recipe of Pellucid, and stores the pictures in
-- Orthanc again. In Orthanc's configuration:
--
--   "LuaScripts": ["/etc/orthanc/pellucid.lua"],
--   "Pellucid": {
--     "Recipe": "/etc/orthanc/recipe.json",
--     "Server": "orthanc",               the name of Orthanc in 'pellucid-cli server list'
--     "Queue": "/var/lib/orthanc/pellucid",  the folder of series that wait; of no other user
--     "Modalities": ["CT", "MR", "PT"],  which series; default: these
--     "Program": "pellucid-cli"          default: this
--   }

-- Orthanc waits for the events of a script: this goes on in the background. Each series that waits
-- is an empty file, STUDY_SERIES: however many arrive, one process works, and none is lost if it ends.
local work = [[
# A program that outlives Orthanc would keep its port.
for each in /proc/$$/fd/*; do
    fd=${each##*/}
    if [ "$fd" -gt 2 ] && [ "$fd" -ne 255 ]; then eval "exec $fd>&-"; fi
done
program=$1 recipe=$2 server=$3 queue=$4
mkdir -p -m 700 "$queue" && : >"$queue/$5" || exit 1
# Who finds another one at work leaves the series to it; who ends looks once more.
while [ -n "$(ls "$queue")" ]; do
    exec 9<"$queue"
    flock -n 9 || exit 0
    if [ ! -r "$recipe" ]; then echo "$recipe cannot be read" >&2; exit 3; fi
    while next=$(ls -tr "$queue" | head -n 1) && [ -n "$next" ]; do
        # A series that arrives again meanwhile is another file.
        series=${next#begun-}
        [ "$next" = "begun-$series" ] || mv "$queue/$next" "$queue/begun-$series" || exit 1
        "$program" batch "$recipe" --from "$server" --find "study=${series%_*}" "series=${series#*_}" \
            --send "$server" </dev/null
        # The server cannot be reached, or the program cannot be run: the next series tries again.
        case $? in 6 | 126 | 127) exit 1 ;; esac
        rm "$queue/begun-$series" || exit 1
    done
    exec 9<&-
done
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
    if not settings or not settings['Recipe'] or not settings['Server'] or not settings['Queue'] then
        print('pellucid.lua: the configuration lacks "Pellucid" with "Recipe", "Server" and "Queue"')
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
                               settings['Server'], settings['Queue'], studyUid .. '_' .. seriesUid}) do
        command = command .. ' ' .. quoted(argument)
    end
    os.execute(command .. ' &')
end
