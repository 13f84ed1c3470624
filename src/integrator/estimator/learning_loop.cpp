#include "integrator/estimator/learning_loop.h"

#include <cstring>
#include <utility>

namespace nephroid {

namespace {

// A damaged file must not claim all memory. A larger value is not saved but learned again.
constexpr size_t kMaxWords = size_t{64} << 18;
// Version of the bytes that estimators write. Increase it when the members of any value change.
constexpr uint32_t kLayout = 2;
// All that is saved of an estimator that has nothing to learn. No words: it has not learned yet, or
// its value is too large.
constexpr uint32_t kLearnsNothing = 0;

}  // namespace

const std::shared_ptr<const Learned>& LearningLoop::learn(const Estimator& estimator, uint64_t seed,
                                                          const Scene& scene,
                                                          const FilmFormat& format,
                                                          PassControl& control) {
  if (for_all_seeds_ || seed_ == seed) return value_;
  value_ = estimator.learn(scene, format, seed, control);
  seed_ = seed;
  was_read_ = false;
  return value_;
}

void LearningLoop::render_pass(Estimator& estimator, const PassKey& key, const Scene& scene,
                               Film& film, PassControl& control) {
  const auto& learned = learn(estimator, key.seed, scene, film.format(), control);
  estimator.render_pass(key, learned.get(), scene, film, control);
}

void LearningLoop::use(std::shared_ptr<const Learned> value) {
  value_ = std::move(value);
  for_all_seeds_ = true;
}

void LearningLoop::add_state(const Estimator& estimator, const FilmFormat& format, std::string name,
                             RenderState& state) {
  const auto save = [this]() -> std::vector<uint32_t> {
    if (!value_ && (seed_ || read_nothing_)) return {kLearnsNothing};
    if (!value_ || !seed_) return {};
    ByteWriter to;
    to(kLayout, *seed_);
    value_->write(to);
    const std::vector<std::byte>& bytes = to.bytes();
    std::vector<uint32_t> words(1 + (bytes.size() + 3) / 4);
    if (words.size() > kMaxWords) return {};
    words[0] = static_cast<uint32_t>(bytes.size());
    std::memcpy(words.data() + 1, bytes.data(), bytes.size());
    return words;
  };
  const auto load = [this, &estimator, &format](std::span<const uint32_t> words) {
    if (words.empty()) return;
    read_nothing_ = words.size() == 1 && words[0] == kLearnsNothing;
    if (read_nothing_) return;
    const std::span<const std::byte> bytes = std::as_bytes(words.subspan(1));
    if (words[0] > bytes.size() || words[0] + 4 <= bytes.size())
      throw IoError("its length is wrong");
    ByteReader from(bytes.first(words[0]));
    uint32_t layout = 0;
    uint64_t seed = 0;
    from(layout);
    if (layout != kLayout) throw IoError("another build of the program wrote it");
    from(seed);
    auto value = estimator.read_learned(from, format);
    if (!value || !from.at_end()) throw IoError("its contents do not fit this estimator");
    value_ = std::move(value);
    seed_ = seed;
    was_read_ = true;
  };
  state.streams.push_back({std::move(name), kMaxWords, save, load});
}

void LearningLoop::add_to(EstimatorStatistics& statistics) const {
  if (!value_) return;
  const uint64_t rays = statistics.rays, learning_rays = statistics.learning_rays;
  value_->add_to(statistics);
  if (!was_read_) return;
  statistics.rays = rays;
  statistics.learning_rays = learning_rays;
}

}  // namespace nephroid
