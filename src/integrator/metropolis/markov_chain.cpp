#include "integrator/metropolis/markov_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/parallel.h"

namespace nephroid {

namespace {

constexpr uint64_t kBootstrapStream = 0x626f6f74;  // "boot"
constexpr uint64_t kPilotStream = 0x70696c6f74;    // "pilot"
constexpr uint64_t kChainStream = 0x636861696e;    // "chain"
constexpr uint64_t kStartStream = 0x7374617274;    // "start"

/// Dimensions of each stream that are stratified over the independent paths of all passes.
constexpr int kStratified = 24;
constexpr int64_t kPathsPerChunk = 1024;
/// Limit of paths whose light is kept at once.
constexpr int64_t kPathsAtOnce = int64_t{1} << 18;

/// The numbers of independent path `number`, counted over all passes: a point of one scrambled
/// Sobol' sequence, whose first dimensions are divided among the streams.
MarkovSample::Origin independent_numbers(uint64_t seed, uint64_t stream, uint64_t number) {
  const auto point = std::make_shared<SobolPoint>(static_cast<uint32_t>(number),
                                                  kStratified * MarkovSample::kStreams);
  const uint64_t path_seed = hash_combine(seed, stream, number >> 32);
  return [point, path_seed](int stream_of_numbers, int dimension) {
    // Later dimensions are beyond those of the point, so their numbers are random.
    constexpr int kBeyond = 1 << 24;
    PathSampler sampler(*point, path_seed);
    sampler.start_dimension(dimension < kStratified
                                ? stream_of_numbers * kStratified + dimension
                                : (stream_of_numbers + 1) * kBeyond + dimension);
    return sampler.get_1d();
  };
}

struct ChainChunk {
  std::vector<Splat> splats, bad;
  ChainStatistics statistics;
};

/// Renders one pass.
class ChainPass {
 public:
  ChainPass(const PassKey& key, const ChainSettings& settings, const ChainPilot& pilot,
            const PathFunctionMaker& make, SplatBuffer& buffer, PassControl& control)
      : key_(key),
        settings_(settings),
        mutations_(static_cast<double>(settings.chains * settings.mutations)),
        independent_(static_cast<double>(settings.bootstrap) + settings.large_step * mutations_),
        importance_(pilot.importance),
        balance_(pilot.balance > 0 ? pilot.balance : 1),
        make_(make),
        buffer_(buffer),
        control_(control) {}

  void run() {
    draw_bootstrap();
    const double total = choose_starts();
    ratio_ = total / static_cast<double>(settings_.bootstrap) / balance_;
    const int64_t at_once = std::max<int64_t>(1, kPathsAtOnce / settings_.mutations);
    for (int64_t first = 0; first < settings_.chains; first += at_once) {
      const int64_t count = std::min(at_once, settings_.chains - first);
      std::vector<ChainChunk> chunks(count);
      parallel_chunks(control_, count, 1,
                      [&](int64_t c, int64_t, int64_t) { run_chain(first + c, chunks[c]); });
      take(chunks);
    }
  }
  const ChainStatistics& statistics() const { return statistics_; }

 private:
  MarkovSample::Origin bootstrap_numbers(int64_t path) const {
    const uint64_t paths = settings_.bootstrap;
    return independent_numbers(key_.seed, kBootstrapStream, uint64_t{key_.pass} * paths + path);
  }

  /// [Z5] Adds light that counts `times` times.
  void expose(const FoundLight& found, double target, double times, ChainChunk& out) const {
    if (!(times > 0)) return;
    const double scale = times / (independent_ + mutations_ * target / balance_);
    for (const Splat& splat : found.splats)
      out.splats.push_back({splat.film, splat.part, splat.value * static_cast<float>(scale)});
  }

