#include "input/mitsuba/zlib_stream.h"

#include <algorithm>
#include <limits>
#include <string>

namespace nephroid::mitsuba {

ZlibStream::ZlibStream(std::string_view packed) : packed_(packed) {
  if (inflateInit(&stream_) != Z_OK) throw ZlibError("zlib could not start");
}

ZlibStream::~ZlibStream() {
  inflateEnd(&stream_);
}

void ZlibStream::read(void* to, size_t size) {
  auto* out = static_cast<Bytef*>(to);
  while (size > 0) {
    const auto limit = static_cast<size_t>(std::numeric_limits<uInt>::max());
    const size_t feed = std::min(packed_.size(), limit), room = std::min(size, limit);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed_.data()));
    stream_.avail_in = static_cast<uInt>(feed);
    stream_.next_out = out;
    stream_.avail_out = static_cast<uInt>(room);
    const int result = inflate(&stream_, Z_NO_FLUSH);
    packed_.remove_prefix(feed - stream_.avail_in);
    const size_t produced = room - stream_.avail_out;
    out += produced;
    size -= produced;
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
      throw ZlibError("not valid zlib data" +
                      (stream_.msg ? " (" + std::string(stream_.msg) + ")" : std::string()));
    if (size > 0 && produced == 0) throw ZlibError("the data end too early");
    if (size > 0 && result == Z_STREAM_END) throw ZlibError("the data end too early");
  }
}

}  // namespace nephroid::mitsuba
