#include "integrator/photon_pass.h"

namespace nephroid {

PassSetting pass_setting(const PassKey& key) {
  // Two dimensions of one scrambled sequence over the passes: any run of passes covers both evenly.
  constexpr uint64_t kStream = 0x70617373;  // "pass"
  const SobolPoint point(key.pass);
  PathSampler sampler(point, hash_combine(key.seed, kStream));
  PassSetting setting;
  setting.lambda = SampledWavelengths::sample_visible(sampler.get_1d());
  setting.time = sampler.get_1d();
  return setting;
}

int64_t default_photons_per_pass(int64_t pixels) {
  constexpr int64_t kMin = 1 << 16, kMax = 1 << 20;
  return std::clamp<int64_t>(static_cast<int64_t>(std::bit_ceil(static_cast<uint64_t>(pixels))),
                             kMin, kMax);
}

}  // namespace nephroid
