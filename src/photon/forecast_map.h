// Caustic records: points that light reached through a caster, each with its point on the caster.
// From them, a density of directions towards casters at any point ([T1], [T2] in
// docs/estimators.md). It must not know routes, lights or BSDFs.
// Paper: Budge, Anderson & Joy 2008.
#pragma once

#include <array>
#include <vector>

#include "photon/sound_places.h"

namespace nephroid {

/// A point on which a caustic fell, and the point on the caster from which it came.
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
  /// Share of the directions that should be sampled from the lobes.
  float share() const { return empty() ? 0.0f : 0.5f; }
  /// Samples a direction from numbers in [0,1). `uc` chooses the lobe and is rescaled to [0,1).
  Vec3f sample(float& uc, const Vec2f& u) const;
  /// Density of sample(), per steradian.
  float pdf_w(const Vec3f& w) const;

 private:
  struct Lobe {
    Vec3f axis;
    float concentration = 0, norm = 0;
  };
  std::array<Lobe, kMaxLobes> lobes_;
  int count_ = 0;
};

/// A balanced k-d tree of records.
class ForecastMap {
 public:
  ForecastMap() = default;
  explicit ForecastMap(std::vector<CausticRecord> records);

  size_t size() const { return records_.size(); }
  size_t bytes() const { return size() * (sizeof(records_[0]) + sizeof(axes_[0])); }
  /// False if there are fewer records than K of [T2]: the map then has no lobes.
  bool foretells() const { return size() >= ForecastLobes::kMaxLobes; }
  /// [T2]: a lobe towards the caster of each of the records nearest to `p`, except the wide ones.
  /// Empty if foretells() is false.
  ForecastLobes lobes_at(const Vec3f& p) const;
  static void members(auto& self, auto& archive) { archive(self.records_, self.axes_); }
  bool is_sound() const;

 private:
  struct Nearest;
  void build(size_t begin, size_t end);
  void search(size_t begin, size_t end, Nearest& nearest) const;

  std::vector<CausticRecord> records_;  ///< ranges, each split at its middle record
  std::vector<uint8_t> axes_;           ///< split axis of each record's range
};

}  // namespace nephroid
