// docs/gltf-support.md is current.
#include "options/gltf_support.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "source_directory.h"

namespace nephroid {
namespace {

TEST(GltfSupport, ThePageIsCurrent) {
  std::ifstream file(testing_support::source_directory() + "/docs/gltf-support.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(page, gltf_support_markdown()) << "run tools/update_docs to make it anew";
}

}  // namespace
}  // namespace nephroid
