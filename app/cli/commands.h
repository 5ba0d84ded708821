// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stop_token>

namespace CLI {
class App;
class Validator;
} // namespace CLI

namespace pellucid::cli {

/// The arguments of every command.
struct Context {
    std::stop_token stop;
};

/// Each adds a subcommand and its options. The callback runs the command and throws on failure.
void addInfoCommand(CLI::App &app, const Context &context);
void addRenderCommand(CLI::App &app, const Context &context);
void addVolumeCommand(CLI::App &app, const Context &context);
void addSegmentCommand(CLI::App &app, const Context &context);
void addPresetCommand(CLI::App &app, const Context &context);
void addPhantomCommand(CLI::App &app, const Context &context);
/// Both 'server' and 'echo'.
void addServerCommand(CLI::App &app, const Context &context);
void addFindCommand(CLI::App &app, const Context &context);
/// Both 'get' and 'transfers'.
void addGetCommand(CLI::App &app, const Context &context);
void addSendCommand(CLI::App &app, const Context &context);
void addListenCommand(CLI::App &app, const Context &context);
void addBatchCommand(CLI::App &app, const Context &context);
void addRecipeCommand(CLI::App &app, const Context &context);

} // namespace pellucid::cli
