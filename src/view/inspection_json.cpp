#include "view/inspection_json.h"

#include <cmath>

namespace nephroid {
namespace {

Json shares_json(const std::vector<Share>& shares) {
  Json json = Json::array();
  for (const Share& share : shares)
    json.push_back({{"name", share.name}, {"value", json_of(share.value)}});
  return json;
}

Json shares_json(const std::vector<EstimatedShare>& shares) {
  Json json = Json::array();
  for (const EstimatedShare& share : shares)
    json.push_back({{"name", share.name},
                    {"value", json_of(share.value)},
                    {"error", share.error},
                    {"share", share.share},
                    {"share_error", share.share_error}});
  return json;
}

Json path_json(const InspectedPath& path) {
  Json points = Json::array(), pixels = Json::array();
  for (const Vec3f& point : path.points) points.push_back(json_of(point));
  // Behind the camera there is no pixel.
  for (const Vec2f& pixel : path.pixels)
    pixels.push_back(std::isfinite(pixel.x) && std::isfinite(pixel.y) ? Json{pixel.x, pixel.y}
                                                                      : Json(nullptr));
  return {{"word", path.word},
          {"route", path.route},
          {"light", path.light},
          {"technique", path.technique},
          {"value", json_of(path.value)},
          {"share", path.share},
          {"share_error", path.share_error},
          {"points", points},
          {"pixels", pixels}};
}

}  // namespace

Json inspection_json(const PixelInspection& inspection) {
  Json paths = Json::array();
  for (const InspectedPath& path : inspection.paths) paths.push_back(path_json(path));
  return {{"x", inspection.x},
          {"y", inspection.y},
          {"value", json_of(inspection.value)},
          {"error", json_of(inspection.standard_error)},
          {"samples", inspection.samples},
          {"routes", shares_json(inspection.routes)},
          {"layers", shares_json(inspection.layers)},
          {"lights", shares_json(inspection.lights)},
          {"techniques", shares_json(inspection.techniques)},
          {"traced", json_of(inspection.traced)},
          {"traced_error", inspection.traced_error},
          {"paths", paths},
          {"notes", inspection.notes}};
}

}  // namespace nephroid
