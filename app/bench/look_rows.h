// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/bench/suites.h"
#include "core/classify/look.h"

namespace pellucid::bench {

/// A head with its values, for looks, and how it is seen.
struct LookSubject {
    explicit LookSubject(int side);
    volume::Volume volume;
    classify::FieldWindow window;
    render::Scene scene;
};

/// Three rows for a look: one spectrum each channel of the sum, while weights stand still; the
/// layers summed, while weights and view move; and the kept projections recombined, while the view
/// stands still. Errors against the exact projections of the sum, from one view; of all channels.
void reportLook(const Report &report, const std::string &suite, const std::string &name,
                const LookSubject &subject, const classify::Look &look, const std::string &note);

} // namespace pellucid::bench
