#include "session/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "core/errors.h"
#include "core/parallel.h"
#include "integrator/estimator/path_tally.h"
#include "integrator/estimator/pixel_pass.h"
#include "scene/camera/camera.h"
#include "session/inspection_stand_in.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x696e7370656374;  // "inspect"
/// The passes of a series share their seed, so their wavelengths are stratified. Independent series
/// give the errors.
constexpr int kSeries = 8, kPassesOfSeries = 8, kPasses = kSeries * kPassesOfSeries;

/// Means of the series of a sum of paths.
using SeriesMeans = std::array<ColorSum, kSeries>;

/// An estimator whose paths are recorded.
struct Recorded {
  const Estimator* estimator = nullptr;
  const Learned* learned = nullptr;
  const Routes* routes = nullptr;
};

class Inspector {
 public:
  Inspector(const Scene& scene, const Film& film, int x, int y, const InspectionSettings& settings)
      : scene_(scene), film_(film), settings_(settings), letters_(scene) {
    found_.x = x;
    found_.y = y;
  }

  PixelInspection run(EstimatorSet& set) {
    read_film();
    radius_pass_ = last_pass(set);
    std::optional<StandIn> stand_in = stand_in_for(set, scene_, settings_.options);
    std::vector<Recorded> recorded = estimators_of(set, [&](const Estimator& estimator) {
      return !stand_in || !stand_in->replaces(estimator);
    });
    if (stand_in) {
      found_.notes.push_back(stand_in->note);
      for (const Recorded& r : estimators_of(stand_in->set, [&](const Estimator& estimator) {
             return stand_in->replaces(estimator);
           }))
        recorded.push_back(r);
    }
    trace(recorded, *set.routes);
    add_up();
    add_words(*set.routes);
    return std::move(found_);
  }

 private:
  void read_film() {
    const int x = found_.x, y = found_.y;
    found_.value = film_.value(x, y);
    found_.standard_error = film_.standard_error(x, y);
    const FilmLayout& layout = film_.layout();
    for (size_t r = 0; r < layout.routes.size(); ++r)
      found_.routes.push_back({layout.routes[r], film_.route_value(static_cast<int>(r), x, y)});
    for (size_t a = 0; a < layout.aovs.size(); ++a)
      found_.layers.push_back({layout.aovs[a], film_.aov_value(static_cast<int>(a), x, y)});
    found_.samples = film_.samples(x, y);
  }

  /// The last of the passes that all groups have of this pixel, whose radius paths merge with. A
  /// group with a state of its own per pixel does not count its passes there.
  uint32_t last_pass(const EstimatorSet& set) const {
    uint64_t passes = std::numeric_limits<uint64_t>::max();
    for (size_t g = 0; g < set.routes->groups().size(); ++g)
      if (!set.estimators[g]->descriptor().capabilities.per_pixel_state)
        passes = std::min(passes, film_.estimates(static_cast<int>(g), found_.x, found_.y));
    if (passes == std::numeric_limits<uint64_t>::max()) return 0;
    return static_cast<uint32_t>(std::max<uint64_t>(passes, 1) - 1);
  }

  /// The estimators of the set that are wanted and can be recorded; they learn if needed.
  template <class Wanted>
  std::vector<Recorded> estimators_of(EstimatorSet& set, const Wanted& wanted) {
    set.learned.resize(set.estimators.size());
    std::vector<Recorded> all;
    for (size_t g = 0; g < set.routes->groups().size(); ++g) {
      const Estimator& estimator = *set.estimators[g];
      if (!estimator.records_pixels() || !wanted(estimator)) continue;
      const auto& learned = set.learned[g].learn(estimator, settings_.seed, scene_, film_.format());
      all.push_back({&estimator, learned.get(), set.routes.get()});
    }
    return all;
  }

  /// Runs all passes and adds them up by series.
  void trace(const std::vector<Recorded>& recorded, const Routes& routes) {
    const int64_t tasks = static_cast<int64_t>(recorded.size()) * kPasses;
    std::vector<std::unique_ptr<PathTally>> tallies(tasks);
    parallel_chunks(tasks, 1, [&](int64_t task, int64_t, int64_t) {
      const Recorded& r = recorded[task / kPasses];
      const uint64_t pass = task % kPasses;
      tallies[task] = std::make_unique<PathTally>(*r.routes, letters_);
      r.estimator->record_pixel(
          {.key = {hash_combine(settings_.seed, kStream, pass / kPassesOfSeries),
                   static_cast<uint32_t>(pass % kPassesOfSeries)},
           .scene = scene_,
           .film = film_.format(),
           .x = found_.x,
           .y = found_.y,
           .camera_paths = std::max(1, settings_.camera_paths / kPasses),
           .light_paths = std::max<int64_t>(1, settings_.light_paths / kPasses),
           .radius_pass = radius_pass_},
          r.learned, *tallies[task]);
    });
    for (int s = 0; s < kSeries; ++s)
      series_.push_back(std::make_unique<PathTally>(routes, letters_));
    all_ = std::make_unique<PathTally>(routes, letters_);
    for (int64_t task = 0; task < tasks; ++task) {
      series_[task % kPasses / kPassesOfSeries]->add(*tallies[task]);
      all_->add(*tallies[task]);
    }
  }

  SeriesMeans means_of(const WordTally& word) const {
    SeriesMeans means;
    for (int s = 0; s < kSeries; ++s)
      if (const WordTally* of_series = series_[s]->find(word))
        means[s] = of_series->total() * (1.0 / kPassesOfSeries);
    return means;
  }

