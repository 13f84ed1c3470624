#include "integrator/learning/guided_walk.h"

#include <cmath>

#include "core/sampler.h"
#include "transport/guided_direction.h"

namespace nephroid {

namespace {

Vec3f facing(const WalkVertex& v) {
  return v.wo.z < 0.0f ? -v.surface.shading.z : v.surface.shading.z;
}

bool is_glossy(const WalkVertex& v) {
  return contains(v.bsdf.finite_classes(), EventClass::kGlossy);
}

/// True if a guide may choose directions for events of these letters.
bool has_choice(const WalkVertex& v, ClassMask letters) {
  // An event that goes below the surface has no direction to choose.
  if (v.material.has_bssrdf() && !v.subsurface_exit) return false;
  return v.merges && guided_classes(v.bsdf, v.classes_of(letters)) != ClassMask::kNone;
}

}  // namespace

std::optional<BsdfSample> GuidedWalk::sample_direction(Walk& walk, const WalkVertex& v, float uc,
                                                       const Vec2f& u, ClassMask among) const {
  DirectionTree tree;
  if (guide_ && has_choice(v, among)) tree = guide_->at(v.surface.p, facing(v), is_glossy(v));
  if (tree.empty()) return v.bsdf.sample(v.wo, uc, u, TransportMode::kRadiance, among);
  float gain = 1;
  std::optional<BsdfSample> s =
      GuidedDirection(v.bsdf, v.surface.shading, v.wo, TransportMode::kRadiance, among, tree)
          .sample(uc, u, gain);
  if (!s) return s;
  s->pdf_w /= gain;
  walk.throughput /= gain;
  walk.eta_scale *= gain;
  return s;
}

void GuidedWalk::record(const Walk& walk, const WalkVertex& v, const WalkEvent& event) {
  if (!has_choice(v, v.letters) || !(carried_ > 0) ||
      records_->size() - first_record_ >= PassRecords::kMaxPerPath)
    return;
  // [Q2] needs p_R, the density over all lobes that the guide may choose for.
  const bool chosen = contains(ClassMask::kRough, event.letter) && !walk.delta;
  const float pdf_w = chosen ? guided_pdf_w(v.bsdf, v.wo, v.to_local(walk.ray.d),
                                            TransportMode::kRadiance, v.useful_classes())
                             : 0.0f;
  RadianceRecord r = RadianceRecord::at(v.surface.p, facing(v), is_glossy(v), walk.ray.d, pdf_w);
  r.carried = carried_;
  r.found = found_;
  records_->push_back(r);
}

void GuidedWalk::finish() {
  if (!records_) return;
  for (size_t i = first_record_; i < records_->size(); ++i) {
    RadianceRecord& r = (*records_)[i];
    const float behind = (found_ - r.found) / r.carried;
    r.found = behind > 0.0f && std::isfinite(behind) ? behind : 0.0f;
  }
}

size_t PassRecords::stride(size_t paths, double of_path) {
  const double all = static_cast<double>(paths) * of_path;
  return std::max<size_t>(1, static_cast<size_t>(std::ceil(all / static_cast<double>(kMax))));
}

PassRecords::PassRecords(std::vector<RadianceRecord>* all, size_t paths, double of_path)
    : all_(all), stride_(stride(paths, of_path)) {}

std::vector<RadianceRecord>* PassRecords::of_path(size_t pixel, int sample,
                                                  std::vector<RadianceRecord>& row) const {
  return all_ && hash_combine(pixel, sample) % stride_ == 0 ? &row : nullptr;
}

void PassRecords::take(std::vector<RadianceRecord>& row, bool again) {
  if (!all_) return;
  if (!again)
    all_->insert(all_->end(), row.begin(), row.end());
  else
    for (const RadianceRecord& r : row) (*all_)[next_++].found += r.found;
  if (next_ == all_->size()) next_ = 0;
  row = std::vector<RadianceRecord>();
}

}  // namespace nephroid
