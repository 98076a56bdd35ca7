// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/help_formatter.hpp"

namespace qwsm::apps {

HelpFormatter::HelpFormatter() { column_width(34); }

std::string HelpFormatter::make_help(const CLI::App* app,
                                     std::string name,
                                     CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
  std::string help = make_description(app);
  if (!app->get_footer().empty()) help += "\nExamples:\n" + app->get_footer() + "\n";
  help += "\n" + make_usage(app, name);
  help += make_positionals(app);
  help += make_groups(app, mode);
  help += make_subcommands(app, mode);
  return help;
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  std::string text;
  if (option->get_type_size() != 0 && !option->get_type_name().empty() &&
      !option->get_positional()) {
    text += " " + option->get_type_name();
  }
  if (!option->get_default_str().empty()) text += " (" + option->get_default_str() + ")";
  return text;
}

}  // namespace qwsm::apps
