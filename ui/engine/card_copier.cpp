// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/card_copier.h"

#include <algorithm>
#include <new>
#include <utility>

#include "ui/document/document.h"
#include "ui/engine/graphics_card.h"
#include "ui/jobs/job_runner.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;

constexpr std::size_t maxCopies = 2;

bool isHeld(const gpu::GpuEngine &copy, const render::EngineParts &parts) {
    const render::EngineSpectra &spectra = copy.textures().spectra();
    return spectra.fields == parts.spectra.fields &&
           (parts.spectra.gradients.empty() || spectra.gradients == parts.spectra.gradients);
}

} // namespace

struct CardCopier::Copied {
    std::shared_ptr<gpu::GpuEngine> engine;
    std::optional<task::Reason> refusal{}; ///< if there is no engine
    bool isLost = false;
};

CardCopier::Copied CardCopier::copyTo(const std::shared_ptr<gpu::FramePasses> &passes,
                                      const render::ProjectionEngine &engine,
                                      const task::Progress &progress) {
    try {
        return {gpu::copyToCard(passes, engine, progress)};
    } catch (const task::Error &error) {
        return {nullptr, error.reason(), error.code() == task::ErrorCode::noSuchDevice};
    } catch (const std::bad_alloc &) {
        return {nullptr, because::noMemoryToCopyToCard};
    }
}

CardCopier::CardCopier(Document &document, JobRunner &jobs, GraphicsCard &card, QObject *parent)
    : QObject(parent), m_document(document), m_jobs(jobs), m_card(card) {
    document.whenever(Change::volume, this, [this] {
        if (!m_document.isPreview())
            forget();
    });
    connect(&card, &GraphicsCard::changed, this, &CardCopier::cardChanged);
    connect(
        &jobs, &JobRunner::finished, this,
        [this] {
            if (m_copying == Copying::wasCancelled) {
                m_copying = Copying::no;
                // Unless another job replaced it, the user cancelled the copy.
                if (!m_jobs.isRunning())
                    giveUp(because::copyWasCancelled);
            }
            copyWhenIdle();
        },
        // The code that ended the job may be about to start the next.
        Qt::QueuedConnection);
}

CardCopier::~CardCopier() {
    if (m_copying == Copying::underway)
        m_jobs.cancel();
}

void CardCopier::forget() {
    m_current.reset();
    m_copies.clear();
    m_isGivenUp = false;
}

void CardCopier::cardChanged() {
    m_copies.clear();
    m_isGivenUp = false;
    // A copy to the former card is useless.
    if (std::exchange(m_copying, Copying::no) == Copying::underway)
        m_jobs.cancel();
    if (!m_current)
        return;
    announceAgain();
    copyWhenIdle();
}

void CardCopier::show(const prepare::PreparedEngine &engine, EngineStage stage) {
    m_current = Current{engine, stage};
    m_isGivenUp = false;
    announce(stage);
    copyWhenIdle();
}

std::shared_ptr<gpu::GpuEngine> CardCopier::copyOf(const render::EngineParts &parts) {
    const auto held = std::find_if(m_copies.begin(), m_copies.end(),
                                   [&](const auto &copy) { return isHeld(*copy, parts); });
    if (held == m_copies.end())
        return nullptr;
    if (parts.spectra.gradients.empty() && (*held)->textures().canBeLit())
        *held = (*held)->withoutLight();
    return (*held)->withChannelWeights(parts.channelWeights);
}

void CardCopier::announceAgain() {
    announce(m_current->stage == EngineStage::full ? EngineStage::settled : m_current->stage);
}

void CardCopier::announce(EngineStage stage) {
    const prepare::PreparedEngine &engine = m_current->engine;
    ShownEngine shown{engine, copyOf(engine.engine->parts()), m_card.reason()};
    if (!shown.onCard && m_card.passes())
        shown.reason = m_isGivenUp                    ? m_reason
                       : stage == EngineStage::coarse ? task::Reason(because::firstCoarsePicture)
                                                      : task::Reason(because::notOnCardYet);
    emit engineReady(shown, stage);
}

void CardCopier::copyWhenIdle() {
    // The coarse engine is replaced before it could be copied.
    if (!m_current || m_current->stage == EngineStage::coarse || !m_card.passes() || m_isGivenUp ||
        m_jobs.isRunning() || copyOf(m_current->engine.engine->parts()))
        return;
    // Older copies are dropped before the card runs out of memory. A look and its layers stay.
    m_copies.resize(std::min(m_copies.size(), maxCopies - 1));
    const auto engine = m_current->engine.engine;
    m_copying = Copying::underway;
    m_jobs.start(
        tr("Copying to the graphics card"),
        [this, engine, passes = m_card.passes()](const Job &job) {
            const Copied copied = copyTo(passes, *engine, job.progress());
            job.deliver([this, engine, passes, copied] { take(copied, engine, passes); });
        },
        [this](const Outcome &outcome) { copyEnded(outcome); });
}

void CardCopier::copyEnded(const Outcome &outcome) {
    if (m_copying != Copying::underway) // the copy was delivered, or the card changed
        return;
    const bool hasFailed = outcome.kind == Outcome::Kind::failed;
    m_copying = hasFailed ? Copying::no : Copying::wasCancelled;
    if (hasFailed)
        giveUp(*outcome.reason);
}

void CardCopier::giveUp(const task::Reason &reason) {
    m_isGivenUp = true;
    m_reason = reason;
    if (m_current)
        announceAgain();
}

void CardCopier::take(const Copied &copied, const std::shared_ptr<render::ProjectionEngine> &engine,
                      const std::shared_ptr<gpu::FramePasses> &passes) {
    m_copying = Copying::no;
    if (copied.isLost)
        m_card.giveUp(*copied.refusal, passes);
    if (passes != m_card.passes())
        return;
    if (copied.engine)
        m_copies.insert(m_copies.begin(), copied.engine);
    if (!m_current)
        return;
    m_isGivenUp = !copied.engine && m_current->engine.engine == engine;
    if (copied.refusal)
        m_reason = *copied.refusal;
    announceAgain();
}

} // namespace pellucid::ui
