// Unpacks zlib data piece by piece, so that memory is taken only for what is there. It must not
// know what the bytes mean.
#pragma once

#include <zlib.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace nephroid::mitsuba {

/// Thrown when the data are damaged or end too early.
struct ZlibError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ZlibStream {
 public:
  explicit ZlibStream(std::string_view packed);
  ~ZlibStream();
  ZlibStream(const ZlibStream&) = delete;
  ZlibStream& operator=(const ZlibStream&) = delete;

  /// Fills `size` bytes. Throws ZlibError if there are fewer.
  void read(void* to, size_t size);
  /// A value in little-endian order.
  template <class Value>
  Value read_value() {
    static_assert(std::endian::native == std::endian::little);
    Value value;
    read(&value, sizeof(Value));
    return value;
  }
  /// `count` values. The vector grows with the data.
  template <class Value>
  std::vector<Value> read_values(uint64_t count) {
    constexpr uint64_t kStep = 1 << 16;
    std::vector<Value> values;
    for (uint64_t done = 0; done < count;) {
      const size_t step = static_cast<size_t>(std::min(kStep, count - done));
      values.resize(values.size() + step);
      read(values.data() + done, step * sizeof(Value));
      done += step;
    }
    return values;
  }

 private:
  z_stream stream_{};
  std::string_view packed_;
};

}  // namespace nephroid::mitsuba
