// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "core/picture/compose.h"
#include "core/picture/tone_subject.h"

namespace pellucid::picture {

/// The brightness of a projection for which the user has set none. It is measured once, from a
/// frame: if it followed the view, the picture would flicker. It is kept while weights change, and
/// for consecutive phases, because their differences in brightness are significant; a scene that is
/// shown again gets its former brightness. It is measured again for other fields, a different
/// number of lights, a different kind of cue, and another volume.
class AutomaticTone {
public:
    /// The next frame sets a new brightness; the current one stays until it arrives.
    bool isWanted() const { return m_isWanted; }
    void retake() { m_isWanted = true; }
    void take(const ToneRange &range);
    /// The scene is shown again with its former brightness, which its next fields (those of a
    /// coarse picture, then the full ones) keep.
    void adopt(const ToneRange &range, const scene::Scene &scene);
    /// The next volume is another phase: brightness and picture stay until its own arrive.
    void hold() { m_isHeld = true; }
    /// The volume is closed; `hasNext`: to be replaced by another. False if the brightness ends
    /// with it.
    bool outlivesVolume(bool hasNext);
    /// The next frame projects different fields, for this scene.
    void beginFields(const scene::Scene &scene);
    /// The next frame is drawn with this cue and these lights.
    void follow(const shading::Shading &drawn);

    const ToneRange &range() const { return m_range; }
    /// The tone with both ends: the user's where set, otherwise the automatic ones.
    scene::Tone completed(scene::Tone tone) const;

private:
    ToneRange m_range;
    bool m_isWanted = true, m_isHeld = false;
    std::optional<ToneSubject> m_adoptedFor;
    /// That of the last frame.
    std::size_t m_lights = 0;
    shading::CueKind m_cue = shading::CueKind::none;
};

} // namespace pellucid::picture
