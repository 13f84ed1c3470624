#include "integrator/bidirectional/light_batches.h"

#include <algorithm>

#include "core/parallel.h"
#include "photon/light_walk.h"

namespace nephroid {

namespace {

constexpr uint64_t kVcmLightStream = 0x76636d6c;  // "vcml"
constexpr int64_t kBatchChunk = 1024;
constexpr int64_t kBatchGroup = 32 * kBatchChunk;

float median_distance_in_media(const std::vector<Photon>& photons, const Vec3f& eye) {
  std::vector<float> distances;
  for (const Photon& photon : photons)
    if (photon.medium >= 0) distances.push_back(length(photon.p - eye));
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace

template <class F>
void LightBatches::at_path(int64_t j, F&& f) const {
  const uint64_t number = uint64_t{pass_.trace.key.pass} * config_.light_paths + j;
  LightPathSequence sequence{hash_combine(config_.seed, kVcmLightStream), kLightPathDimensions};
  if (config_.number_varies) sequence.variant = config_.light_paths;
  sequence.at(number, [&](PathSampler& sampler) {
    f(sampler, with_own_hero(pass_.trace.lambda, config_.seed, number));
  });
}

LightPathCounts LightBatches::trace_path(int64_t j, std::vector<CameraSplat>& seen,
                                         std::vector<Photon>& photons) const {
  LightPathCounts counts;
  at_path(j, [&](PathSampler& sampler, const SampledWavelengths& lambda) {
    counts = trace_light_path(settings_, lambda, pass_.u_time, sampler, nullptr, &seen, &photons);
  });
  return counts;
}

LightPathRecord LightBatches::record_path(int64_t j) const {
  LightPathRecord record;
  at_path(j, [&](PathSampler& sampler, const SampledWavelengths& lambda) {
    record = record_light_path(settings_, lambda, pass_.u_time, sampler);
  });
  return record;
}

void LightBatches::trace_chunk(int64_t begin, int64_t end, Chunk& chunk) const {
  std::vector<CameraSplat> seen;
  for (int64_t j = begin; j < end; ++j) {
    seen.clear();
    const size_t before = chunk.photons.size();
    const LightPathCounts counts = trace_path(j, seen, chunk.photons);
    chunk.rays += counts.rays;
    chunk.specular += counts.specular;
    chunk.useful += chunk.photons.size() > before;
    for (const CameraSplat& c : seen)
      for (int i = 0; i < c.seen.count; ++i)
        chunk.splats.push_back({c.seen.film[i], static_cast<uint8_t>(places_.place(c.part)),
                                pass_.weights.apply(c.value), c.lamp});
  }
}

/// Reserves memory for the photons of the chunks and those expected in the rest of the batch. Step
/// by step, growth would take twice as much.
void LightBatches::reserve(std::vector<Photon>& photons, std::span<const Chunk> chunks,
                           int64_t batch_begin) const {
  constexpr double kMemorySlack = 1.02;
  size_t needed = photons.size();
  for (const Chunk& chunk : chunks) needed += chunk.photons.size();
  if (needed <= photons.capacity()) return;
  const double of_path = static_cast<double>(needed) / static_cast<double>(begin_ - batch_begin);
  const double all = of_path * static_cast<double>(config_.light_paths - batch_begin);
  // The group that exceeds the limit is kept as a whole.
  const double most = static_cast<double>(config_.memory_photons) + of_path * kBatchGroup;
  photons.reserve(std::max(needed, static_cast<size_t>(kMemorySlack * std::min(all, most))));
}

std::vector<Photon> LightBatches::next(const std::function<void(std::span<const Splat>)>& expose,
                                       EstimatorStatistics& statistics) {
  const int64_t batch_begin = begin_;
  std::vector<Photon> photons;
  while (!empty() && static_cast<int64_t>(photons.size()) < config_.memory_photons) {
    const int64_t count = std::min(kBatchGroup, config_.light_paths - begin_);
    std::vector<Chunk> chunks = chunk_results<Chunk>(
        *pass_.trace.control, count, kBatchChunk,
        [&](Chunk& chunk, int64_t b, int64_t e) { trace_chunk(begin_ + b, begin_ + e, chunk); });
    begin_ += count;
    reserve(photons, chunks, batch_begin);
    std::vector<Splat> splats;
    for (Chunk& chunk : chunks) {
      photons.insert(photons.end(), chunk.photons.begin(), chunk.photons.end());
      chunk.photons = std::vector<Photon>();
      splats.insert(splats.end(), chunk.splats.begin(), chunk.splats.end());
      statistics.rays += chunk.rays;
      statistics.light_rays += chunk.rays;
      statistics.photon_paths_useful += chunk.useful;
      statistics.photon_paths_specular += chunk.specular;
    }
    if (begin_ == count)
      media_distance_ = median_distance_in_media(photons, settings_.merging->eye);
    expose(splats);
    statistics.splats += splats.size();
  }
  statistics.photons_stored += photons.size();
  return photons;
}

}  // namespace nephroid
