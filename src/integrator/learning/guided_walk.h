// Path guiding of one camera walk: it follows a RadianceGuide where there is one and leaves records
// for the next guide ([Q1] and [Q5] in docs/estimators.md, section 23). It must not know routes or
// MIS weights.
#pragma once

#include <optional>
#include <vector>

#include "integrator/learning/radiance_guide.h"
#include "transport/walk.h"

namespace nephroid {

/// Guide and records of one walk. Null guide: it follows none. Null records: it leaves none.
class GuidedWalk {
 public:
  GuidedWalk(const RadianceGuide* guide, std::vector<RadianceRecord>* records)
      : guide_(guide), records_(records), first_record_(records ? records->size() : 0) {}

  /// Like Bsdf::sample; the sample keeps the BSDF's density. The factor p / (s q + (1 - s) p) of
  /// [Q5] is applied to the throughput, and roulette ignores it.
  std::optional<BsdfSample> sample_direction(Walk& walk, const WalkVertex& v, float uc,
                                             const Vec2f& u, ClassMask among) const;

  /// Call when the walk comes to a surface.
  void arrive(const Walk& walk) {
    if (records_) carried_ = whole_spectrum(walk.throughput, walk.lambda.left()).average();
  }
  /// Call when any technique finds light.
  void add(const SampledSpectrum& light) {
    if (records_) found_ += light.average();
  }
  /// Call when the walk leaves the surface `v`.
  void leave(const Walk& walk, const WalkVertex& v, const WalkEvent& event) {
    if (records_) record(walk, v, event);
  }
  /// Call when the walk has ended. Each record then holds the light behind it.
  void finish();

 private:
  void record(const Walk& walk, const WalkVertex& v, const WalkEvent& event);

  const RadianceGuide* const guide_;
  std::vector<RadianceRecord>* const records_;
  const size_t first_record_;
  float carried_ = 1;  ///< mean throughput on arrival at the surface
  float found_ = 0;    ///< light found so far
};

/// The records of a pass, collected row by row from as many camera paths as leave about kMax.
class PassRecords {
 public:
  static constexpr size_t kMax = 1 << 19;
  static constexpr size_t kMaxPerPath = 8;

  /// One path in how many leaves records, if each of `paths` would leave `of_path` of them.
  static size_t stride(size_t paths, double of_path);

  /// Collects into `all`, which must be empty before the pass. Null: keeps no records.
  PassRecords(std::vector<RadianceRecord>* all, size_t paths, double of_path);

  /// `row` if this path leaves records, else null.
  std::vector<RadianceRecord>* of_path(size_t pixel, int sample,
                                       std::vector<RadianceRecord>& row) const;
  /// Takes a row's records; rows come in order. With `again` the same walks were run a second time,
  /// and the light of each record is added to the record of the first time.
  void take(std::vector<RadianceRecord>& row, bool again);
  size_t bytes() const { return all_ ? all_->capacity() * sizeof(RadianceRecord) : 0; }

 private:
  std::vector<RadianceRecord>* const all_;
  const size_t stride_;
  size_t next_ = 0;  ///< index of the next record to add to, with `again`
};

}  // namespace nephroid
