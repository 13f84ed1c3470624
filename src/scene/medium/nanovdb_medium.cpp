// A medium with density and temperature from a NanoVDB file ("nanovdb"; pbrt-v4 section 11.4.4). It
// must not know how the file stores its grids.
#include "input/file_bytes.h"
#include "scene/medium/grid_parameters.h"
#include "scene/medium/medium_table.h"
#include "scene/medium/nanovdb_grid.h"
#include "scene/texture/image_file.h"

namespace nephroid {

namespace {

using GridPtr = std::unique_ptr<const NanoVdbGrid>;

constexpr std::array<int, 3> kMajorants = {64, 64, 64};

Vec3d map_point(const Mat44d& m, const Vec3d& p) {
  return {p.x * m[0][0] + p.y * m[1][0] + p.z * m[2][0] + m[3][0],
          p.x * m[0][1] + p.y * m[1][1] + p.z * m[2][1] + m[3][1],
          p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2] + m[3][2]};
}

/// A grid and the map into its index space.
struct PlacedGrid {
  GridPtr grid;
  Mat44d index_from_medium;

  explicit PlacedGrid(GridPtr g)
      : grid(std::move(g)),
        index_from_medium(grid ? grid->medium_from_index().inverse() : Mat44d()) {}
  float lookup(const Vec3d& p) const { return grid->lookup(map_point(index_from_medium, p)); }
};

/// The box around both grids.
struct MediumBounds {
  Vec3d min, max;
  MediumBounds(const NanoVdbGrid& density, const NanoVdbGrid* temperature)
      : min(density.medium_min()), max(density.medium_max()) {
    for (int i = 0; temperature && i < 3; ++i) {
      min[i] = std::min(min[i], temperature->medium_min()[i]);
      max[i] = std::max(max[i], temperature->medium_max()[i]);
    }
  }
};

/// Adds each voxel's value to the cells it affects: those that overlap its box widened by one
/// voxel.
class MajorantBuilder {
 public:
  MajorantBuilder(const NanoVdbGrid& grid, const MediumBounds& bounds)
      : result_{kMajorants, std::vector<float>(size_t{64} * 64 * 64,
                                               std::max(0.0f, grid.background()) * kRounding)},
        cell_from_index_(grid.medium_from_index()) {
    Mat44d cell_from_medium;
    for (int i = 0; i < 3; ++i) {
      const double scale = kMajorants[i] / (bounds.max[i] - bounds.min[i]);
      cell_from_medium[i][i] = scale;
      cell_from_medium[3][i] = -bounds.min[i] * scale;
    }
    cell_from_index_ = cell_from_index_ * cell_from_medium;
    grid.visit_values_above(std::max(0.0f, grid.background()),
                            [this](const Imath::V3i& first, const Imath::V3i& last, float v) {
                              add(first, last, v * kRounding);
                            });
  }
  MajorantGrid take() { return std::move(result_); }

 private:
  static constexpr float kRounding = 1.00001f;
  /// Margin in cells, enough for rays from a few hundred box widths away.
  static constexpr double kMargin = 0.01;

  void add(const Imath::V3i& first, const Imath::V3i& last, float value) {
    const Vec3d center = map_point(cell_from_index_, (Vec3d(first) + Vec3d(last)) * 0.5);
    const Vec3d half = (Vec3d(last) - Vec3d(first)) * 0.5 + Vec3d(1, 1, 1);
    int a[3], b[3];
    for (int i = 0; i < 3; ++i) {
      double reach = kMargin;
      for (int j = 0; j < 3; ++j) reach += std::abs(cell_from_index_[j][i]) * half[j];
      const double lo = std::clamp(std::floor(center[i] - reach), 0.0, kMajorants[i] + 0.0);
      const double hi = std::clamp(std::floor(center[i] + reach), -1.0, kMajorants[i] - 1.0);
      a[i] = static_cast<int>(lo);
      b[i] = static_cast<int>(hi);
    }
    for (int z = a[2]; z <= b[2]; ++z)
      for (int y = a[1]; y <= b[1]; ++y)
        for (int x = a[0]; x <= b[0]; ++x) {
          float& cell = result_.scales[x + size_t{64} * (y + size_t{64} * z)];
          cell = std::max(cell, value);
        }
  }

