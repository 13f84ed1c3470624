// The material "measured": reflection from a file. It must not know the file format.
#include "scene/material/measured_file.h"
#include "scene/material/surface_material.h"
#include "scene/texture/image_file.h"

namespace nephroid {
namespace {

class MeasuredMaterial final : public SurfaceMaterial {
 public:
  MeasuredMaterial(const MaterialDescription& d, const MaterialContext& c) : SurfaceMaterial(d, c) {
    const std::string file = d.parameters.get_string("filename", "");
    if (file.empty())
      throw SceneError(d.where,
                       "material \"measured\" has no \"string filename\", expected a .bsdf file");
    brdf_ =
        c.measured_files->get(c.files, c.files.path_of(file), d.parameters.find("filename")->where);
  }

  const Bsdf* make_bsdf(const SurfaceInteraction&, SampledWavelengths& lambda, float,
                        BsdfArena& arena) const override {
    return arena.make<MeasuredBsdf>(*brdf_, lambda);
  }
  ClassMask possible_classes() const override { return ClassMask::kGlossy; }

 private:
  std::shared_ptr<const MeasuredBrdf> brdf_;
};

}  // namespace

NewMaterial make_measured(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<MeasuredMaterial>(d, c);
}

}  // namespace nephroid
