// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/page.hpp"

#include <unistd.h>

#include "service/apps/output.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {

CLI::Option* AddViewFlag(CLI::App& parser, bool& is_wanted) {
  return parser.add_flag("--view", is_wanted, "show it all in a browser: see the address it tells");
}

void TellPage(const std::string& url, bool is_output_for_people) {
  messages::Info("look at {}", url);
  if (is_output_for_people) Print("look at {}\n", url);
}

void KeepPage(const std::function<void(const pipeline::Interruption&)>& stay) {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0) return;
  const pipeline::Interruption interruption("the page is closed\n");
  Print("it is over; the page stays until Ctrl-C\n");
  stay(interruption);
}

}  // namespace qwsm::apps
