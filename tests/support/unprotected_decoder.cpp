// SPDX-License-Identifier: GPL-3.0-or-later
// The decoder as it is on a system that confines nothing.
#include "core/helper/confinement.h"
#include "core/helper/process.h"
#include "core/parse/serve.h"

int main() {
    using namespace pellucid;
    parse::prepareToServe();
    return parse::serve(helper::socketDescriptor, helper::fileDescriptor, helper::limitsHold);
}
