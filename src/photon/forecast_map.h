// Where caustics come from: places to which light came through specular surfaces, each with the
// point of the caster that it came from; and, around any point, a density of directions towards
// such points ([T1] and [T2] in docs/estimators.md). It must not know routes, lights or BSDFs.
// Paper: Budge, Anderson & Joy 2008.
#pragma once

#include <array>
#include <vector>

#include "photon/sound_places.h"

namespace nephroid {

/// A place where light of a caustic landed, and where on the caster it came from.
struct CausticRecord {
  Vec3f p, caster;
  static void members(auto& self, auto& archive) { archive(self.p, self.caster); }
  bool is_sound() const { return is_sound_place(p) && is_sound_place(caster); }
};

/// A density of unit directions in world space: the mean of von Mises-Fisher lobes.
class ForecastLobes {
 public:
  static constexpr int kMaxLobes = 16;

  bool empty() const { return count_ == 0; }
  int count() const { return count_; }
  /// Adds a lobe around the unit vector `axis` of about `width` radians. At most kMaxLobes.
  void add(const Vec3f& axis, float width);
  /// Of the directions that should follow it.
  float share() const { return empty() ? 0.0f : 0.5f; }
  /// A direction of a lobe that `uc` chooses, from numbers in [0,1); `uc` becomes another.
  Vec3f sample(float& uc, const Vec2f& u) const;
  /// Density of directions whose lobe was chosen evenly, per steradian.
  float pdf_w(const Vec3f& w) const;

 private:
  struct Lobe {
    Vec3f axis;
    float concentration = 0, norm = 0;
  };
  std::array<Lobe, kMaxLobes> lobes_;
  int count_ = 0;
};

/// A balanced tree of records.
class ForecastMap {
 public:
  ForecastMap() = default;
  explicit ForecastMap(std::vector<CausticRecord> records);

  size_t size() const { return records_.size(); }
  size_t bytes() const { return size() * (sizeof(records_[0]) + sizeof(axes_[0])); }
  /// False if there are too few records to have K nearest ones: it then has no lobes anywhere.
  bool foretells() const { return size() >= ForecastLobes::kMaxLobes; }
  /// [T2]: a lobe towards the caster of each of the records nearest to `p`, unless it would be
  /// wide; none if it does not foretell.
  ForecastLobes lobes_at(const Vec3f& p) const;
  static void members(auto& self, auto& archive) { archive(self.records_, self.axes_); }
  bool is_sound() const;

 private:
  struct Nearest;
  void build(size_t begin, size_t end);
  void search(size_t begin, size_t end, Nearest& nearest) const;

  std::vector<CausticRecord> records_;  ///< the middle of each range divides it
  std::vector<uint8_t> axes_;           ///< along which
};

}  // namespace nephroid
