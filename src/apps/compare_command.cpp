// `nephroid compare`: prints errors between two pictures and writes a heat map.
#include <fmt/format.h>

#include "apps/commands.h"
#include "core/counted.h"
#include "film/atomic_file.h"
#include "image/compare.h"
#include "image/flip.h"

namespace nephroid {
namespace {

void print_dim_mean(const MeanRatio& ratio) {
  if (ratio.pixels == 0) {
    fmt::print("mean_rel below 10: no such pixels\n");
    return;
  }
  if (!ratio.is_defined()) {
    fmt::print("mean_rel below 10: undefined, the reference is black there\n");
    return;
  }
  fmt::print("mean_rel below 10: {:.6g}", ratio.value);
  if (ratio.half_width) fmt::print(" +- {:.3g} (95 %)", *ratio.half_width);
  fmt::print(" over {}\n", counted(ratio.pixels, "pixel"));
}

}  // namespace

int run_compare(const CompareCommand& command) {
  if (!command.heat_map.empty()) check_file_can_be_written(command.heat_map);
  const Picture reference = read_picture(command.reference);
  const Picture test = read_picture(command.test);
  CompareOptions options;
  options.subtract_reference_error = command.subtract_reference_error;
  const Comparison result = compare_pictures(reference, test, options);
  fmt::print("rmse={:.6g} relmse={:.6g} relmse_trim={:.6g}", result.rmse, result.relmse,
             result.relmse_trim);
  if (result.mean.is_defined())
    fmt::print(" mean_rel={:.6g}\n", result.mean.value);
  else
    fmt::print("\nmean_rel: undefined, the reference is black\n");
  fmt::print("flip={:.6g} (mean, at exposure {:g})\n", flip(reference, test, command.exposure),
             command.exposure);
  print_dim_mean(result.dim_mean);
  if (result.is_same)
    fmt::print("the pictures are the same: R, G and B are equal in every pixel\n");
  if (result.deviations)
    fmt::print(
        "z_within={:.5g} z_rms={:.4g} z_in_95={:.4g} (z is the difference over its stated error: "
        "z_rms is 1 and z_in_95 is 0.95 if the errors are right; z_within is the share of pixels "
        "with |z| < {:g} in all channels)\n",
        result.deviations->share_within, result.deviations->rms, result.deviations->share_in_95,
        kDeviationLimit);
  if (!command.heat_map.empty()) {
    write_heat_map(command.heat_map, reference, test);
    fmt::print("{}wrote {}\n", heat_map_legend(), command.heat_map);
  }
  return static_cast<int>(ExitStatus::kDone);
}

}  // namespace nephroid
