#include "core/counted.h"

namespace nephroid {

std::string in_number(uint64_t count, const std::string& one, const std::string& many) {
  if (count == 1) return one;
  return many.empty() ? one + "s" : many;
}

std::string counted(uint64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + in_number(count, one, many);
}

}  // namespace nephroid
