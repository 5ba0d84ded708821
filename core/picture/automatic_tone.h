// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "core/picture/tone_subject.h"

namespace pellucid::picture {

/// When the exposure of a study is measured, see scene::Exposure. It is kept while weights change,
/// and for consecutive phases, because their differences in brightness are significant; a scene
/// that is shown again keeps its former exposure. It is measured again for other fields, a
/// different number of lights, a different kind of cue, other contrast, and another volume.
class AutomaticTone {
public:
    /// The next frame brings a new exposure; the current one stays until it arrives.
    bool isWanted() const { return m_isWanted; }
    void retake() { m_isWanted = true; }
    void take(const scene::Exposure &exposure);
    /// The scene is shown again with its former exposure, which its next fields (those of a coarse
    /// picture, then the full ones) keep.
    void adopt(const scene::Exposure &exposure, const scene::Scene &scene);
    /// The next volume is another phase: exposure and picture stay until its own arrive.
    void hold() { m_isHeld = true; }
    /// The volume is closed; `hasNext`: to be replaced by another. False if the exposure ends
    /// with it.
    bool outlivesVolume(bool hasNext);
    /// The next frame projects different fields, for this scene.
    void beginFields(const scene::Scene &scene);
    /// The next frame is drawn with this cue and these lights, and shown with the
    /// contrast of this scene.
    void follow(const shading::Shading &drawn, const scene::Scene &scene);

    const scene::Exposure &exposure() const { return m_exposure; }
    /// The tone with the exposure.
    scene::Tone completed(scene::Tone tone) const;

private:
    scene::Exposure m_exposure;
    bool m_isWanted = true, m_isHeld = false;
    std::optional<ToneSubject> m_adoptedFor;
    /// That of the last frame.
    std::size_t m_lights = 0;
    shading::CueKind m_cue = shading::CueKind::none;
    std::optional<double> m_detail, m_latitude;
    scene::ImageDefinition m_image;
};

} // namespace pellucid::picture
