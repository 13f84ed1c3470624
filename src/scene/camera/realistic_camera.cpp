// The realistic camera: rays from a film of physical size through a measured lens system, with the
// radiometry of the film. It knows aperture shapes only by name. Sources: Kolb, Mitchell & Hanrahan
// 1995; pbrt-v4 section 5.4.
#include <array>

#include "core/counted.h"
#include "core/parallel.h"
#include "input/file_bytes.h"
#include "input/number_text.h"
#include "scene/camera/aperture_shape.h"
#include "scene/camera/camera_table.h"
#include "scene/camera/lens_system.h"
#include "scene/texture/image_file.h"

namespace nephroid {
namespace {

constexpr double kMillimetre = 1e-3;

class RealisticCamera final : public Camera {
 public:
  RealisticCamera(const CameraPlacement& placement, const CameraFilm& film, LensSystem lenses)
      : Camera(placement), film_(film), lenses_(std::move(lenses)) {
    const double aspect = static_cast<double>(film.height) / film.width;
    half_diagonal_ = film.diagonal_mm * kMillimetre / 2;
    width_ = 2 * half_diagonal_ / std::sqrt(1 + aspect * aspect);
    height_ = aspect * width_;
    parallel_chunks(kZones, 1, [&](int64_t zone, int64_t, int64_t) {
      const double inner = static_cast<double>(zone) * half_diagonal_ / kZones;
      // A wide pixel filter can reach a little beyond the corner.
      const double outer = inner + half_diagonal_ / kZones * (zone + 1 == kZones ? 4 : 1);
      pupils_[zone] = lenses_.bound_exit_pupil(inner, outer);
    });
    footprint_ = footprint_of_central_pixel(*this, film);
    // No ray through the middle of the pupil: use the beam without the lens.
    if (!(footprint_.spread > 0))
      footprint_.spread = static_cast<float>(width_ / film.width / lenses_.rear_z());
  }

  std::optional<CameraRay> generate_ray(const Vec2f& film, const Vec2f& u_lens,
                                        float u_time) const override {
    // The image on the film is upside down and mirrored.
    const double x = width_ * (0.5 - static_cast<double>(film.x) / film_.width);
    const double y = height_ * (static_cast<double>(film.y) / film_.height - 0.5);
    const double r = std::sqrt(x * x + y * y);
    const auto zone =
        std::min<size_t>(kZones - 1, static_cast<size_t>(r / half_diagonal_ * kZones));
    const PupilBounds& pupil = pupils_[zone];
    if (pupil.empty()) return std::nullopt;
    // Pupils are stored for film points on the x axis and rotated to this one.
    const double px = pupil.x0 + (pupil.x1 - pupil.x0) * u_lens.x;
    const double py = pupil.y0 + (pupil.y1 - pupil.y0) * u_lens.y;
    const double sine = r > 0 ? y / r : 0, cosine = r > 0 ? x / r : 1;
    const double rear_z = lenses_.rear_z();
    const Vec3d from(x, y, 0), to(cosine * px - sine * py, sine * px + cosine * py, rear_z);
    const std::optional<LensSystem::Passed> passed = lenses_.trace_from_film({from, to - from});
    if (!passed) return std::nullopt;
    CameraRay c;
    c.ray = world_ray(Vec3f(passed->ray.o), Vec3f(passed->ray.d), u_time);
    // [K1]: irradiance from a point of the rear plane, over the density 1 / area.
    const double cos_film = rear_z / (to - from).length();
    c.weight = passed->share * static_cast<float>(sqr(sqr(cos_film)) * pupil.area() / sqr(rear_z));
    return c;
  }

  PixelFootprint footprint() const override { return footprint_; }

  // Not supported: the rear lens point that joins a world point and a film point can only be found
  // by search.
  std::optional<CameraConnection> connect(const Vec3f&, const Vec2f&, float) const override {
    return std::nullopt;
  }
  bool connects() const override { return false; }

 private:
  static constexpr int kZones = 64;  ///< rings of the film, each with its own pupil

