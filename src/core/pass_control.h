// Who watches a pass while it is rendered: between the chunks of its loops they may look at what is
// done by then, or end it. It must not know films or clocks.
#pragma once

namespace nephroid {

/// What attend() throws to end a pass early. Not an error: whatever is done by then stays.
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
