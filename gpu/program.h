// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace pellucid::gpu {

/// A linked program from two files below shaders/. `#include "..."` lines are replaced by the named
/// file. Belongs to the context that is current when it is made; move-only.
class Program {
public:
    /// *Throws* Error{internal} with the compiler's words, which name file and line.
    Program(const std::string &vertexFile, const std::string &fragmentFile);
    ~Program();
    Program(Program &&other) noexcept;
    Program &operator=(Program &&other) noexcept;

    unsigned id() const { return m_id; }
    int uniform(const char *name) const;

private:
    unsigned m_id = 0;
};

/// The text of a shader with its includes in place and #line directives before each part; the part
/// numbers index `files`.
struct ShaderText {
    std::string text;
    std::vector<std::string> files;
};
ShaderText assembledShader(const std::string &file);

} // namespace pellucid::gpu
