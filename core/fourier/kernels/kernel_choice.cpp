// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cctype>

#include "core/fourier/kernels/kernel.h"
#include "core/fourier/kernels/reasons.h"
#include "core/system/text.h"
#include "core/task/error.h"

namespace pellucid::fourier {

namespace {

struct Named {
    const char *name;
    KernelFamily family;
    int width; ///< 0: the width, 2 to 7, follows the name
};

constexpr std::array<Named, 8> names{{{"nearest", KernelFamily::nearest, 1},
                                      {"trilinear", KernelFamily::trilinear, 2},
                                      {"catmull-rom", KernelFamily::catmullRom, 4},
                                      {"b-spline", KernelFamily::cubicBSpline, 4},
                                      {"hamming-sinc", KernelFamily::hammingSinc, 5},
                                      {"es", KernelFamily::exponentialSemicircle, 0},
                                      {"kb", KernelFamily::kaiserBessel, 0},
                                      {"ls", KernelFamily::leastAliasing, 0}}};

} // namespace

Kernel makeKernel(const KernelChoice &choice, double padding) {
    switch (choice.family) {
    case KernelFamily::nearest:
        return Kernel::nearest();
    case KernelFamily::trilinear:
        return Kernel::trilinear();
    case KernelFamily::catmullRom:
        return Kernel::catmullRom();
    case KernelFamily::cubicBSpline:
        return Kernel::cubicBSpline();
    case KernelFamily::hammingSinc:
        return Kernel::hammingSinc();
    case KernelFamily::exponentialSemicircle:
        return Kernel::exponentialSemicircle(choice.width, padding);
    case KernelFamily::kaiserBessel:
        return Kernel::kaiserBessel(choice.width, padding);
    case KernelFamily::leastAliasing:
        break;
    }
    return Kernel::leastAliasing(choice.width, padding);
}

KernelChoice kernelFromName(const std::string &name) {
    const std::string lower = system::lowered(name);
    for (const Named &known : names) {
        if (known.width != 0) {
            if (lower == known.name)
                return {known.family, known.width};
        } else if (lower.size() == 3 && lower.compare(0, 2, known.name) == 0 && lower[2] >= '2' &&
                   lower[2] <= '7') {
            return {known.family, lower[2] - '0'};
        }
    }
    throw task::Error(task::ErrorCode::usage, task::because::isNoKernel(name));
}

std::string kernelName(const KernelChoice &choice) {
    for (const Named &known : names)
        if (known.family == choice.family) {
            std::string name = known.name;
            if (known.width == 0) {
                std::transform(name.begin(), name.end(), name.begin(),
                               [](unsigned char c) { return char(std::toupper(c)); });
                name += std::to_string(choice.width);
            }
            return name;
        }
    return {};
}

} // namespace pellucid::fourier
