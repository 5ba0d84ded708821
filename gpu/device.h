// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "gpu/capabilities.h"
#include "gpu/context.h"
#include "gpu/program.h"

namespace pellucid::gpu {

/// A graphics card that computes: a context on a thread of its own, where all that is done on it is
/// done in turn. What its driver has to say goes to the log. Whoever holds what lies on the card
/// holds the device too.
class Device {
public:
    /// *Throws* Error{noSuchDevice} with the reason if the context does not come up or has no
    /// OpenGL 4.3.
    explicit Device(std::unique_ptr<Context> context);
    /// Not from its own thread. What was posted is done before.
    ~Device();
    Device(const Device &) = delete;
    Device &operator=(const Device &) = delete;

    const Capabilities &capabilities() const { return m_capabilities; }
    /// Whether the card is gone with all that was on it; for good.
    bool isLost() const { return m_lost; }

    /// Runs it on the device's thread and waits. *Throws* what it throws, Error{noSuchDevice} if
    /// the device is lost, before it or by it.
    void run(const std::function<void()> &work);
    /// Runs it there some time later; what it throws goes to the log.
    void post(std::function<void()> work);

    /// A compute program, compiled when it is first asked for. On the device's thread.
    const Program &program(const std::string &file, const Defines &defines = {});

private:
    void live(const std::stop_token &stop);

    std::unique_ptr<Context> m_context;
    Capabilities m_capabilities;
    std::atomic<bool> m_lost = false;
    std::map<std::string, Program> m_programs;
    std::mutex m_mutex;
    std::condition_variable_any m_wake;
    std::deque<std::function<void()>> m_work;
    std::jthread m_thread;
};

/// Deletes what has OpenGL names in it where their context is.
template <class T> struct DeleteOnDevice {
    Device *device = nullptr;
    void operator()(T *object) const {
        device->post([object] { delete object; });
    }
};
template <class T> using OnDevice = std::unique_ptr<T, DeleteOnDevice<T>>;

} // namespace pellucid::gpu
