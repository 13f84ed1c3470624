// Foretells how long passes take, from the passes before and from the progress of the groups of
// estimates within a pass. It must not know films or clocks.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace nephroid {

/// Times are seconds from any origin. `fractions` has the progress of each group in the pass, 0 to
/// 1; groups are rendered one after another.
class PassForecast {
 public:
  /// A pass begins. Parts of it may be done already.
  void begin(double now, std::span<const double> fractions);
  /// Called now and then within the pass.
  void look(double now, std::span<const double> fractions);
  /// The pass has ended.
  void end(double now);

  /// Seconds of a pass; empty until something is known.
  std::optional<double> seconds_of_pass() const;
  /// Seconds until the end of the open pass; empty until something is known, 0 if none is open.
  std::optional<double> seconds_left(double now) const;

 private:
  void look_at_group(double now, size_t group, double fraction);

  std::vector<double> begun_with_;  ///< fractions at the begin of the open pass
  double part_ = 1;                 ///< of the open pass that was to do at its begin
  double begin_ = 0;                ///< of the open pass
  bool is_open_ = false;
  size_t group_ = 0;  ///< the one that is being rendered
  double group_begin_ = 0;
  double pixels_begin_ = 0;    ///< last time at which none of its pixels were done
  std::optional<double> end_;  ///< of the open pass, from its own progress
  double first_seconds_ = 0;   ///< of the first pass, with all that is learned before
  double later_seconds_ = 0;   ///< of all later passes
  int ended_ = 0;              ///< number of passes
};

}  // namespace nephroid
