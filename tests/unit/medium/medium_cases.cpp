// The media that the tests iterate over, see medium_fixture.h.
#include "unit/medium/medium_fixture.h"

namespace nephroid::testing_medium {

std::vector<MediumCase> medium_cases() {
  const std::string colors = "\"rgb sigma_a\" [ 0.2 0.5 1 ] \"rgb sigma_s\" [ 2 1 0.3 ] ";
  const std::string grid = "\"integer nx\" 7 \"integer ny\" 5 \"integer nz\" 9 ";
  std::vector<MediumCase> cases;
  cases.push_back(
      {"homogeneous", medium_of("homogeneous", colors + "\"float scale\" 0.7"), {0, 0, 0}, 4});
  cases.push_back(
      {"uniformgrid",
       medium_of("uniformgrid", colors + grid + "\"float density\" " + random_values(7 * 5 * 9, 1)),
       {0.5f, 0.5f, 0.5f},
       3});
  cases.push_back(
      {"uniformgrid, sparse and uneven",
       medium_of("uniformgrid",
                 colors + grid + "\"float density\" " + random_values(7 * 5 * 9, 2, true) +
                     "\"point3 p0\" [ -1 -2 -1 ] \"point3 p1\" [ 1 2 1.5 ]",
                 kUneven),
       {1, -2, 0.5f},
       8});
  cases.push_back(
      {"rgbgrid",
       medium_of("rgbgrid", grid + "\"rgb sigma_a\" " + random_values(3 * 7 * 5 * 9, 3) +
                                "\"rgb sigma_s\" " + random_values(3 * 7 * 5 * 9, 4, true) +
                                "\"float scale\" 3"),
       {0.5f, 0.5f, 0.5f},
       3});
  cases.push_back({"rgbgrid, scattering only, uneven",
                   medium_of("rgbgrid",
                             grid + "\"rgb sigma_s\" " + random_values(3 * 7 * 5 * 9, 5) +
                                 "\"point3 p0\" [ -1 -2 -1 ] \"point3 p1\" [ 1 2 1.5 ]",
                             kUneven),
                   {1, -2, 0.5f},
                   8});
  const MediumPtr cloud = medium_of("cloud", colors + "\"float density\" 2 \"float frequency\" 3");
  cases.push_back({"cloud", cloud, {0.5f, 0.5f, 0.5f}, 3});
  return cases;
}

}  // namespace nephroid::testing_medium
