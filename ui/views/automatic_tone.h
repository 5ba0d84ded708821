// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/look.h"
#include "core/render/compose.h"
#include "core/shading/shading.h"

namespace pellucid::ui {

/// The brightness of a projection where the user has fixed none. It is taken once, from a frame:
/// one that followed the view would flicker. Weights that move and phases that follow each other
/// keep it, because their brightness is what is to be seen; another field, light or volume has one
/// of its own.
class AutomaticTone {
public:
    /// The next frame tells the brightness anew; what is shown keeps its own till then.
    bool isWanted() const { return m_isWanted; }
    void retake();
    void take(const render::ToneRange &range);
    /// That of the same look at another time: the fields that come keep it.
    void adopt(const render::ToneRange &range);
    /// The next volume is another phase, which keeps the brightness.
    void hold() { m_isHeld = true; }
    /// The volume changes; `hasNext`: to another one. False: the brightness goes with it.
    bool outlivesVolume(bool hasNext);
    /// Other fields are projected.
    void beginFields();
    /// The scene is another; `drawn`: how the last frame was lit.
    void follow(const classify::Look &look, const shading::Shading &shading,
                const shading::Shading &drawn);

    const render::ToneRange &range() const { return m_range; }
    /// With both ends: those that the user fixed, and for the rest the brightness that was taken.
    render::Tone completed(render::Tone tone) const;

private:
    render::ToneRange m_range;
    bool m_isWanted = true;
    bool m_isHeld = false;
    bool m_isGiven = false; ///< and not taken from the fields that are shown
    classify::Look m_look;  ///< that it is given for
};

} // namespace pellucid::ui
