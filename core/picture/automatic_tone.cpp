// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/automatic_tone.h"

namespace pellucid::picture {

void AutomaticTone::take(const ToneRange &range) {
    m_range = range;
    m_isWanted = false;
    m_adoptedFor.reset();
}

void AutomaticTone::adopt(const ToneRange &range, const scene::Scene &scene) {
    take(range);
    m_adoptedFor.emplace(scene);
    m_lights = m_adoptedFor->lights;
    m_cue = m_adoptedFor->cue;
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

void AutomaticTone::follow(const shading::Shading &drawn) {
    // Strengths, which the user drags, keep the brightness.
    m_isWanted = m_isWanted || drawn.lights.size() != m_lights || drawn.cue.kind != m_cue;
    m_lights = drawn.lights.size();
    m_cue = drawn.cue.kind;
}

scene::Tone AutomaticTone::completed(scene::Tone tone) const {
    tone.low = tone.low.value_or(m_range.low);
    tone.high = tone.high.value_or(m_range.high);
    return tone;
}

} // namespace pellucid::picture