  void draw_bootstrap() {
    targets_.resize(settings_.bootstrap);
    for (int64_t first = 0; first < settings_.bootstrap; first += kPathsAtOnce) {
      const int64_t count = std::min(kPathsAtOnce, settings_.bootstrap - first);
      std::vector<ChainChunk> chunks(chunk_count(count, kPathsPerChunk));
      parallel_chunks(control_, count, kPathsPerChunk, [&](int64_t c, int64_t begin, int64_t end) {
        ChainChunk& out = chunks[c];
        const std::unique_ptr<PathFunction> function = make_();
        FoundLight found;
        MarkovSample numbers(settings_.small_step);
        for (int64_t j = first + begin; j < first + end; ++j) {
          numbers.start(bootstrap_numbers(j), 0);
          found.splats.clear();
          function->evaluate(numbers, found);
          const double target = found.target(importance_);
          targets_[j] = target;
          out.statistics.bootstrap_lit += target > 0;
          expose(found, target, 1, out);
        }
        out.statistics.bootstrap += end - begin;
        out.statistics.paths += end - begin;
        out.statistics.rays += found.rays;
        out.bad = found.bad;
      });
      take(chunks);
    }
  }

  /// Chooses a bootstrap path for each chain, in proportion to the target (systematic sampling).
  /// If all are black, the choice is arbitrary. Returns the sum of the targets.
  double choose_starts() {
    double total = 0;
    for (const double b : targets_) total += b;
    const double offset =
        bits_to_unit_float(static_cast<uint32_t>(hash_combine(key_.seed, kStartStream, key_.pass)));
    double sum = 0;
    size_t j = 0;
    for (int64_t c = 0; c < settings_.chains; ++c) {
      if (!(total > 0)) {
        starts_.push_back(c % settings_.bootstrap);
        continue;
      }
      const double at =
          (static_cast<double>(c) + offset) / static_cast<double>(settings_.chains) * total;
      while (j + 1 < targets_.size() && sum + targets_[j] <= at) sum += targets_[j++];
      starts_.push_back(j);
    }
    return total;
  }

  void run_chain(int64_t number, ChainChunk& out) const {
    const int64_t start = starts_[number];
    const std::unique_ptr<PathFunction> function = make_();
    MarkovChain chain(bootstrap_numbers(start),
                      hash_combine(key_.seed, kChainStream, key_.pass, number), settings_,
                      importance_, *function);
    ChainStatistics& s = out.statistics;
    double times = 0;  // weight of the current state
    for (int64_t i = 0; i < settings_.mutations; ++i) {
      chain.propose();
      const double acceptance = chain.acceptance();
      times += (1 - acceptance) * ratio_;
      const double times_proposed = acceptance * ratio_ + (chain.is_large() ? 1 : 0);
      const bool accepted = chain.decide();
      if (accepted) {
        expose(chain.proposed(), chain.proposed_target(), times, out);  // the former current state
        times = times_proposed;
      } else {
        expose(chain.proposed(), chain.proposed_target(), times_proposed, out);
      }
      (chain.is_large() ? s.large : s.small) += 1;
      (chain.is_large() ? s.large_accepted : s.small_accepted) += accepted;
    }
    expose(chain.current(), chain.target(), times, out);
    s.paths += settings_.mutations;
    for (const FoundLight* found : {&chain.current(), &chain.proposed()}) {
      s.rays += found->rays;
      out.bad.insert(out.bad.end(), found->bad.begin(), found->bad.end());
    }
  }

  void take(const std::vector<ChainChunk>& chunks) {
    std::vector<Splat> splats;
    for (const ChainChunk& chunk : chunks) {
      splats.insert(splats.end(), chunk.splats.begin(), chunk.splats.end());
      statistics_.add(chunk.statistics);
      buffer_.add(chunk.bad);  // the buffer counts non-finite splats
    }
    buffer_.add(splats);
    statistics_.splats += splats.size();
  }

