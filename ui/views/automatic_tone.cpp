// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/automatic_tone.h"

namespace pellucid::ui {

void AutomaticTone::retake() {
    m_isGiven = false;
    m_isWanted = true;
}

void AutomaticTone::take(const render::ToneRange &range) {
    m_range = range;
    m_isWanted = false;
}

void AutomaticTone::adopt(const render::ToneRange &range) {
    take(range);
    m_isGiven = true;
}

bool AutomaticTone::outlivesVolume(bool hasNext) {
    m_isGiven = m_isHeld;
    if (m_isHeld) {
        m_isHeld = !hasNext; // closing the former phase comes before
        return true;
    }
    m_range = {};
    m_isWanted = true;
    return false;
}

void AutomaticTone::beginFields() {
    m_isWanted = m_isWanted || !m_isGiven;
}

void AutomaticTone::follow(const classify::Look &look, const shading::Shading &shading,
                           const shading::Shading &drawn) {
    // Another number of lights or kind of cue has a brightness of its own; what the hand drags
    // keeps it.
    if (shading.lights.size() != drawn.lights.size() || shading.cue.kind != drawn.cue.kind)
        m_isWanted = true;
    if (look != m_look)
        m_isGiven = false;
    m_look = look;
}

render::Tone AutomaticTone::completed(render::Tone tone) const {
    tone.low = tone.low.value_or(m_range.low);
    tone.high = tone.high.value_or(m_range.high);
    return tone;
}

} // namespace pellucid::ui
