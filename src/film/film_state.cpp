// The film as a RenderState, and the sum of two films.
#include <algorithm>
#include <cassert>

#include "core/parallel.h"
#include "film/film.h"

namespace nephroid {

RenderState Film::state() {
  RenderState state;
  const auto numbered = [](std::string name, size_t i) { return name + std::to_string(i); };
  const auto add_sums = [&](const std::string& kind, std::vector<PixelSums>& all) {
    for (size_t i = 0; i < all.size(); ++i) {
      PixelSums& sums = all[i];
      state.add(numbered("film." + kind, i), sums.words());
      state.streams.push_back(
          {numbered("film.carries." + kind, i), sums.most_carry_words(),
           [&sums] { return sums.save_carries(); },
           [&sums](std::span<const uint32_t> words) { sums.load_carries(words); }});
    }
  };
  add_sums("sum.", sums_);
  add_sums("layer.", layers_);
  add_sums("square.", squares_);
  for (size_t g = 0; g < biases_.size(); ++g)
    if (!biases_[g].empty()) state.add(numbered("film.bias.", g), biases_[g].items());
  state.add("film.features", features_.items());
  state.add("film.depths", depths_.items());
  if (!surfaces_.empty()) {
    state.add("film.surfaces", surfaces_.items());
    state.add("film.surface_samples", surface_samples_.items());
  }
  state.add("film.bad", std::span(bad_));
  state.add("film.estimates", std::span(estimates_));
  state.add("film.saturated", std::span(&saturated_, 1));
  for (size_t g = 0; g < open_.size(); ++g) {
    state.add(numbered("film.open.slices.", g), std::span(open_[g].done));
    state.add(numbered("film.open.whole.", g), std::span(&open_[g].is_whole, 1));
    state.add(numbered("film.open.count.", g), std::span(&open_[g].slices, 1));
    state.add(numbered("film.open.estimates.", g), std::span(&open_[g].estimates, 1));
  }
  if (outliers_)
    state.streams.push_back({"film.outliers", outliers_->most_words(),
                             [this] { return outliers_->save(); },
                             [this](std::span<const uint32_t> words) { outliers_->load(words); }});
  return state;
}

void Film::add(const Film& other) {
  assert(!has_open_pass() && !other.has_open_pass());
  assert(!outliers_ && !other.outliers_ && other.sums_.size() == sums_.size() &&
         other.layers_.size() == layers_.size() && other.depths_.size() == depths_.size());
  parallel_chunks(depths_.size(), 1 << 14, [&](int64_t, int64_t b, int64_t e) {
    for (int64_t i = b; i < e; ++i) {
      bool fits = true;
      for (size_t p = 0; p < sums_.size(); ++p) fits &= sums_[p].add(i, other.sums_[p]);
      for (size_t l = 0; l < layers_.size(); ++l) fits &= layers_[l].add(i, other.layers_[l]);
      for (size_t g = 0; g < squares_.size(); ++g) fits &= squares_[g].add(i, other.squares_[g]);
      for (size_t g = 0; g < biases_.size(); ++g) {
        if (biases_[g].empty()) continue;
        fits &= biases_[g][i].sum.add(other.biases_[g][i].sum);
        fits &= biases_[g][i].square.add(other.biases_[g][i].square);
      }
      for (int c = 0; c < 3; ++c) {
        fits &= features_[i].albedo[c].add(other.features_[i].albedo[c]);
        fits &= features_[i].normal[c].add(other.features_[i].normal[c]);
      }
      fits &= features_[i].depth.add(other.features_[i].depth);
      depths_[i] += other.depths_[i];
      if (!surfaces_.empty()) {
        for (size_t k = 0; k < surfaces_[i].size(); ++k)
          fits &= surfaces_[i][k].add(other.surfaces_[i][k]);
        surface_samples_[i] += other.surface_samples_[i];
      }
      if (!fits) count_saturated(1);
    }
  });
  for (size_t g = 0; g < estimates_.size(); ++g) estimates_[g] += other.estimates_[g];
  for (size_t r = 0; r < bad_.size(); ++r) {
    bad_[r].count += other.bad_[r].count;
    bad_[r].first_pixel = std::min(bad_[r].first_pixel, other.bad_[r].first_pixel);
  }
  saturated_ += other.saturated_;
}

}  // namespace nephroid
