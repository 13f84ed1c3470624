// The program `nephroid`: parses its arguments, runs a command, turns errors into messages and exit
// statuses (core/errors.h).
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/messages.h"
#include "core/errors.h"
#include "film/image_io.h"
#include "options/command_line.h"

namespace nephroid {
namespace {

int fail(ExitStatus status, const char* message) {
  print_error(message);
  return static_cast<int>(status);
}

int print(const std::string& text) {
  fmt::print("{}", text);
  return static_cast<int>(ExitStatus::kDone);
}

int run(const std::vector<std::string>& arguments) {
  const CommandLine line = parse_command_line(arguments);
  switch (line.action) {
    case Action::kRender:
      return run_render(line.render);
    case Action::kView:
      return run_view(line.view, line.render);
    case Action::kInfo:
      return run_info(line.info);
    case Action::kMerge:
      return run_merge(line.merge);
    case Action::kMix:
      return run_mix(line.mix);
    case Action::kCompare:
      return run_compare(line.compare);
    case Action::kRoutes:
      return run_routes(line.routes);
    case Action::kBench:
      return run_bench(line.bench);
    case Action::kConvert:
      return run_convert(line.convert);
    case Action::kPrint:
      break;
  }
  return print(line.text);
}

}  // namespace
}  // namespace nephroid

int main(int argc, char** argv) {
  using namespace nephroid;
  try {
    limit_image_threads(0);  // a command may have fewer
    const int status = run(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
    // Buffered output may still fail, on a full disk or a closed pipe.
    if (std::fflush(stdout) != 0)
      return fail(ExitStatus::kInputOutput, "standard output: cannot write");
    return status;
  } catch (const Error& error) {
    return fail(error.status(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::kRender, "out of memory");
  } catch (const std::exception& error) {
    if (std::ferror(stdout)) return fail(ExitStatus::kInputOutput, "standard output: cannot write");
    return fail(ExitStatus::kRender, error.what());
  }
}
