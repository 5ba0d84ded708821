// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/failure.h"

#include <exception>

#include "core/system/log.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::ui {

Failure currentFailure() {
    try {
        throw;
    } catch (const task::Error &error) {
        return {error.reason(), QString::fromStdString(error.path().string())};
    } catch (const std::exception &error) {
        if (task::isLackOfMemory(error))
            return {task::because::notEnoughMemory, {}};
        system::log(std::string("a fault of the program: ") + error.what());
    } catch (...) {
        system::log("a fault of the program");
    }
    return {task::because::faultOfTheProgram, {}};
}

} // namespace pellucid::ui
