// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/automatic_tone.h"

namespace pellucid::picture {

void AutomaticTone::take(const scene::Exposure &exposure) {
    m_exposure = exposure;
    m_isWanted = false;
    m_adoptedFor.reset();
}

void AutomaticTone::adopt(const scene::Exposure &exposure, const scene::Scene &scene) {
    take(exposure);
    m_adoptedFor.emplace(scene);
    m_lights = m_adoptedFor->lights;
    m_cue = m_adoptedFor->cue;
    m_image = scene.image;
    m_detail = scene.tone.detail;
    m_latitude = scene.tone.latitude;
}

bool AutomaticTone::outlivesVolume(bool hasNext) {
    if (m_isHeld) {
        m_isHeld = !hasNext; // the previous phase is closed first
        return true;
    }
    *this = {};
    return false;
}

void AutomaticTone::beginFields(const scene::Scene &scene) {
    m_isWanted = m_isWanted || m_adoptedFor != ToneSubject(scene);
}

void AutomaticTone::follow(const shading::Shading &drawn, const scene::Scene &scene) {
    const scene::Tone &tone = scene.tone;
    // Strengths, which the user drags, keep the exposure.
    m_isWanted = m_isWanted || drawn.lights.size() != m_lights || drawn.cue.kind != m_cue ||
                 tone.detail != m_detail || tone.latitude != m_latitude ||
                 scene.image.detail != m_image.detail || scene.image.detailMm != m_image.detailMm;
    m_image = scene.image;
    m_lights = drawn.lights.size();
    m_cue = drawn.cue.kind;
    m_detail = tone.detail;
    m_latitude = tone.latitude;
}

scene::Tone AutomaticTone::completed(scene::Tone tone) const {
    tone.exposure = m_exposure;
    return tone;
}

} // namespace pellucid::picture
