// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/device.h"

#include <future>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "core/system/log.h"
#include "core/task/error.h"
#include "gpu/reasons.h"

namespace pellucid::gpu {

Device::Device(std::unique_ptr<Context> context) : m_context(std::move(context)) {
    m_thread = std::jthread([this](const std::stop_token &stop) { runQueue(stop); });
    const auto begin = [this] {
        m_context->makeCurrent();
        m_capabilities = currentCapabilities();
        if (!m_capabilities.canRender())
            throw task::Error(task::ErrorCode::noSuchDevice,
                              task::because::tooOldOpenGl(m_capabilities.version / 10,
                                                          m_capabilities.version % 10,
                                                          m_capabilities.renderer));
        system::log(fmt::format("OpenGL {}.{}, {}", m_capabilities.version / 10,
                                m_capabilities.version % 10, m_capabilities.renderer));
        glEnable(GL_DEBUG_OUTPUT);
        glDebugMessageCallback(
            [](GLenum, GLenum, GLuint, GLenum severity, GLsizei length, const GLchar *text,
               const void *) {
                if (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM)
                    system::log("OpenGL: " + std::string(text, std::size_t(length)));
            },
            nullptr);
    };
    try {
        run(begin);
    } catch (...) {
        m_lost = true; // no OpenGL object exists yet
        throw;
    }
}

Device::~Device() {
    m_thread.request_stop();
    m_thread.join();
}

void Device::run(const std::function<void()> &work) {
    std::promise<void> done;
    auto future = done.get_future();
    post([&] {
        try {
            if (m_lost)
                throw task::Error(task::ErrorCode::noSuchDevice, task::because::cardWasLost);
            std::exception_ptr failure;
            try {
                work();
            } catch (const task::Error &error) {
                failure = std::current_exception();
                m_lost = m_lost || error.code() == task::ErrorCode::noSuchDevice;
            } catch (...) {
                failure = std::current_exception();
            }
            if (m_capabilities.canRender() && m_context->isLost()) {
                m_lost = true;
                throw task::Error(task::ErrorCode::noSuchDevice, task::because::cardWasReset);
            }
            if (failure)
                std::rethrow_exception(failure);
            done.set_value();
        } catch (...) {
            done.set_exception(std::current_exception());
        }
    });
    future.get();
}

void Device::post(std::function<void()> work) {
    const std::lock_guard lock(m_mutex);
    m_work.push_back(std::move(work));
    m_wake.notify_one();
}

void Device::runQueue(const std::stop_token &stop) {
    for (;;) {
        std::function<void()> work;
        {
            std::unique_lock lock(m_mutex);
            m_wake.wait(lock, stop, [this] { return !m_work.empty(); });
            if (m_work.empty())
                break;
            work = std::move(m_work.front());
            m_work.pop_front();
        }
        try {
            work();
        } catch (const std::exception &error) {
            system::log(std::string("graphics card: ") + error.what());
        }
    }
    m_programs.clear();
    m_context->doneCurrent();
}

const Program &Device::program(const std::string &file, const Defines &defines) {
    std::string key = file;
    for (const auto &[name, value] : defines)
        key += fmt::format(" {}={}", name, value);
    const auto found = m_programs.find(key);
    return found != m_programs.end()
               ? found->second
               : m_programs.emplace(key, Program(file, defines)).first->second;
}

} // namespace pellucid::gpu
