// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "core/picture/compose.h"
#include "core/picture/tone_subject.h"

namespace pellucid::picture {

/// The brightness of a projection where the user has fixed none. It is taken once, from a frame:
/// one that followed the view would flicker. Weights that move keep it, and so do phases that
/// follow each other, because their brightness is what is to be seen; what is seen again has the
/// one that it had. Other fields, another number of lights, another kind of cue and another volume
/// have one of their own.
class AutomaticTone {
public:
    /// The next frame sets a new brightness; the current one stays until it arrives.
    bool isWanted() const { return m_isWanted; }
    void retake() { m_isWanted = true; }
    void take(const ToneRange &range);
    /// The scene is seen again, with the brightness that it had: the fields that come for it, a
    /// coarse picture's and then the full ones, keep it.
    void adopt(const ToneRange &range, const scene::Scene &scene);
    /// The next volume is another phase: brightness and picture stay until its own are there.
    void hold() { m_isHeld = true; }
    /// The volume changes; `hasNext`: to another one. False: the brightness goes with it.
    bool outlivesVolume(bool hasNext);
    /// Fields other than those of the last frame are projected, for a scene.
    void beginFields(const scene::Scene &scene);
    /// The next frame is drawn with cue and lights like these.
    void follow(const shading::Shading &drawn);

    const ToneRange &range() const { return m_range; }
    /// With both ends: those that the user fixed, and for the rest the brightness that was taken.
    scene::Tone completed(scene::Tone tone) const;

private:
    ToneRange m_range;
    bool m_isWanted = true, m_isHeld = false;
    std::optional<ToneSubject> m_adoptedFor;
    /// Of the last frame.
    std::size_t m_lights = 0;
    shading::CueKind m_cue = shading::CueKind::none;
};

} // namespace pellucid::picture
