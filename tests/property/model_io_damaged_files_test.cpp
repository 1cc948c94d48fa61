// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// A damaged hand file gives a hand or an Error, never anything else.
#include "eigengrasp/core/random.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "unit/model_io_fixture.hpp"

namespace eigengrasp {
namespace {

using testing::cube_obj;
using testing::small_urdf;
using testing::small_yaml;
using testing::TempFolder;

/// Cuts the end off, drops or doubles a stretch, changes a letter, or writes a number that is none.
std::string damage(std::string text, RandomStream& random) {
  const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(text.size())));
  const auto length = static_cast<std::size_t>(random.uniform(1.0, 30.0));
  const double kind = random.uniform();
  if (kind < 0.2) return text.substr(0, at);
  if (kind < 0.4) return text.erase(at, length);
  if (kind < 0.6) return text.insert(at, text.substr(at, length));
  if (kind < 0.8) {
    text[at] = static_cast<char>(random.uniform(1.0, 127.0));
    return text;
  }
  const char* values[] = {"nan", "-1e308", "1e308", "0", "-0", "[", "{}", "&a *a", "99999999999"};
  const auto digit = text.find_first_of("0123456789", at);
  if (digit == std::string::npos) return text;
  return text.replace(digit, 1, values[static_cast<int>(random.uniform(0.0, 9.0))]);
}

void expect_hand_or_error(const std::string& urdf, const std::string& yaml) {
  const TempFolder folder;
  folder.write("cube.obj", cube_obj(0.06));
  folder.write("gripper.urdf", urdf);
  folder.write("hand.yaml", yaml);
  try {
    load_hand(folder.path(), {.load_meshes = false});
  } catch (const Error& e) {
    EXPECT_GT(std::string(e.what()).size(), 20u);
  }
}

TEST(DamagedFiles, UrdfGivesAHandOrAnError) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed, 1};
    ASSERT_NO_THROW(expect_hand_or_error(damage(small_urdf, random), small_yaml));
  }
}

TEST(DamagedFiles, YamlGivesAHandOrAnError) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed, 2};
    ASSERT_NO_THROW(expect_hand_or_error(small_urdf, damage(small_yaml, random)));
  }
}

}  // namespace
}  // namespace eigengrasp
