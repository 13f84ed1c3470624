// Command lines; see targets.h.
#include <algorithm>
#include <string>
#include <vector>

#include "core/errors.h"
#include "fuzz/targets.h"
#include "options/command_line.h"
#include "session/checkpoint/pass_ranges.h"
#include "session/settings/integrator_settings.h"

namespace nephroid::fuzz {

void command(const std::string& bytes) {
  std::vector<std::string> arguments;
  for (size_t start = 0; start <= bytes.size();) {
    const size_t end = std::min(bytes.find('\n', start), bytes.size());
    arguments.push_back(bytes.substr(start, end - start));
    start = end + 1;
  }
  for (const std::string& argument : arguments)
    if (const auto passes = PassRanges::parse(argument))
      if (PassRanges::parse(passes->text()) != passes) __builtin_trap();
  try {
    parse_command_line(arguments);
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
