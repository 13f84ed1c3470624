// Checks the fields of a measured reflection; see measured_file.h.
#include "scene/material/measured_file.h"

#include <cmath>

namespace nephroid {
namespace {

/// Reads arrays from a file and rejects those with an unusable shape or numbers.
class Fields {
 public:
  explicit Fields(const TensorFile& file) : file_(file) {}

  /// An axis: at least one number, strictly increasing.
  std::vector<float> axis(const char* name) const {
    std::vector<float> values = numbers(name, 1);
    if (values.empty()) fail(name, "is empty, expected at least one number");
    for (size_t i = 1; i < values.size(); ++i)
      if (!(values[i] > values[i - 1]))
        fail(name, "does not increase at number " + std::to_string(i) +
                       " (counted from 0), expected increasing numbers");
    return values;
  }
  /// Grids of any size, one per combination of `extents`.
  GridFamily grids(const char* name, const std::vector<size_t>& extents) const {
    const std::vector<uint64_t>& shape =
        file_.require(name, TensorType::kFloat32, extents.size() + 2).shape;
    for (size_t i = 0; i < extents.size(); ++i)
      if (shape[i] != extents[i])
        fail(name, "has extent " + std::to_string(shape[i]) + " in dimension " + std::to_string(i) +
                       " (counted from 0), expected " + std::to_string(extents[i]) +
                       " as the axes have");
    GridFamily family;
    family.height = shape[extents.size()];
    family.width = shape[extents.size() + 1];
    if (family.height < 2 || family.width < 2)
      fail(name, "has grids of " + std::to_string(family.height) + " x " +
                     std::to_string(family.width) + ", expected at least 2 x 2");
    family.values = numbers(name, shape.size());
    return family;
  }
  bool flag(const char* name) const {
    const TensorField& field = file_.require(name, TensorType::kUint8, 1);
    if (field.bytes.size() != 1) fail(name, "is " + field.to_string() + ", expected one number");
    return field.bytes[0] != 0;
  }
  [[noreturn]] void fail(const char* name, const std::string& message) const {
    file_.fail(std::string("field \"") + name + "\" " + message);
  }

 private:
  std::vector<float> numbers(const char* name, size_t dimensions) const {
    std::vector<float> values =
        TensorFile::floats(file_.require(name, TensorType::kFloat32, dimensions));
    for (size_t i = 0; i < values.size(); ++i)
      if (!(std::abs(values[i]) <= MeasuredBrdf::kMaxValue))
        fail(name, "has an invalid number at " + std::to_string(i) +
                       " (counted from 0), expected finite numbers up to 1e9");
    return values;
  }

  const TensorFile& file_;
};

/// More than two azimuths mean an anisotropic surface. They must span a full turn, or the half or
/// quarter that symmetry completes.
void check_azimuths(const Fields& fields, const std::vector<float>& phi) {
  if (phi.size() <= 2) return;
  const float parts = std::rint(2.0f * kPi / (phi.back() - phi.front()));
  if (parts == 1.0f || parts == 2.0f || parts == 4.0f) return;
  fields.fail("phi_i", "spans " + std::to_string(phi.back() - phi.front()) +
                           " radians, expected a whole, a half or a quarter turn");
}

}  // namespace

MeasuredBrdf measured_brdf_from(const TensorFile& file) {
  const Fields fields(file);
  if (file.find("rgb") && !file.find("spectra"))
    file.fail("it holds rgb values, expected the file of the same surface that holds spectra");
  file.require("description", TensorType::kUint8, 1);
  MeasuredTables t;
  t.phi = fields.axis("phi_i");
  t.theta = fields.axis("theta_i");
  t.wavelengths = fields.axis("wavelengths");
  check_azimuths(fields, t.phi);
  t.facets = fields.grids("ndf", {});
  t.projected_area = fields.grids("sigma", {});
  t.visible_facets = fields.grids("vndf", {t.phi.size(), t.theta.size()});
  t.luminance = fields.grids("luminance", {t.phi.size(), t.theta.size()});
  t.spectra = fields.grids("spectra", {t.phi.size(), t.theta.size(), t.wavelengths.size()});
  if (t.spectra.width != t.luminance.width || t.spectra.height != t.luminance.height)
    fields.fail("spectra", "has grids of another size than \"luminance\", expected the same");
  t.values_are_ratios = fields.flag("jacobian");
  return MeasuredBrdf(std::move(t));
}

std::shared_ptr<const MeasuredBrdf> MeasuredCache::get(SceneFiles& files, const std::string& path,
                                                       const SourceLocation& wanted_by) {
  auto& surface = surfaces_[path];
  if (!surface)
    surface = std::make_shared<const MeasuredBrdf>(
        measured_brdf_from(TensorFile::read(files, path, wanted_by)));
  return surface;
}

}  // namespace nephroid