  double luminance(const Rgb& color) const { return film_.settings().color_space->to_xyz(color).y; }
  double luminance(const ColorSum& color) const { return luminance(color.rounded()); }
  static Rgb mean_of(const SeriesMeans& means) {
    ColorSum sum;
    for (const ColorSum& mean : means) sum += mean;
    return (sum * (1.0 / kSeries)).rounded();
  }
  /// Standard error of the mean of (luminance - share * luminance of all paths).
  double error_of(const SeriesMeans& means, double share) const {
    std::array<double, kSeries> values{};
    double mean = 0, squares = 0;
    for (int s = 0; s < kSeries; ++s) {
      values[s] = luminance(means[s]) - share * luminance(total_[s]);
      mean += values[s] / kSeries;
    }
    for (const double value : values) squares += sqr(value - mean);
    return std::sqrt(squares / (kSeries * (kSeries - 1)));
  }
  EstimatedShare estimate(std::string name, const SeriesMeans& means) const {
    EstimatedShare e{std::move(name), mean_of(means), error_of(means, 0)};
    const double all = luminance(found_.traced);
    if (!(all > 0)) return e;
    e.share = luminance(e.value) / all;
    e.share_error = error_of(means, e.share) / all;
    return e;
  }
  static void add(const SeriesMeans& some, SeriesMeans& to) {
    for (int s = 0; s < kSeries; ++s) to[s] += some[s];
  }
  /// The estimates of the names, brightest first.
  std::vector<EstimatedShare> sorted(const std::map<std::string, SeriesMeans>& sums) const {
    std::vector<EstimatedShare> all;
    for (const auto& [name, means] : sums) {
      all.push_back(estimate(name, means));
      if (luminance(all.back().value) == 0) all.pop_back();
    }
    std::ranges::stable_sort(
        all, [](const EstimatedShare& a, const EstimatedShare& b) { return a.share > b.share; });
    return all;
  }

  /// Sums over all words, by light and by technique.
  void add_up() {
    std::map<std::string, SeriesMeans> lights, techniques;
    for (const WordTally& word : all_->words()) {
      const SeriesMeans means = means_of(word);
      add(means, total_);
      add(means, lights[letters_.label(word.word.back())]);
    }
    for (int s = 0; s < kSeries; ++s)
      for (const WordTally& word : series_[s]->words())
        for (size_t t = 0; t < kTechniqueCount; ++t)
          techniques[technique_name(static_cast<Technique>(t))][s] +=
              word.light[t] * (1.0 / kPassesOfSeries);
    found_.traced = mean_of(total_);
    found_.traced_error = error_of(total_, 0);
    found_.lights = sorted(lights);
    found_.techniques = sorted(techniques);
  }

  const char* main_technique(const WordTally& word) const {
    size_t most = 0;
    for (size_t t = 1; t < kTechniqueCount; ++t)
      if (luminance(word.light[t]) > luminance(word.light[most])) most = t;
    return technique_name(static_cast<Technique>(most));
  }

  std::vector<Vec2f> pixels_of(const std::vector<Vec3f>& points) const {
    // The lens lies in the pixel's direction.
    std::vector<Vec2f> pixels{
        Vec2f(static_cast<float>(found_.x) + 0.5f, static_cast<float>(found_.y) + 0.5f)};
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    for (size_t i = 1; i < points.size(); ++i) {
      const auto line = scene_.camera->connect(points[i], {0.5f, 0.5f}, 0.5f);
      pixels.push_back(line ? line->film : Vec2f(kNan, kNan));
    }
    return pixels;
  }

  void add_words(const Routes& routes) {
    std::vector<const WordTally*> words;
    for (const WordTally& word : all_->words())
      if (luminance(word.total()) > 0) words.push_back(&word);
    std::ranges::stable_sort(words, [&](const WordTally* a, const WordTally* b) {
      return luminance(a->total()) > luminance(b->total());
    });
    if (words.size() > PixelInspection::kMaxWords) words.resize(PixelInspection::kMaxWords);
    for (const WordTally* word : words) {
      const EstimatedShare e = estimate(letters_.text(word->word), means_of(*word));
      found_.paths.push_back({.word = e.name,
                              .route = routes.definitions()[word->route].name,
                              .light = letters_.label(word->word.back()),
                              .value = e.value,
                              .share = e.share,
                              .share_error = e.share_error,
                              .technique = main_technique(*word),
                              .points = word->points,
                              .pixels = pixels_of(word->points)});
    }
    if (!scene_.camera->connects())
      found_.notes.emplace_back("points cannot be projected through this camera's lenses");
  }

  const Scene& scene_;
  const Film& film_;
  const InspectionSettings& settings_;
  const PathLetters letters_;
  PixelInspection found_;
  uint32_t radius_pass_ = 0;
  std::vector<std::unique_ptr<PathTally>> series_;
  std::unique_ptr<PathTally> all_;
  SeriesMeans total_;
};

}  // namespace

PixelInspection inspect_pixel(const Scene& scene, EstimatorSet& set, const Film& film, int x, int y,
                              const InspectionSettings& settings) {
  const PixelBounds& b = film.bounds();
  if (x < b.x0 || x >= b.x1 || y < b.y0 || y >= b.y1)
    throw UsageError(fmt::format(
        "pixel {},{}: outside of the picture, expected x from {} to {} and y from {} to {}", x, y,
        b.x0, b.x1 - 1, b.y0, b.y1 - 1));
  return Inspector(scene, film, x, y, settings).run(set);
}

}  // namespace nephroid
