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

/// A graphics card used for computing: a context on its own thread, which runs one piece of work at
/// a time. Driver messages of medium and high severity go to the log. Owners of objects on the card
/// also keep the device alive.
class Device {
public:
    /// *Throws* Error{noSuchDevice} with the reason if the context cannot be made current or lacks
    /// OpenGL 4.3.
    explicit Device(std::unique_ptr<Context> context);
    /// Runs all posted work first. *Requires*: not called on the device's thread.
    ~Device();
    Device(const Device &) = delete;
    Device &operator=(const Device &) = delete;

    const Capabilities &capabilities() const { return m_capabilities; }
    /// Whether the card and everything on it is lost; a lost device never recovers.
    bool isLost() const { return m_lost; }

    /// Runs `work` on the device's thread and waits. *Throws* what `work` throws;
    /// Error{noSuchDevice} if the device is lost, before or during the work.
    void run(const std::function<void()> &work);
    /// Queues `work` for the device's thread; exceptions go to the log.
    void post(std::function<void()> work);

    /// A compute program, compiled on first use. *Requires*: called on the device's thread.
    const Program &program(const std::string &file, const Defines &defines = {});

private:
    void runQueue(const std::stop_token &stop);

    std::unique_ptr<Context> m_context;
    Capabilities m_capabilities;
    std::atomic<bool> m_lost = false;
    std::map<std::string, Program> m_programs;
    std::mutex m_mutex;
    std::condition_variable_any m_wake;
    std::deque<std::function<void()>> m_work;
    std::jthread m_thread;
};

/// Deletes an owner of OpenGL objects on the thread of their context.
template <class T> struct DeleteOnDevice {
    Device *device = nullptr;
    void operator()(T *object) const {
        device->post([object] { delete object; });
    }
};
template <class T> using OnDevice = std::unique_ptr<T, DeleteOnDevice<T>>;

} // namespace pellucid::gpu
