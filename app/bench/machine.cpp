// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

#include "app/bench/report.h"

namespace pellucid::bench {

Machine thisMachine() {
    Machine machine;
    machine.threads = int(std::thread::hardware_concurrency());
    machine.memoryGiB =
        double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE)) / double(1 << 30);
    utsname name{};
    if (uname(&name) == 0)
        machine.system = std::string(name.sysname) + " " + name.machine;
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.rfind("model name", 0) == 0) {
            machine.processor = line.substr(line.find(':') + 2);
            break;
        }
    return machine;
}

} // namespace pellucid::bench
