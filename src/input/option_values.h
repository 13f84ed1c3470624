// Parses option values: numbers, durations, ranges, sizes. Each parser uses the whole text or
// throws UsageError with what was expected. `option` is the name at the beginning of the message.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace nephroid {

/// A whole number in [low, high].
int64_t parse_integer(const std::string& option, const std::string& text, int64_t low,
                      int64_t high = std::numeric_limits<int64_t>::max());
int parse_int(const std::string& option, const std::string& text, int low,
              int high = std::numeric_limits<int>::max());
/// Any unsigned 64-bit number.
uint64_t parse_seed(const std::string& option, const std::string& text);
/// True for "yes", false for "no".
bool parse_yes_no(const std::string& option, const std::string& text);
std::string yes_no_text(bool yes);
/// A finite number in [low, high], or in (low, high] if `low_is_open`.
double parse_number(const std::string& option, const std::string& text, double low, double high,
                    bool low_is_open);
float parse_float(const std::string& option, const std::string& text, double low, double high,
                  bool low_is_open);
/// "X" or "LOW..HIGH" with low <= X, LOW <= HIGH and all of them up to `high`; "X" is "X..X".
std::pair<float, float> parse_range(const std::string& option, const std::string& text, float low,
                                    float high);
/// "4096", "64K", "1.5M" or "1G" in bytes, up to 1024 G; K, M and G are powers of 1024.
int64_t parse_bytes(const std::string& option, const std::string& text);
/// The same as text, with the largest unit that leaves a whole number.
std::string bytes_text(int64_t bytes);
/// "90", "90s", "1.5m" or "1h" in seconds, above 0.
double parse_duration(const std::string& option, const std::string& text);
/// "0.5", "0.5s" or "1/48s" in seconds, from 0 to `high`.
double parse_seconds(const std::string& option, const std::string& text, double high);
/// "N" is passes 0 to N-1, "A..B" is A to B, both included. First and last pass.
std::pair<uint32_t, uint32_t> parse_passes(const std::string& option, const std::string& text);
/// "640x360": width and height, each 1 to 65536.
std::pair<int, int> parse_resolution(const std::string& option, const std::string& text);
/// Names with commas between them, none empty; the message shows the example.
std::vector<std::string> parse_names(const std::string& option, const std::string& text,
                                     const std::string& example);
/// "x0,x1,y0,y1" in [0,1], x0 < x1 and y0 < y1.
std::array<float, 4> parse_crop(const std::string& option, const std::string& text);

}  // namespace nephroid
