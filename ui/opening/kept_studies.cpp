// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/opening/kept_studies.h"

#include <algorithm>

namespace pellucid::ui {

std::size_t KeptStudy::bytes() const {
    return opened.volume.bytes() + (engine ? engine->bytes : 0) +
           (view.segments ? view.segments->bytes() : 0);
}

void KeptStudies::keep(KeptStudy study) {
    take(study.source);
    m_studies.push_front(std::move(study));
}

std::optional<KeptStudy> KeptStudies::take(int source) {
    const auto found = std::find_if(m_studies.begin(), m_studies.end(),
                                    [&](const KeptStudy &s) { return s.source == source; });
    if (found == m_studies.end())
        return std::nullopt;
    KeptStudy study = std::move(*found);
    m_studies.erase(found);
    return study;
}

std::size_t KeptStudies::bytes() const {
    std::size_t sum = 0;
    for (const KeptStudy &study : m_studies)
        sum += study.bytes();
    return sum;
}

bool KeptStudies::isReady(int source) const {
    return std::any_of(m_studies.begin(), m_studies.end(), [&](const KeptStudy &study) {
        return study.source == source && study.engine;
    });
}

void KeptStudies::trim(std::size_t budgetBytes) {
    for (auto study = m_studies.rbegin(); study != m_studies.rend() && bytes() > budgetBytes;
         ++study) {
        study->engine.reset();
        study->preparedFor.reset();
    }
    while (!m_studies.empty() && bytes() > budgetBytes)
        m_studies.pop_back();
}

} // namespace pellucid::ui
