// `nephroid bench`: runs a suite and writes its results.
#include <fmt/format.h>

#include <cstdio>

#include "apps/commands.h"
#include "apps/messages.h"
#include "bench/bench.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "film/image_io.h"

namespace nephroid {
namespace {

/// A word quoted for the shell.
std::string quoted(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// The command line that repeats the run in this directory.
std::string command_text(const BenchCommand& command, const std::string& directory) {
  std::string text = "nephroid bench " + quoted(command.suite);
  if (command.time_limit > 0) text += fmt::format(" --time {}s", command.time_limit);
  if (command.passes > 0) text += fmt::format(" --passes {}", command.passes);
  if (command.repeat > 0) text += fmt::format(" --repeat {}", command.repeat);
  for (const std::string& scene : command.only) text += " --only " + quoted(scene);
  if (command.threads > 0) text += fmt::format(" -t {}", command.threads);
  if (command.strict_claims) text += " --strict-claims";
  return text + " --out " + quoted(directory);
}

void print_summary(const BenchResults& results) {
  for (size_t i = 0; i < results.verdicts.size(); ++i) {
    const BenchVerdict::State state = results.verdicts[i].state;
    const char* word = state == BenchVerdict::State::kHolds   ? "holds"
                       : state == BenchVerdict::State::kFails ? "FAILS"
                                                              : "not measured";
    say(fmt::format("claim {}: {}\n", word, printable(results.suite.claims[i].text)));
  }
  const std::string file = results.directory + "/results.json";
  say(fmt::format("wrote {}; nephroid-bench-report {} draws the page\n", printable(file),
                  printable(quoted(file))));
}

}  // namespace

int run_bench(const BenchCommand& command) {
  if (command.time_limit > 0 && command.passes > 0)
    throw UsageError("--time and --passes both say when runs stop, expected only one of them");
  const ThreadLimit threads(command.threads);
  limit_image_threads(command.threads);
  const BenchSuite suite = read_suite(command.suite);
  BenchOptions options;
  options.directory = command.directory.empty() ? suite.name + ".bench" : command.directory;
  options.limit = {command.time_limit, command.passes};
  options.repeat = command.repeat;
  options.only = command.only;
  options.command = command_text(command, options.directory);
  if (!command.quiet) options.say = [](const std::string& line) { say(printable(line) + "\n"); };
  SignalListener listener;
  listener.note_stops();
  const BenchResults results = run_bench(suite, options, listener.flags());
  if (!command.quiet) print_summary(results);
  return exit_status(results, command.strict_claims);
}

}  // namespace nephroid
