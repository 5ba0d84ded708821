// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/language/failure.h"

#include <exception>

#include <QCoreApplication>

#include "core/system/log.h"
#include "core/task/error.h"
#include "ui/language/spoken.h"

namespace pellucid::ui {

namespace {

struct FailureTexts {
    Q_DECLARE_TR_FUNCTIONS(FailureTexts)
};

} // namespace

Failure currentFailure() {
    try {
        throw;
    } catch (const task::Error &error) {
        return {spoken(error.reason()), QString::fromStdString(error.path().string())};
    } catch (const std::exception &error) {
        if (task::isLackOfMemory(error))
            return {FailureTexts::tr("not enough memory"), {}};
        system::log(std::string("a fault of the program: ") + error.what());
    } catch (...) {
        system::log("a fault of the program");
    }
    return {FailureTexts::tr("a fault of the program; the log says more"), {}};
}

} // namespace pellucid::ui
