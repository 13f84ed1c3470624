// The table of material types: the scene format's name and the function that makes one. A new
// material is one new file and one row. It must not know what the materials do.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <tuple>

#include "input/format_rows.h"
#include "scene/bsdf/bssrdf_table.h"
#include "scene/bsdf/coated_diffuse.h"
#include "scene/material/material.h"

namespace nephroid {

/// Coat tables, shared by materials with the same coat.
class CoatTableCache {
 public:
  std::shared_ptr<const CoatTable> find_or_make(const DielectricInterface& boundary,
                                                float thickness, int max_depth);

 private:
  std::map<std::tuple<float, float, float, int>, std::shared_ptr<const CoatTable>> tables_;
};

struct PrincipledTables;

/// Tables of "principled", made when the first one needs them.
class PrincipledTableCache {
 public:
  std::shared_ptr<const PrincipledTables> get();

 private:
  std::shared_ptr<const PrincipledTables> tables_;
};

class MeasuredCache;

/// Input of a factory.
struct MaterialContext {
  const TextureLibrary& textures;
  MaterialSettings settings;
  Diagnostics& diagnostics;
  SceneFiles& files;
  uint64_t index = 0;  ///< index of the material under construction
  /// Finds a named material. Throws SceneError at the given location if there is none.
  std::function<MaterialPtr(const std::string&, const SourceLocation&)> named;
  CoatTableCache* coat_tables = nullptr;
  BssrdfTableCache* bssrdf_tables = nullptr;
  MeasuredCache* measured_files = nullptr;
  PrincipledTableCache* principled_tables = nullptr;
};

/// Maximum nesting depth of mixes. Code that visits both materials of each recurses and visits up
/// to a power of two of them.
inline constexpr int kDeepestMixture = 16;
[[noreturn]] void refuse_deep_mixture(const SourceLocation& where);

/// A material that is not part of a scene yet.
using NewMaterial = std::shared_ptr<Material>;

struct MaterialRow : FormatType {
  NewMaterial (*make)(const MaterialDescription&, const MaterialContext&);
};

/// All material types of the format.
std::span<const MaterialRow> material_table();
std::vector<FormatType> material_types();

NewMaterial make_diffuse(const MaterialDescription&, const MaterialContext&);
NewMaterial make_diffuse_transmission(const MaterialDescription&, const MaterialContext&);
NewMaterial make_dielectric(const MaterialDescription&, const MaterialContext&);
NewMaterial make_thin_dielectric(const MaterialDescription&, const MaterialContext&);
NewMaterial make_conductor(const MaterialDescription&, const MaterialContext&);
NewMaterial make_coated_diffuse(const MaterialDescription&, const MaterialContext&);
NewMaterial make_coated_conductor(const MaterialDescription&, const MaterialContext&);
NewMaterial make_subsurface(const MaterialDescription&, const MaterialContext&);
NewMaterial make_principled(const MaterialDescription&, const MaterialContext&);
NewMaterial make_hair(const MaterialDescription&, const MaterialContext&);
NewMaterial make_measured(const MaterialDescription&, const MaterialContext&);
NewMaterial make_mix(const MaterialDescription&, const MaterialContext&);
NewMaterial make_interface(const MaterialDescription&, const MaterialContext&);

}  // namespace nephroid
