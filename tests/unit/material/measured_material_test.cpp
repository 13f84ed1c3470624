// The material "measured" and its files: shared, complete, or refused with a reason.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "measured_ggx.h"
#include "scene/material/measured_file.h"
#include "scene/material/table.h"

namespace nephroid {
namespace {

using testing_measured::bsdf_file_of;
using testing_measured::GgxSurface;
using testing_measured::tables_of;

GgxSurface small_surface() {
  GgxSurface s;
  s.polar = 3;
  s.normals = 8;
  s.nodes = 4;
  s.wavelengths = 2;
  return s;
}

/// A file for one test, removed when the test ends.
class BsdfFile {
 public:
  explicit BsdfFile(const std::string& bytes)
      : path_(std::filesystem::path(::testing::TempDir()) / "nephroid_measured_test.bsdf") {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~BsdfFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

MaterialDescription measured(const std::vector<std::string>& filename) {
  MaterialDescription d;
  d.type = "measured";
  d.where = {std::make_shared<const std::string>("scene.pbrt"), 7, 3};
  d.parameters.where = d.where;
  if (filename.empty()) return d;
  Parameter p;
  p.type = "string";
  p.name = "filename";
  p.strings = filename;
  p.where = {d.where.file, 8, 5};
  d.parameters.list = {p};
  return d;
}

std::vector<MaterialPtr> make(std::vector<MaterialDescription> list) {
  SceneDescription description;
  description.materials = std::move(list);
  Diagnostics diagnostics;
  const TextureLibrary textures(description, diagnostics);
  auto made = make_materials(description, textures, {}, diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  return made;
}

template <class Action>
std::string measured_error(const Action& action) {
  try {
    action();
  } catch (const SceneError& e) {
    return e.what();
  }
  return "no error";
}

std::string error_in(const std::string& bytes) {
  return measured_error([&] { measured_brdf_from(TensorFile(bytes, "f.bsdf", {})); });
}

TEST(MeasuredMaterial, TheFileIsReadAndRendersAsItsTablesSay) {
  const GgxSurface surface{0.5f, 0.5f};
  const MeasuredTables tables = tables_of(surface);
  const BsdfFile file(bsdf_file_of(tables));
  const auto materials = make({measured({file.path()})});
  ASSERT_EQ(materials.size(), 1u);
  EXPECT_EQ(materials[0]->possible_classes(), ClassMask::kGlossy);

  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.6f);
  BsdfArena arena;
  const Bsdf* read = materials[0]->make_bsdf({}, lambda, 0.05f, arena);
  EXPECT_FALSE(lambda.secondary_terminated());
  const MeasuredBrdf direct(tables);
  const MeasuredBsdf expected(direct, lambda);
  const Vec3f wo = normalize(Vec3f(0.4f, 0.1f, 0.8f)), wi = normalize(Vec3f(-0.3f, 0.2f, 0.6f));
  const auto eval = [&](const Bsdf& b) {
    return b.eval(wo, wi, TransportMode::kRadiance, EventClass::kGlossy, ClassMask::kAll);
  };
  EXPECT_TRUE(eval(*read).f == eval(expected).f);
  EXPECT_EQ(eval(*read).pdf_w, eval(expected).pdf_w);
  EXPECT_NEAR(eval(*read).f[2], surface.f(wo, wi, lambda.lambda(2)), 0.02f * eval(*read).f[2]);
}

TEST(MeasuredMaterial, MaterialsOfTheSameFileShareIt) {
  const BsdfFile file(bsdf_file_of(tables_of(small_surface())));
  MeasuredCache cache;
  SceneFiles files;
  const auto first = cache.get(files, file.path(), {});
  EXPECT_EQ(first.get(), cache.get(files, file.path(), {}).get());
  EXPECT_EQ(make({measured({file.path()}), measured({file.path()})}).size(), 2u);
}

TEST(MeasuredMaterial, MistakesAreLocated) {
  EXPECT_EQ(measured_error([] { make({measured({})}); }),
            "scene.pbrt:7:3: material \"measured\" has no \"string filename\", expected a .bsdf "
            "file");
  EXPECT_EQ(measured_error([] { make({measured({"/nowhere/absent.bsdf"})}); }),
            "scene.pbrt:8:5: cannot read \"/nowhere/absent.bsdf\": No such file or directory");
  const BsdfFile bad("not a tensor file");
  EXPECT_EQ(measured_error([&] { make({measured({bad.path()})}); }),
            "scene.pbrt:8:5: cannot use \"" + bad.path() +
                "\": it does not start with \"tensor_file\", expected a tensor file");
}

TEST(MeasuredFile, FieldsMustFitTogether) {
  const auto with = [](const std::function<void(MeasuredTables&)>& change) {
    GgxSurface surface = small_surface();
    surface.azimuths = 3;
    MeasuredTables t = tables_of(surface);
    change(t);
    return error_in(bsdf_file_of(t));
  };
  EXPECT_EQ(with([](MeasuredTables&) {}), "no error");
  EXPECT_EQ(with([](MeasuredTables& t) { t.theta[1] = t.theta[2]; }),
            "cannot use \"f.bsdf\": field \"theta_i\" does not increase at number 2 (counted from "
            "0), expected increasing numbers");
  EXPECT_NE(with([](MeasuredTables& t) {
              t.facets.values[3] = NAN;
            }).find("field \"ndf\" has an invalid number at 3"),
            std::string::npos);
  EXPECT_NE(with([](MeasuredTables& t) { t.spectra.values[5] = 2e9f; }).find("\"spectra\""),
            std::string::npos);
  EXPECT_NE(with([](MeasuredTables& t) {
              t.projected_area = {64, 1, std::vector<float>(64)};
            }).find("field \"sigma\" has grids of 1 x 64, expected at least 2 x 2"),
            std::string::npos);
  EXPECT_NE(with([](MeasuredTables& t) {
              t.luminance = {2, 2, std::vector<float>(36)};
            }).find("has grids of another size than \"luminance\""),
            std::string::npos);
  EXPECT_EQ(
      with([](MeasuredTables& t) {
        t.phi = {0, 1, 2};
      }),
      "cannot use \"f.bsdf\": field \"phi_i\" spans 2.000000 radians, expected a whole, a half "
      "or a quarter turn");
}

TEST(MeasuredFile, ExtentsMustBeThoseOfTheAxes) {
  std::string bytes = bsdf_file_of(tables_of(small_surface()));
  // The name is followed by fields of two bytes, one and eight, then by extents of eight bytes.
  const size_t extents = bytes.find("spectra") + 7 + 11;
  bytes[extents + 16] = 1;
  EXPECT_EQ(
      error_in(bytes),
      "cannot use \"f.bsdf\": field \"spectra\" has extent 1 in dimension 2 (counted from 0), "
      "expected 2 as the axes have");
}

TEST(MeasuredFile, EveryFieldIsNeeded) {
  const std::string whole = bsdf_file_of(tables_of(small_surface()));
  for (const char* name : {"description", "phi_i", "theta_i", "wavelengths", "ndf", "sigma", "vndf",
                           "luminance", "spectra", "jacobian"}) {
    std::string bytes = whole;
    const size_t at = bytes.find(name);
    ASSERT_NE(at, std::string::npos);
    bytes[at] = 'X';
    EXPECT_NE(error_in(bytes).find(std::string("it has no field \"") + name), std::string::npos);
  }
}

TEST(MeasuredFile, FilesOfRgbValuesAreNamedAsSuch) {
  testing_measured::TensorBytes rgb;
  rgb.add("rgb", {1}, {0.5f});
  EXPECT_NE(error_in(rgb.bytes()).find("it holds rgb values"), std::string::npos);
}

TEST(MeasuredFile, TruncationsAndFlippedBitsNeverCrash) {
  const std::string whole = bsdf_file_of(tables_of(small_surface()));
  for (size_t size = 0; size < whole.size(); size += size < 600 ? 1 : 97)
    EXPECT_NE(error_in(whole.substr(0, size)), "no error") << size;
  int refused = 0;
  for (size_t bit = 0; bit < whole.size() * 8; bit += bit < 4800 ? 1 : 101) {
    std::string bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    refused += error_in(bytes) != "no error";
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace nephroid
