// The entry point of libFuzzer; the build names the target (cmake/fuzz.cmake).
#include <cstddef>
#include <cstdint>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  nephroid::fuzz::NEPHROID_FUZZ_TARGET(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
