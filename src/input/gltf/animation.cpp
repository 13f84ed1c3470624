#include "input/gltf/animation.h"

#include <algorithm>
#include <cmath>

#include "core/counted.h"
#include "input/gltf/accessor.h"

namespace nephroid::gltf {
namespace {

using Values = std::vector<float>;

/// The keyframes on both sides of a moment.
struct Interval {
  size_t before, after;
  double length;    ///< s
  double fraction;  ///< 0 at the key before, 1 at the key after
};

Interval find_interval(const std::vector<float>& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return {0, 0, 0, 0};
  const size_t before = static_cast<size_t>(after - times.begin()) - 1;
  if (after == times.end()) return {before, before, 0, 0};
  const double length = double{*after} - times[before];
  return {before, before + 1, length, (time - times[before]) / length};
}

/// Spherical interpolation of quaternions along the shorter arc (Shoemake 1985).
Values slerp(Values a, const Values& b, double t) {
  double cosine = 0;
  for (size_t i = 0; i < 4; ++i) cosine += double{a[i]} * b[i];
  const double sign = cosine < 0 ? -1 : 1;
  const double angle = std::acos(std::min(1.0, std::abs(cosine)));
  const bool is_small = angle < 1e-6;
  const double from = is_small ? 1 - t : std::sin((1 - t) * angle) / std::sin(angle);
  const double to = (is_small ? t : std::sin(t * angle) / std::sin(angle)) * sign;
  for (size_t i = 0; i < 4; ++i) a[i] = static_cast<float>(from * a[i] + to * b[i]);
  return a;
}

/// The output of a sampler: `per_key` numbers a key, thrice as many for cubic splines.
struct Track {
  std::vector<float> times, outputs;
  size_t per_key;
  bool is_cubic, is_step, is_rotation;

  /// One of the three parts of a cubic key: 0 in-tangent, 1 value, 2 out-tangent.
  Values part(size_t key, size_t which) const {
    const size_t parts = is_cubic ? 3 : 1;
    const auto first =
        outputs.begin() + static_cast<std::ptrdiff_t>((key * parts + which) * per_key);
    return {first, first + static_cast<std::ptrdiff_t>(per_key)};
  }
  Values value(size_t key) const { return part(key, is_cubic ? 1 : 0); }

  Values cubic(const Interval& i) const {
    const double t = i.fraction, t2 = t * t, t3 = t2 * t;
    const Values p0 = value(i.before), m0 = part(i.before, 2);
    const Values p1 = value(i.after), m1 = part(i.after, 0);
    Values result(per_key);
    for (size_t k = 0; k < per_key; ++k)
      result[k] =
          static_cast<float>((2 * t3 - 3 * t2 + 1) * p0[k] + i.length * (t3 - 2 * t2 + t) * m0[k] +
                             (3 * t2 - 2 * t3) * p1[k] + i.length * (t3 - t2) * m1[k]);
    return result;
  }

  Values at(double time) const {
    const Interval i = find_interval(times, time);
    if (i.before == i.after || is_step) return value(i.before);
    if (is_cubic) return cubic(i);
    Values a = value(i.before);
    const Values b = value(i.after);
    if (is_rotation) return slerp(std::move(a), b, i.fraction);
    for (size_t k = 0; k < per_key; ++k)
      a[k] = static_cast<float>((1 - i.fraction) * a[k] + i.fraction * b[k]);
    return a;
  }
};

Track read_track(Document& document, const JsonValue& sampler, const std::string& path) {
  const NumberArray input = read_accessor(document, sampler.get_index("input"), sampler);
  const NumberArray output = read_accessor(document, sampler.get_index("output"), sampler);
  const std::string mode = sampler.get_text("interpolation", "LINEAR");
  if (mode != "LINEAR" && mode != "STEP" && mode != "CUBICSPLINE")
    sampler.get("interpolation")
        .fail("unknown interpolation \"" + mode + "\", expected LINEAR, STEP or CUBICSPLINE");
  Track track{input.values,          output.values,  0,
              mode == "CUBICSPLINE", mode == "STEP", path == "rotation"};
  if (track.times.empty() || !std::is_sorted(track.times.begin(), track.times.end()))
    sampler.fail(
        "the times of keyframes are missing or not in increasing order, expected increasing ones");
  const size_t parts = track.times.size() * (track.is_cubic ? 3 : 1);
  track.per_key = track.outputs.size() / parts;
  const size_t expected = path == "rotation" ? 4 : path == "weights" ? track.per_key : 3;
  if (track.per_key == 0 || track.per_key != expected || track.outputs.size() % parts != 0)
    sampler.fail("the output has " + counted(track.outputs.size(), "number") + " for " +
                 counted(track.times.size(), "keyframe") + ", expected as many for each as " +
                 path + " takes");
  return track;
}

template <size_t N>
void take(const std::optional<Values>& from, std::array<double, N>& to) {
  if (from) std::copy(from->begin(), from->end(), to.begin());
}

}  // namespace

AnimationPose::AnimationPose(Document& document, double time) {
  for (const JsonValue& animation : document.list("animations")) {
    const std::vector<JsonValue> samplers = animation.get("samplers").elements();
    for (const JsonValue& channel : animation.get("channels").elements())
      read_channel(document, channel, samplers, time);
  }
}

void AnimationPose::read_channel(Document& document, const JsonValue& channel,
                                 const std::vector<JsonValue>& samplers, double time) {
  const JsonValue target = channel.get("target");
  const std::optional<size_t> node = target.find_index("node");
  const std::string path = target.get("path").text();
  if (!node) return;  // the target of an extension, which a warning names
  document.item("nodes", *node, target);
  const size_t sampler = channel.get_index("sampler");
  if (sampler >= samplers.size())
    channel.get("sampler").fail("there is no sampler " + std::to_string(sampler) +
                                ", expected an index below " + std::to_string(samplers.size()));
  Animated& animated = nodes_[*node];
  std::optional<Values>* const slot = path == "translation" ? &animated.translation
                                      : path == "rotation"  ? &animated.rotation
                                      : path == "scale"     ? &animated.scale
                                      : path == "weights"   ? &animated.weights
                                                            : nullptr;
  if (!slot)
    target.get("path").fail("unknown path \"" + path +
                            "\", expected translation, rotation, scale or weights");
  if (*slot) {
    document.diagnostics().warn(channel.where(), "an earlier animation sets this " + path +
                                                     " of the node, this one is ignored");
    return;
  }
  *slot = read_track(document, samplers[sampler], path).at(time);
}

void AnimationPose::apply(size_t node, NodePose& pose) const {
  const auto found = nodes_.find(node);
  if (found == nodes_.end()) return;
  take(found->second.translation, pose.translation);
  take(found->second.rotation, pose.rotation);
  take(found->second.scale, pose.scale);
}

bool AnimationPose::moves(size_t node) const {
  const auto found = nodes_.find(node);
  return found != nodes_.end() &&
         (found->second.translation || found->second.rotation || found->second.scale);
}

const std::vector<float>* AnimationPose::weights(size_t node) const {
  const auto found = nodes_.find(node);
  return found != nodes_.end() && found->second.weights ? &*found->second.weights : nullptr;
}

}  // namespace nephroid::gltf