  const PassKey key_;
  const ChainSettings& settings_;
  const double mutations_;    ///< M, mutations of all chains
  const double independent_;  ///< n, mean number of independent paths: bootstrap and large steps
  const FilmImportance& importance_;
  const double balance_;
  const PathFunctionMaker& make_;
  SplatBuffer& buffer_;
  PassControl& control_;
  std::vector<double> targets_;  ///< [bootstrap path]
  std::vector<int64_t> starts_;  ///< [chain] index of its bootstrap path
  double ratio_ = 0;             ///< b̂/b of [Z5]: mean bootstrap target over the balance
  ChainStatistics statistics_;
};

}  // namespace

void FoundLight::add(const Vec2f& film, size_t part, const Rgb& value) {
  const float sum = value.r + value.g + value.b;
  if (!std::isfinite(sum)) {
    // Finite components may have a non-finite sum.
    const float nan = std::numeric_limits<float>::quiet_NaN();
    bad.push_back({film, static_cast<uint8_t>(part), {nan, nan, nan}});
    return;
  }
  if (value.r == 0 && value.g == 0 && value.b == 0) return;
  splats.push_back({film, static_cast<uint8_t>(part), value});
}

double FoundLight::target(const FilmImportance& importance) const {
  double sum = 0;
  for (const Splat& s : splats) sum += brightness_of(s.value) * importance.at(s.film);
  return sum;
}

bool ChainPilot::is_sound() const {
  const auto is_mean = [](double x) { return x >= 0 && std::isfinite(x); };
  return std::ranges::all_of(kinds, is_mean) && is_mean(balance);
}

double brightness_of(const Rgb& color) {
  return (std::abs(double{color.r}) + std::abs(double{color.g}) + std::abs(double{color.b})) / 3;
}

void ChainStatistics::add(const ChainStatistics& o) {
  rays += o.rays;
  paths += o.paths;
  bootstrap += o.bootstrap;
  bootstrap_lit += o.bootstrap_lit;
  large += o.large;
  large_accepted += o.large_accepted;
  small += o.small;
  small_accepted += o.small_accepted;
  splats += o.splats;
}

MarkovChain::MarkovChain(MarkovSample::Origin origin, uint64_t seed, const ChainSettings& settings,
                         const FilmImportance& importance, PathFunction& function)
    : numbers_(settings.small_step),
      function_(function),
      importance_(importance),
      large_step_(settings.large_step) {
  numbers_.start(std::move(origin), seed);
  evaluate(now_);
}

void MarkovChain::evaluate(size_t state) {
  states_[state].splats.clear();
  function_.evaluate(numbers_, states_[state]);
  targets_[state] = states_[state].target(importance_);
}

void MarkovChain::propose() {
  large_ = numbers_.propose(large_step_);
  evaluate(1 - now_);
}

double MarkovChain::acceptance() const {
  const double from = targets_[now_], to = targets_[1 - now_];
  return to < from ? to / from : 1.0;
}

bool MarkovChain::decide() {
  if (!(double{numbers_.decision()} < acceptance())) {
    numbers_.reject();
    return false;
  }
  numbers_.accept();
  now_ = 1 - now_;
  return true;
}

ChainPilot look_around(uint64_t seed, int64_t count, const FilmArea& area, size_t kinds,
                       const PathFunctionMaker& make, PassControl& control) {
  std::vector<std::vector<FoundLight>> chunks(chunk_count(count, kPathsPerChunk));
  parallel_chunks(control, count, kPathsPerChunk, [&](int64_t c, int64_t begin, int64_t end) {
    const std::unique_ptr<PathFunction> function = make();
    FoundLight found;
    MarkovSample numbers({});
    for (int64_t j = begin; j < end; ++j) {
      numbers.start(independent_numbers(seed, kPilotStream, j), 0);
      found.splats.clear();
      found.bad.clear();  // passes count them
      function->evaluate(numbers, found);
      if (!found.splats.empty()) chunks[c].push_back(found);
    }
  });
  ChainPilot pilot{FilmImportance(area), std::vector<double>(kinds, 0.0), 0};
  for (const auto& chunk : chunks)
    for (const FoundLight& found : chunk)
      for (const Splat& s : found.splats) pilot.importance.record(s.film, brightness_of(s.value));
  pilot.importance.learn();
  for (const auto& chunk : chunks)
    for (const FoundLight& found : chunk) {
      const double target = found.target(pilot.importance);
      pilot.balance += target / static_cast<double>(count);
      pilot.kinds[found.kind] += sqr(target) / static_cast<double>(count);
    }
  return pilot;
}

void render_chains(const PassKey& key, const ChainSettings& settings, const ChainPilot& pilot,
                   const PathFunctionMaker& make, SplatBuffer& buffer, ChainStatistics& statistics,
                   PassControl& control) {
  ChainPass pass(key, settings, pilot, make, buffer, control);
  pass.run();
  statistics.add(pass.statistics());
}

}  // namespace nephroid
