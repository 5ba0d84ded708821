// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

#include <QObject>

#include "core/prepare/measured_error.h"

namespace pellucid::ui {

/// Measures the error of a picture that rests, on one thread of the lowest priority: frames do not
/// wait for it. Only the latest picture counts, and a view that moves ends the measurement.
class ErrorMeter : public QObject {
    Q_OBJECT
public:
    explicit ErrorMeter(QObject *parent = nullptr);
    ~ErrorMeter() override;

    /// A picture, and what it is measured against.
    struct Picture {
        std::future<picture::PeriodPicture> period;
        prepare::StudyFields study;
        shading::ShadingScale scale;
        scene::ImageDefinition image;
        shading::Shading shading;
        std::uint64_t number = 0; ///< of the picture
    };
    void measure(Picture picture);
    /// Ends the measurement soon; does not wait.
    void cancel();

    enum class Figure { refined, last };

signals:
    /// Comes again while the interval becomes narrower. Nothing comes of a picture that cannot be
    /// measured.
    void measured(std::uint64_t number, const pellucid::error::StatedError &error,
                  pellucid::ui::ErrorMeter::Figure figure);

private:
    void run(const std::stop_token &stop);
    void measureOne(Picture &picture, const std::stop_token &stop);

    std::mutex m_mutex;
    std::condition_variable_any m_wake;
    std::optional<Picture> m_next;
    std::stop_source m_current; ///< of the measurement that runs
    std::jthread m_thread;
};

} // namespace pellucid::ui
