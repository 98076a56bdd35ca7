// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include "service/apps/help_formatter.hpp"
#include "service/apps/output.hpp"
#include "service/apps/version.hpp"
#include "service/config/suggestion.hpp"
#include "service/io/files/atomic_file.hpp"

namespace qwsm::apps {
namespace {

// Where nobody reads it any more, that is no further error.
void TellError(const std::string& line) { std::fputs((line + "\n").c_str(), stderr); }

ExitCode Complain(const CLI::App& program, ExitCode code, const std::string& message) {
  TellError(program.get_name() + ": " + message);
  return code;
}

/// The words a user may have meant: long options, or commands.
std::vector<std::string> NamesLike(const CLI::App& parser, const std::string& word) {
  std::vector<std::string> names;
  if (word.starts_with("-")) {
    for (const CLI::Option* option : parser.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  } else {
    for (const CLI::App* command : parser.get_subcommands({})) names.push_back(command->get_name());
  }
  return names;
}

/// The innermost command that was named.
const CLI::App& Innermost(const CLI::App& program) {
  const CLI::App* parser = &program;
  while (!parser->get_subcommands().empty()) parser = parser->get_subcommands().front();
  return *parser;
}

std::string FullName(const CLI::App& parser) {
  const CLI::App* parent = parser.get_parent();
  return parent == nullptr ? parser.get_name() : FullName(*parent) + " " + parser.get_name();
}

ExitCode ComplainAboutUsage(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& parser = Innermost(program);
  const std::vector<std::string> extras = program.remaining(true);
  std::string message = error.what();
  if (!extras.empty()) {
    const std::string word = extras.front().substr(0, extras.front().find('='));
    const bool is_option = word.starts_with("-");
    const bool has_commands = !parser.get_subcommands({}).empty();
    const std::string what = is_option ? "option" : (has_commands ? "command" : "argument");
    message = fmt::format(
        "unknown {} '{}'{}", what, word, config::DidYouMean(word, NamesLike(parser, word)));
  } else if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr &&
             !parser.get_subcommands({}).empty()) {
    message = "a command is needed";
  }
  message += fmt::format("\n{}: see '{} --help'", program.get_name(), FullName(parser));
  return Complain(program, ExitCode::kUsage, message);
}

ExitCode RunChosen(const CLI::App& program, const std::vector<Command>& commands) {
  const auto chosen = std::ranges::find_if(
      commands, [](const Command& command) { return command.parser->parsed(); });
  try {
    return chosen->run();
  } catch (const config::ConfigError& error) {
    TellError(error.what());
    return ExitCode::kUsage;
  } catch (const io::WriteError& error) {
    return Complain(program, ExitCode::kIo, error.what());
  } catch (const std::runtime_error& error) {
    // Arguments and files that make no sense; the text names them.
    return Complain(program, ExitCode::kUsage, error.what());
  }
}

/// Help, or the version.
ExitCode TellOfItself(const CLI::App& program, const CLI::Success& asked) {
  std::ostringstream text;
  program.exit(asked, text);
  try {
    PrintText(text.str());
    return ExitCode::kDone;
  } catch (const io::WriteError& error) {
    return Complain(program, ExitCode::kIo, error.what());
  }
}

}  // namespace

std::unique_ptr<CLI::App> MakeProgram(const std::string& help, const std::string& name) {
  auto program = std::make_unique<CLI::App>(help, name);
  program->formatter(std::make_shared<HelpFormatter>());
  program->set_version_flag("--version", name + " " + std::string(Version()), "print the version");
  program->require_subcommand(1);
  program->get_formatter()->label("SUBCOMMAND", "COMMAND");
  return program;
}

ExitCode RunProgram(CLI::App& program,
                    const std::vector<Command>& commands,
                    const Arguments& arguments) {
  // A file that may not grow is a full disk, which whoever writes tells, and not the end.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    program.parse(arguments.count, arguments.values);
    return RunChosen(program, commands);
  } catch (const CLI::Success& success) {
    return TellOfItself(program, success);
  } catch (const CLI::ParseError& error) {
    return ComplainAboutUsage(program, error);
  } catch (const std::exception& error) {
    return Complain(program, ExitCode::kFailed, fmt::format("failed: {}", error.what()));
  }
}

}  // namespace qwsm::apps
