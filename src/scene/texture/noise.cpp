// Perlin's permutation and gradients; see noise.h. Each octave is one lookup of eight gradients.
#include "scene/texture/noise.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

namespace nephroid {

namespace {

/// Perlin's permutation of 0..255.
constexpr std::array<uint8_t, 256> kPermutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180};

/// Frequency ratio of octaves, slightly off 2, so that their lattices do not coincide.
constexpr float kLacunarity = 1.99f;
/// Approximate mean of |noise|.
constexpr float kMeanMagnitude = 0.2f;

/// The permutation twice, so that sums of two bytes need no reduction.
constexpr std::array<uint8_t, 512> kPermutationTwice = [] {
  std::array<uint8_t, 512> twice{};
  for (size_t i = 0; i < twice.size(); ++i) twice[i] = kPermutation[i & 255u];
  return twice;
}();

/// Gradients of lattice points: the twelve vectors from a cube's centre to its edges. Four of them
/// occur twice.
constexpr float kGradients[16][3] = {
    {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
    {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {-1, 1, 0}, {0, 1, -1}, {0, -1, -1}};

/// From 0 to 1 with vanishing first and second derivatives at both ends.
float fade(float t) {
  return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

/// Number of a coordinate's cell, modulo 256, and offset in the cell.
struct Cell {
  unsigned index;
  float offset;
  explicit Cell(float coordinate) {
    // Beyond 2^30 floats have no fractional part: fmod changes only the cell.
    constexpr float kWhole = 1073741824.0f;
    const float v = std::abs(coordinate) < kWhole ? coordinate : std::fmod(coordinate, kWhole);
    const float below = std::floor(v);
    index = static_cast<unsigned>(static_cast<int>(below)) & 255u;
    offset = v - below;
  }
};

/// Number of octaves that the footprint resolves; its fraction is the weight of the last one.
float octaves_left(const NoiseFootprint& f, int octaves) {
  const float squared = std::max(dot(f.dpdx, f.dpdx), dot(f.dpdy, f.dpdy));
  return std::clamp(-1.0f - 0.5f * std::log2(squared), 0.0f, static_cast<float>(octaves));
}

/// 0 below 0.3, 1 above 0.7, smooth in between.
float share_of_last(float part) {
  const float t = std::clamp((part - 0.3f) / 0.4f, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace

float noise(const Vec3f& p) {
  const Cell x(p.x), y(p.y), z(p.z);
  const float dx[2] = {x.offset, x.offset - 1.0f}, dy[2] = {y.offset, y.offset - 1.0f},
              dz[2] = {z.offset, z.offset - 1.0f};
  float corner[2][2][2];
  for (unsigned i = 0; i < 2; ++i) {
    const unsigned of_x = kPermutationTwice[x.index + i] + y.index;
    for (unsigned j = 0; j < 2; ++j) {
      const unsigned of_xy = kPermutationTwice[of_x + j] + z.index;
      for (unsigned k = 0; k < 2; ++k) {
        const float* g = kGradients[kPermutationTwice[of_xy + k] & 15u];
        corner[k][j][i] = g[0] * dx[i] + g[1] * dy[j] + g[2] * dz[k];
      }
    }
  }
  const float wx = fade(x.offset), wy = fade(y.offset), wz = fade(z.offset);
  float plane[2];
  for (int k = 0; k < 2; ++k)
    plane[k] = lerp(wy, lerp(wx, corner[k][0][0], corner[k][0][1]),
                    lerp(wx, corner[k][1][0], corner[k][1][1]));
  return lerp(wz, plane[0], plane[1]);
}

float fractal_noise(const Vec3f& p, const NoiseFootprint& footprint, float roughness, int octaves) {
  const float count = octaves_left(footprint, octaves);
  const int whole = static_cast<int>(count);
  float sum = 0.0f, frequency = 1.0f, strength = 1.0f;
  for (int i = 0; i < whole; ++i) {
    sum += strength * noise(p * frequency);
    frequency *= kLacunarity;
    strength *= roughness;
  }
  const float share = share_of_last(count - static_cast<float>(whole));
  return share == 0.0f ? sum : sum + strength * share * noise(p * frequency);
}

float turbulence(const Vec3f& p, const NoiseFootprint& footprint, float roughness, int octaves) {
  const float count = octaves_left(footprint, octaves);
  const int whole = static_cast<int>(count);
  float sum = 0.0f, frequency = 1.0f, strength = 1.0f;
  for (int i = 0; i < whole; ++i) {
    sum += strength * std::abs(noise(p * frequency));
    frequency *= kLacunarity;
    strength *= roughness;
  }
  // As in pbrt-v4 the octave after the last whole one counts as its mean where it is faded out, and
  // again in the loop below. Images would otherwise differ by a constant.
  const float share = share_of_last(count - static_cast<float>(whole));
  const float last = share == 0.0f ? 0.0f : std::abs(noise(p * frequency));
  sum += strength * lerp(share, kMeanMagnitude, last);
  for (int i = whole; i < octaves; ++i) {
    sum += strength * kMeanMagnitude;
    strength *= roughness;
  }
  return sum;
}

NoiseParameters read_noise_parameters(const ParameterSet& parameters) {
  constexpr int kMaxOctaves = 64;
  NoiseParameters n;
  n.octaves = parameters.get_int("octaves", n.octaves);
  n.roughness = parameters.get_float("roughness", n.roughness);
  if (n.octaves < 0 || n.octaves > kMaxOctaves)
    throw SceneError(parameters.find("octaves")->where,
                     "\"octaves\" is " + std::to_string(n.octaves) + ", expected 0 to " +
                         std::to_string(kMaxOctaves));
  return n;
}

}  // namespace nephroid
