#pragma once
#include <string>
#include <vector>
#include "core/color.h"
#include "core/math.h"
namespace nephroid {
struct Share { std::string name; Rgb value{0,0,0}; };
struct EstimatedShare { std::string name; Rgb value{0,0,0}; double error = 0; };
struct InspectedPath { std::string word, route, light; Rgb value{0,0,0}; double share = 0, share_error = 0; std::string technique; std::vector<Vec3f> points; std::vector<Vec2f> pixels; };
struct PixelInspection { int x = 0, y = 0; uint64_t samples = 0; Rgb value{0,0,0}, standard_error{0,0,0}; std::vector<Share> routes, layers; std::vector<EstimatedShare> lights, techniques; Rgb traced{0,0,0}; std::vector<InspectedPath> paths; std::string note; };
}
