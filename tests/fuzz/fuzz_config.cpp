// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <string>

#include "service/config/options_io.hpp"
#include "service/options/program_options.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace qwsm::config;
using qwsm::options::ProgramOptions;

ProgramOptions Read(const std::string& text) {
  ProgramOptions options;
  OptionGroup group = GroupOf(options);
  Loader loader(group);
  loader.ReadText(text, "fuzz.yaml");
  loader.Set(text.substr(0, text.find('\n')));
  loader.Finish();
  return options;
}

ProgramOptions ReadDump(const std::string& text) {
  ProgramOptions options;
  OptionGroup group = GroupOf(options);
  Loader loader(group);
  loader.ReadText(text, "dump.yaml");
  loader.Finish();
  return options;
}

}  // namespace

/// Any text as a file, its first line as a setting too: never a crash, never an exception but
/// ConfigError with at least one problem; and what is accepted is dumped and read back unchanged.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const std::string& attempt : {text, "log.strict=true\n" + text}) {
    try {
      const std::string dump = DumpOptions(Read(attempt));
      qwsm::test::Expect(DumpOptions(ReadDump(dump)) == dump);
    } catch (const ConfigError& error) {
      qwsm::test::Expect(!error.problems().empty());
    }
  }
  return 0;
}
