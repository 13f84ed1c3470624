// What a camera walk does with directions that earlier walks found: it follows a guide where there
// is one, and leaves records for the next ([Q1] and [Q5] in docs/estimators.md, section 23). It
// must not know routes or how light is weighed.
#pragma once

#include <optional>
#include <vector>

#include "integrator/learning/radiance_guide.h"
#include "transport/walk.h"

namespace nephroid {

/// Beside one walk. Either may be null: a walk that follows no guide, one that leaves no records.
class GuidedWalk {
 public:
  GuidedWalk(const RadianceGuide* guide, std::vector<RadianceRecord>* records)
      : guide_(guide), records_(records), first_record_(records ? records->size() : 0) {}

  /// As Bsdf::sample, with the density of the BSDF: what the guide makes of it is taken out of the
  /// throughput, and roulette overlooks it.
  std::optional<BsdfSample> sample_direction(Walk& walk, const WalkVertex& v, float uc,
                                             const Vec2f& u, ClassMask among) const;

  /// The walk has come to a surface.
  void arrive(const Walk& walk) {
    if (records_) carried_ = whole_spectrum(walk.throughput, walk.lambda.left()).average();
  }
  /// Light was found, by whatever technique.
  void add(const SampledSpectrum& light) {
    if (records_) found_ += light.average();
  }
  /// The walk leaves the surface `v`.
  void leave(const Walk& walk, const WalkVertex& v, const WalkEvent& event) {
    if (records_) record(walk, v, event);
  }
  /// The walk is over: each record knew what had been found before it.
  void finish();

 private:
  void record(const Walk& walk, const WalkVertex& v, const WalkEvent& event);

  const RadianceGuide* const guide_;
  std::vector<RadianceRecord>* const records_;
  const size_t first_record_;
  float carried_ = 1;  ///< when it came to the surface
  float found_ = 0;    ///< so far
};

/// The records of a pass: of as many camera paths as leave about kMax, row by row.
class PassRecords {
 public:
  static constexpr size_t kMax = 1 << 19;
  static constexpr size_t kMaxPerPath = 8;

  /// One path in so many leaves records, of `paths` that would leave `of_path` each.
  static size_t stride(size_t paths, double of_path);

  /// Keeps none if `all` is null, which is empty before the pass of so many camera paths.
  PassRecords(std::vector<RadianceRecord>* all, size_t paths, double of_path);

  /// `row`, where the records of this path should go; null: it leaves none.
  std::vector<RadianceRecord>* of_path(size_t pixel, int sample,
                                       std::vector<RadianceRecord>& row) const;
  /// Takes a row's records; rows come in order. With `again` they are those of the same walks,
  /// which have found light that was not there before.
  void take(std::vector<RadianceRecord>& row, bool again);
  size_t bytes() const { return all_ ? all_->capacity() * sizeof(RadianceRecord) : 0; }

 private:
  std::vector<RadianceRecord>* const all_;
  const size_t stride_;
  size_t next_ = 0;  ///< of those that are found again
};

}  // namespace nephroid
