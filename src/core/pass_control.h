// Lets a caller inspect or end a pass between two chunks of a loop. It must not know films or
// clocks.
#pragma once

namespace nephroid {

/// Thrown by attend() to end a pass early. It is not an error, and finished chunks are kept.
struct PassStopped {};

class PassControl {
 public:
  virtual ~PassControl() = default;
  /// True if attend() should be called soon. Asked between chunks by any thread.
  virtual bool is_wanted() const noexcept = 0;
  /// Called by the loop's thread while no chunk runs. May throw PassStopped.
  virtual void attend() = 0;
};

/// Never wants to attend.
class Unwatched final : public PassControl {
 public:
  bool is_wanted() const noexcept override { return false; }
  void attend() override {}
};
inline Unwatched unwatched;

}  // namespace nephroid