  CameraFilm film_;
  LensSystem lenses_;
  double half_diagonal_ = 0, width_ = 0, height_ = 0;  ///< film size, m
  std::array<PupilBounds, kZones> pupils_;
  PixelFootprint footprint_;
};

/// Numbers of a lens table, separated by spaces; "#" starts a comment.
std::vector<double> read_numbers(SceneFiles& files, const std::string& path,
                                 const SourceLocation& named_by) {
  std::string text;
  try {
    text = files.read(path);
  } catch (const IoError& error) {
    file_is_unreadable(named_by, error.what());
  }
  std::vector<double> numbers;
  SourceLocation at{std::make_shared<const std::string>(path), 1, 1};
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  for (size_t i = 0; i < text.size();) {
    size_t end = i + 1;
    if (text[i] == '#') {
      while (end < text.size() && text[end] != '\n') ++end;
    } else if (!is_space(text[i])) {
      while (end < text.size() && !is_space(text[end]) && text[end] != '#') ++end;
      const std::string word = text.substr(i, end - i);
      const std::optional<double> number = parse_number(word);
      if (!number || !std::isfinite(*number))
        throw SceneError(at, "\"" + word +
                                 "\" is not a number, expected four numbers per surface: "
                                 "radius, thickness, index of refraction, diameter");
      numbers.push_back(*number);
    } else if (text[i] == '\n') {
      ++at.line;
      at.column = 0;
    }
    at.column += static_cast<int>(end - i);
    i = end;
  }
  return numbers;
}

/// The table's rows in metres. Stops get the diameter requested by the scene, at most their own.
std::vector<LensSurface> read_lens_table(SceneFiles& files, const std::string& path,
                                         const SourceLocation& named_by, double stop_diameter_mm,
                                         Diagnostics& diagnostics) {
  const std::vector<double> n = read_numbers(files, path, named_by);
  const SourceLocation table{std::make_shared<const std::string>(path), 0, 0};
  if (n.empty() || n.size() % 4 != 0)
    throw SceneError(
        table, "the lens table has " + counted(n.size(), "number") + ", expected four per surface");
  std::vector<LensSurface> surfaces;
  for (size_t i = 0; i < n.size(); i += 4) {
    double diameter = n[i + 3];
    if (n[i] == 0) {
      if (stop_diameter_mm > diameter)
        diagnostics.warn(named_by,
                         "\"aperturediameter\" is larger than the stop of the lens table, "
                         "which is " +
                             std::to_string(diameter) + " mm wide; the stop's size is used");
      diameter = std::min(diameter, stop_diameter_mm);
    }
    if (!(diameter > 0) || n[i + 1] < 0 || n[i + 2] < 0)
      throw SceneError(table, "surface " + std::to_string(i / 4 + 1) +
                                  " of the lens table is wrong, expected a diameter above 0, no "
                                  "negative thickness and no negative index of refraction");
    surfaces.push_back(
        {n[i] * kMillimetre, n[i + 1] * kMillimetre, n[i + 2], diameter * kMillimetre / 2});
  }
  return surfaces;
}

}  // namespace

std::unique_ptr<Camera> make_realistic_camera(const CameraContext& c) {
  const ParameterSet& p = c.parameters;
  const std::string file = p.get_string("lensfile", "");
  if (file.empty())
    throw SceneError(p.where, "the realistic camera has no \"lensfile\", expected a lens table");
  const float diameter = p.get_float("aperturediameter", 1.0f);
  const float distance = p.get_float("focusdistance", 10.0f);
  if (!(diameter > 0 && distance > 0))
    throw SceneError(p.where, "\"aperturediameter\" and \"focusdistance\" must be positive");
  const std::string shape = p.get_string("aperture", "");
  const Parameter* named = p.find("aperture");
  LensSystem lenses(read_lens_table(c.files, c.files.path_of(file), p.find("lensfile")->where,
                                    diameter, c.diagnostics),
                    make_aperture_shape(shape, c.files, named ? named->where : p.where));
  // The height of the paraxial rays is pbrt-v4's, so that both focus alike.
  if (!lenses.focus(distance, c.film.diagonal_mm * 1e-6))
    throw SceneError(p.where,
                     "the lenses cannot be focused: \"focusdistance\" is too short for them, or "
                     "their aperture lets no light through along the axis");
  return std::make_unique<RealisticCamera>(c.placement, c.film, std::move(lenses));
}

}  // namespace nephroid
