// A sum of n steps is carry * 2^64 + word with -2^63 <= word < 2^63, so that small negative sums
// have no carry, either. The split depends on n alone, not on the order of additions.
#include "film/pixel_sums.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace nephroid {
PixelSums::PixelSums(size_t pixels, int fractional_bits)
    : fractional_bits_(fractional_bits), words_(pixels), carries_(std::make_unique<Carries>()) {}

PixelSums::PixelSums(const PixelSums& other)
    : PixelSums(other.words_.size(), other.fractional_bits_) {
  words_ = other.words_;
  if (!other.have_carries()) return;
  for (size_t i = 0; i < words_.size(); ++i)
    if (other.carries_->of_pixels[i] != PixelCarries{})  // a zero that is written takes memory
      made_carries()[i] = other.carries_->of_pixels[i];
}

ZeroedArray<PixelSums::PixelCarries>& PixelSums::made_carries() {
  std::call_once(carries_->once, [this] {
    carries_->of_pixels = ZeroedArray<PixelCarries>(words_.size(), Pages::kSmall);
    carries_->exist.store(true, std::memory_order_release);
  });
  return carries_->of_pixels;
}

PixelSums::Bits PixelSums::rounded(Bits sum) const {
  __extension__ using Magnitude = unsigned __int128;
  // The magnitude is unsigned, so that the least number has one, too.
  const Magnitude magnitude = sum < 0 ? -static_cast<Magnitude>(sum) : static_cast<Magnitude>(sum);
  const Magnitude half = Magnitude{1} << (dropped_bits() - 1);
  const auto steps = static_cast<Bits>((magnitude + half) >> dropped_bits());
  return sum < 0 ? -steps : steps;
}

PixelSums::Bits PixelSums::steps(size_t pixel, size_t c) const {
  const Bits carry = have_carries() ? carries_->of_pixels[pixel][c] : 0;
  return carry * (Bits{1} << 64) + words_[pixel][c];
}

void PixelSums::set_steps(size_t pixel, size_t c, Bits steps) {
  const auto word = static_cast<int64_t>(static_cast<uint64_t>(steps));
  const auto carry = static_cast<int64_t>((steps - word) >> 64);
  words_[pixel][c] = word;
  if (carry == 0 && !have_carries()) return;
  int64_t& kept = made_carries()[pixel][c];
  if (kept != carry) kept = carry;
}

bool PixelSums::add_steps(size_t pixel, size_t c, Bits added) {
  const Bits most = most_steps();
  const Bits sum = steps(pixel, c) + added;
  const bool fits = -most <= sum && sum <= most;
  set_steps(pixel, c, std::clamp(sum, -most, most));
  return fits;
}

bool PixelSums::add(size_t pixel, const Rgb& value) {
  bool fits = true;
  for (size_t c = 0; c < 3; ++c) {
    const float component = value[static_cast<int>(c)];
    if (component == 0) continue;
    FixedSum sum;
    fits &= sum.add(double{component});
    fits &= add_steps(pixel, c, rounded(sum.bits));
  }
  return fits;
}

bool PixelSums::add(size_t pixel, const RgbSum& value) {
  bool fits = true;
  for (size_t c = 0; c < 3; ++c) fits &= add_steps(pixel, c, rounded(value.rgb[c].bits));
  return fits;
}

bool PixelSums::add(size_t pixel, const PixelSums& other) {
  bool fits = true;
  for (size_t c = 0; c < 3; ++c) fits &= add_steps(pixel, c, other.steps(pixel, c));
  return fits;
}

void PixelSums::clear(size_t pixel) {
  for (size_t c = 0; c < 3; ++c) set_steps(pixel, c, 0);
}

RgbSum PixelSums::sum(size_t pixel) const {
  RgbSum sum;
  for (size_t c = 0; c < 3; ++c) sum.rgb[c].bits = steps(pixel, c) * (Bits{1} << dropped_bits());
  return sum;
}

bool PixelSums::is_zero(size_t pixel) const {
  return words_[pixel] == Words{} &&
         !(have_carries() && carries_->of_pixels[pixel] != PixelCarries{});
}

std::vector<uint32_t> PixelSums::save_carries() const {
  std::vector<uint32_t> words;
  if (!have_carries()) return words;
  words.reserve(kWordsPerCarry * std::ranges::count_if(carries_->of_pixels, [](const auto& carry) {
                  return carry != PixelCarries{};
                }));
  for (size_t pixel = 0; pixel < words_.size(); ++pixel) {
    const PixelCarries& carries = carries_->of_pixels[pixel];
    if (carries == PixelCarries{}) continue;
    words.push_back(static_cast<uint32_t>(pixel));
    for (const int64_t carry : carries) {
      words.push_back(static_cast<uint32_t>(carry));
      words.push_back(static_cast<uint32_t>(carry >> 32));
    }
  }
  return words;
}

void PixelSums::load_carries(std::span<const uint32_t> words) {
  if (words.size() % kWordsPerCarry != 0)
    throw IoError("carries of sums are damaged: they end too early");
  for (; !words.empty(); words = words.subspan(kWordsPerCarry)) {
    if (words[0] >= words_.size())
      throw IoError("carries of sums are damaged: pixel index out of range");
    for (size_t c = 0; c < 3; ++c) {
      const uint64_t low = words[2 * c + 1], high = words[2 * c + 2];
      const auto carry = static_cast<int64_t>(high << 32 | low);
      if (carry < -most_carry() || carry > most_carry())
        throw IoError("carries of sums are damaged: a carry out of range");
      made_carries()[words[0]][c] = carry;
    }
  }
}

}  // namespace nephroid
