// A sum of n steps is carry * 2^64 + word with -2^63 <= word < 2^63, so that small negative sums
// have no carry, either. The split depends on n alone, not on the order of additions.
#include "film/layer_sums.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace nephroid {
namespace {

using Bits = FixedSum::Bits;

/// Bits of FixedSum below a step.
constexpr int kDroppedBits = 20;
constexpr Bits kMaxSteps = Bits{1} << 94;

/// Steps of a FixedSum, to nearest, ties away from zero: x and -x cancel.
Bits rounded(Bits sum) {
  if (sum < 0) return -rounded(-sum);
  const bool up = (sum >> (kDroppedBits - 1) & 1) != 0;
  return (sum >> kDroppedBits) + (up ? 1 : 0);
}

}  // namespace

LayerSums::LayerSums(size_t pixels) : words_(pixels), carries_(std::make_unique<Carries>()) {}

LayerSums::LayerSums(const LayerSums& other) : LayerSums(other.words_.size()) {
  words_ = other.words_;
  if (other.have_carries()) made_carries() = other.carries_->of_pixels;
}

ZeroedArray<LayerSums::PixelCarries>& LayerSums::made_carries() {
  std::call_once(carries_->once, [this] {
    carries_->of_pixels = ZeroedArray<PixelCarries>(words_.size());
    carries_->exist.store(true, std::memory_order_release);
  });
  return carries_->of_pixels;
}

LayerSums::Bits LayerSums::steps(size_t pixel, size_t c) const {
  const Bits carry = have_carries() ? carries_->of_pixels[pixel][c] : 0;
  return carry * (Bits{1} << 64) + words_[pixel][c];
}

void LayerSums::set_steps(size_t pixel, size_t c, Bits steps) {
  const auto word = static_cast<int64_t>(static_cast<uint64_t>(steps));
  const auto carry = static_cast<int32_t>((steps - word) >> 64);
  words_[pixel][c] = word;
  if (carry == 0 && !have_carries()) return;
  int32_t& kept = made_carries()[pixel][c];
  if (kept != carry) kept = carry;  // a zero that is written would take memory
}

bool LayerSums::add_steps(size_t pixel, size_t c, Bits added) {
  const Bits sum = steps(pixel, c) + added;
  const bool fits = -kMaxSteps <= sum && sum <= kMaxSteps;
  set_steps(pixel, c, std::clamp(sum, -kMaxSteps, kMaxSteps));
  return fits;
}

bool LayerSums::add(size_t pixel, const Rgb& value) {
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

bool LayerSums::add(size_t pixel, const RgbSum& value) {
  bool fits = true;
  for (size_t c = 0; c < 3; ++c) fits &= add_steps(pixel, c, rounded(value.rgb[c].bits));
  return fits;
}

bool LayerSums::add(size_t pixel, const LayerSums& other) {
  bool fits = true;
  for (size_t c = 0; c < 3; ++c) fits &= add_steps(pixel, c, other.steps(pixel, c));
  return fits;
}

void LayerSums::clear(size_t pixel) {
  for (size_t c = 0; c < 3; ++c) set_steps(pixel, c, 0);
}

RgbSum LayerSums::sum(size_t pixel) const {
  RgbSum sum;
  for (size_t c = 0; c < 3; ++c) sum.rgb[c].bits = steps(pixel, c) * (Bits{1} << kDroppedBits);
  return sum;
}

std::vector<uint32_t> LayerSums::save_carries() const {
  std::vector<uint32_t> words;
  if (!have_carries()) return words;
  for (size_t pixel = 0; pixel < words_.size(); ++pixel) {
    const PixelCarries& carries = carries_->of_pixels[pixel];
    if (carries == PixelCarries{}) continue;
    words.push_back(static_cast<uint32_t>(pixel));
    for (const int32_t carry : carries) words.push_back(static_cast<uint32_t>(carry));
  }
  return words;
}

void LayerSums::load_carries(std::span<const uint32_t> words) {
  if (words.size() % kWordsPerCarry != 0)
    throw IoError("carries of layers are damaged: they end too early");
  for (; !words.empty(); words = words.subspan(kWordsPerCarry)) {
    if (words[0] >= words_.size())
      throw IoError("carries of layers are damaged: pixel index out of range");
    for (size_t c = 0; c < 3; ++c) made_carries()[words[0]][c] = static_cast<int32_t>(words[c + 1]);
  }
}

}  // namespace nephroid