  MajorantGrid result_;
  Mat44d cell_from_index_;
};

class NanoVdbMedium final : public Medium {
 public:
  NanoVdbMedium(const MediumBounds& bounds, const Mat44d& world_from_medium,
                const Extinction& extinction, HenyeyGreenstein phase, GridPtr density,
                GridPtr temperature, float le_scale, const TemperatureMap& kelvin)
      : space_(world_from_medium, bounds.min, bounds.max),
        extinction_(extinction),
        phase_(phase),
        density_(std::move(density)),
        temperature_(std::move(temperature)),
        le_scale_(le_scale),
        kelvin_(kelvin),
        majorants_(MajorantBuilder(*density_.grid, bounds).take()) {
    absorbing_ = !(extinction.sigma_s.max_value() > 0.0f);
    emissive_ = temperature_.grid && le_scale > 0.0f && extinction.sigma_a.max_value() > 0.0f;
  }

  bool is_emissive() const override { return emissive_; }
  bool is_purely_absorbing() const override { return absorbing_; }

  MediumProperties at(const Vec3f& p, const SampledWavelengths& lambda) const override {
    const Vec3d m = space_.to_medium(p);
    const float density = std::max(0.0f, density_.lookup(m));
    SampledSpectrum le;
    if (emissive_ && density > 0.0f)
      le = kelvin_.blackbody(temperature_.lookup(m), lambda) * le_scale_;
    return {extinction_.sigma_a.sample(lambda) * density,
            extinction_.sigma_s.sample(lambda) * density, le, phase_};
  }
  MajorantIterator majorants(const Ray& ray, float t_max,
                             const SampledWavelengths& lambda) const override {
    const auto r = space_.overlap(ray, t_max);
    if (!r) return {};
    return {r->o,
            r->d,
            r->t_min,
            r->t_max,
            extinction_.sigma_a.sample(lambda) + extinction_.sigma_s.sample(lambda),
            majorants_.scales.data(),
            majorants_.resolution.data()};
  }

 private:
  MediumSpace space_;
  Extinction extinction_;  ///< extinction at density 1
  HenyeyGreenstein phase_;
  PlacedGrid density_, temperature_;  ///< the temperature grid can be null
  float le_scale_;
  TemperatureMap kelvin_;
  MajorantGrid majorants_;  ///< majorants of density
  bool absorbing_, emissive_;
};

}  // namespace

NewMedium make_nanovdb_medium(const MediumDescription& description, const MediumScope& scope) {
  const ParameterSet& p = description.parameters;
  const std::string name = p.get_string("filename", "");
  if (name.empty())
    throw SceneError(description.where, "medium \"" + description.name +
                                            "\" has no \"filename\", expected a .nvdb file");
  const SourceLocation& where = p.find("filename")->where;
  const std::string path = scope.files.path_of(name);
  std::string file;
  try {
    file = scope.files.read(path);
  } catch (const IoError& e) {
    file_is_unreadable(where, e.what());
  }
  const std::string density_name = p.get_string("gridname", "density");
  GridPtr density = NanoVdbGrid::read(file, density_name, path, where);
  if (!density)
    throw SceneError(where, "NanoVDB file \"" + path + "\" has no grid \"" + density_name +
                                "\", expected one of its grids as \"gridname\"");
  GridPtr temperature =
      NanoVdbGrid::read(file, p.get_string("temperaturename", "temperature"), path, where);
  const MediumBounds bounds(*density, temperature.get());
  return std::make_shared<NanoVdbMedium>(bounds, description.transform.start,
                                         read_extinction(p, read_scale(p), scope.files),
                                         read_phase(p), std::move(density), std::move(temperature),
                                         read_factor(p, "Lescale", 1.0f), read_temperature_map(p));
}

}  // namespace nephroid
