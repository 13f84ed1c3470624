// Estimates how long passes take, from the passes before and from the progress of the groups of
// estimates within a pass. It must not know films or clocks.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace nephroid {

/// Times are seconds from any origin. `fractions` has the progress of each group in the pass, 0 to
/// 1, of one group at least; groups are rendered one after another.
class PassTimeEstimate {
 public:
  /// A pass begins. Parts of it may be done already.
  void begin(double now, std::span<const double> fractions);
  /// Called now and then within the pass.
  void observe(double now, std::span<const double> fractions);
  /// The pass has ended.
  void end(double now);

  /// Seconds of a whole pass; empty until something is known.
  std::optional<double> seconds_of_pass() const;
  /// Seconds until the end of the open pass; empty until something is known, 0 if none is open or
  /// if it takes longer than it was to.
  std::optional<double> seconds_left(double now) const;

 private:
  void observe_group(double now, size_t group, double fraction);

  bool is_open_ = false;
  bool was_begun_before_ = false;  ///< parts of the open pass were done when it began
  std::vector<double> fractions_;  ///< progress of each group when the open pass began
  double pass_start_ = 0;
  double last_observed_ = 0;
  size_t group_ = 0;  ///< the group that is being rendered
  double group_start_ = 0;
  double pixels_start_ = 0;  ///< last time when none of its pixels were done
  std::optional<double>
      pass_end_;                 ///< when the open pass will end if its pixels go on at this speed
  int passes_ = 0;               ///< passes that this object saw from begin to end
  double seconds_of_first_ = 0;  ///< with all that is learned before it
  double seconds_of_others_ = 0;
};

}  // namespace nephroid
