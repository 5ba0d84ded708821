// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/program.h"

#include <array>
#include <span>
#include <sstream>

#include <epoxy/gl.h>

#include "core/task/error.h"
#include "core/task/reasons.h"
#include "gpu/reasons.h"
#include "gpu/shader_sources.h"

namespace pellucid::gpu {

namespace {

void append(ShaderText &out, const std::string &file, const Defines &defines) {
    const auto number = out.files.size();
    out.files.push_back(file);
    std::istringstream lines(shaderSource(file));
    int line = 0;
    for (std::string text; std::getline(lines, text);) {
        ++line;
        if (text.rfind("#include \"", 0) == 0) {
            append(out, text.substr(10, text.rfind('"') - 10), {});
            out.text += "#line " + std::to_string(line + 1) + " " + std::to_string(number) + "\n";
            continue;
        }
        // Only comments may precede #version.
        if (line == 1 && number > 0)
            out.text += "#line 1 " + std::to_string(number) + "\n";
        out.text += text + "\n";
        if (line == 1 && !defines.empty()) {
            for (const auto &[name, value] : defines)
                out.text += "#define " + name + " " + std::to_string(value) + "\n";
            out.text += "#line 2 " + std::to_string(number) + "\n";
        }
    }
}

std::string fileNames(const ShaderText &shader) {
    std::string names;
    for (std::size_t n = 0; n < shader.files.size(); ++n)
        names += (n > 0 ? " " : "") + std::to_string(n) + "=" + shader.files[n];
    return names;
}

ShaderName compile(GLenum stage, const std::string &file, const Defines &defines = {}) {
    const ShaderText shader = assembledShader(file, defines);
    ShaderName name(glCreateShader(stage));
    const char *const text = shader.text.c_str();
    glShaderSource(name.name(), 1, &text, nullptr);
    glCompileShader(name.name());
    int good = 0;
    glGetShaderiv(name.name(), GL_COMPILE_STATUS, &good);
    if (good == 0) {
        std::string log(4096, '\0');
        int length = 0;
        glGetShaderInfoLog(name.name(), int(log.size()), &length, log.data());
        log.resize(std::size_t(length));
        throw task::Error(task::ErrorCode::internal,
                          task::because::shaderDoesNotCompile(fileNames(shader), log));
    }
    return name;
}

ProgramName link(std::span<const ShaderName> shaders, const std::string &files) {
    ProgramName program(glCreateProgram());
    for (const ShaderName &shader : shaders)
        glAttachShader(program.name(), shader.name());
    glLinkProgram(program.name());
    for (const ShaderName &shader : shaders)
        glDetachShader(program.name(), shader.name());
    int good = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &good);
    if (good == 0) {
        std::string log(4096, '\0');
        int length = 0;
        glGetProgramInfoLog(program.name(), int(log.size()), &length, log.data());
        log.resize(std::size_t(length));
        throw task::Error(task::ErrorCode::internal, task::because::at(files, log));
    }
    return program;
}

} // namespace

ShaderText assembledShader(const std::string &file, const Defines &defines) {
    ShaderText shader;
    append(shader, file, defines);
    return shader;
}

Program::Program(const std::string &vertexFile, const std::string &fragmentFile) {
    const std::array<ShaderName, 2> shaders{compile(GL_VERTEX_SHADER, vertexFile),
                                            compile(GL_FRAGMENT_SHADER, fragmentFile)};
    m_program = link(shaders, vertexFile + " with " + fragmentFile);
}

Program::Program(const std::string &computeFile, const Defines &defines) {
    const std::array<ShaderName, 1> shaders{compile(GL_COMPUTE_SHADER, computeFile, defines)};
    m_program = link(shaders, computeFile);
}

int Program::uniform(const char *name) const {
    return glGetUniformLocation(m_program.name(), name);
}

} // namespace pellucid::gpu
