// SPDX-License-Identifier: GPL-3.0-or-later
// fuzz_corpus FOLDER: writes the first inputs for fuzzing, in a folder for each target.
#include <cstdio>
#include <filesystem>

#include "tests/fuzz/corpus.h"
#include "tests/fuzz/targets.h"

int main(int argc, char **argv) {
    if (argc != 2) {
        std::fputs("usage: fuzz_corpus FOLDER\n", stderr);
        return 2;
    }
    for (const auto &target : pellucid::fuzz::targets()) {
        const auto folder = std::filesystem::path(argv[1]) / target.name;
        std::filesystem::create_directories(folder);
        pellucid::fuzz::writeCorpus(target.name, folder);
        std::puts(target.name);
    }
    return 0;
}
