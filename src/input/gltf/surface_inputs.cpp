#include "input/gltf/surface_inputs.h"

namespace nephroid::gltf {

NumberInput SurfaceInputs::number(const JsonValue& owner, const std::string& factor,
                                  double fallback, const std::string& texture, char channel) {
  return {owner.find_object(texture), channel, owner.get_number(factor, fallback)};
}

ColorInput SurfaceInputs::color(const JsonValue& owner, const std::string& factor,
                                const Color& fallback, const std::string& texture) {
  return {owner.find_object(texture), owner.get_numbers<3>(factor, fallback), false};
}

void SurfaceInputs::add(const std::string& name, const NumberInput& input) {
  if (!input.texture || input.factor == 0)
    list.add_float(name, input.factor);
  else
    list.add_texture(
        name, textures.number(*input.texture, {input.channel, input.factor, false, {}, false},
                              surface.uv_sets));
}

void SurfaceInputs::add(const std::string& name, const ColorInput& input) {
  if (input.is_constant()) {
    list.add_color(name, input.factor);
    return;
  }
  if (input.times_vertex_color) surface.uses_vertex_colors = true;
  list.add_texture(name, input.texture ? textures.color(*input.texture, input.factor,
                                                        input.times_vertex_color, surface.uv_sets)
                                       : textures.vertex_color(input.factor, where()));
}

}  // namespace nephroid::gltf
