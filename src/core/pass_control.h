// Lets somebody else look at a pass while it is rendered, or end it, between two chunks of a loop.
// It must not know films or clocks.
#pragma once

namespace nephroid {

/// Thrown by attend() to end a pass early. It is not an error, and finished chunks are kept.
struct PassStopped {};

class PassControl {
 public:
  virtual ~PassControl() = default;
  /// True if attend() is to be called soon. Asked between chunks by any thread.
  virtual bool is_wanted() const noexcept = 0;
  /// Called by the thread that runs the loop while no chunk of it runs. May throw PassStopped.
  virtual void attend() = 0;
};

/// Nobody watches.
class Unwatched final : public PassControl {
 public:
  bool is_wanted() const noexcept override { return false; }
  void attend() override {}
};
inline Unwatched unwatched;

}  // namespace nephroid
