// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <cstdlib>
#include <numbers>
#include <thread>

#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/object_io.hpp"
#include "unit/model_io_fixture.hpp"

namespace eigengrasp {
namespace {

using ::testing::AllOf;
using testing::cube_obj;
using ::testing::EndsWith;
using testing::error_of;
using ::testing::HasSubstr;
using testing::TempFolder;

const std::string cube_iv = "#Inventor V2.0 ascii\nSeparator { Cube { width 20 height 40 depth 60 } }\n";

TEST(Inventor, ReadsShapesWithTransforms) {
  const TempFolder folder;
  const auto file = folder.write("a.iv", R"(#Inventor V2.0 ascii
Separator {
  Transform { translation 100 0 0 rotation 0 0 1 1.5707963 scaleFactor 2 1 1 }
  Cube { width 20 height 40 depth 60 }
}
)");
  const MeshReport report = inspect_mesh(load_inventor(file, 1e-3));
  EXPECT_TRUE(report.solid());
  EXPECT_LT((report.box.size() - Vec3(0.04, 0.04, 0.06)).norm(), 1e-7);
  EXPECT_LT((report.volume_center - Vec3(0.1, 0, 0)).norm(), 1e-7);
}

TEST(Inventor, ReadsVrmlAndClockwiseFaces) {
  const TempFolder folder;
  const auto wrl = folder.write("b.wrl", R"(#VRML V2.0 utf8
Transform { scale 10 10 10 children [ Shape { geometry Sphere { radius 1 } } ] }
)");
  const MeshReport sphere = inspect_mesh(load_inventor(wrl, 1e-3));
  EXPECT_NEAR(sphere.volume / (4.0 / 3.0 * std::numbers::pi * 1e-6), 1.0, 0.05);
  const auto clockwise = folder.write("c.iv", R"(#Inventor V2.0 ascii
Separator {
  ShapeHints { vertexOrdering CLOCKWISE }
  Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] }
  IndexedFaceSet { coordIndex [ 0, 2, 1, -1 ] }
}
)");
  EXPECT_GT(area_normal(load_inventor(clockwise, 1.0), 0).z(), 0.0);
}

TEST(Inventor, TurnsFailuresIntoErrorsAndStaysQuiet) {
  const TempFolder folder;
  ::testing::internal::CaptureStderr();
  EXPECT_THAT(error_of([&] { load_inventor(folder.path() / "none.iv", 1.0); }),
              EndsWith("none.iv: is missing or not a file, expected an Open Inventor or VRML file"));
  EXPECT_THAT(error_of([&] { load_inventor(folder.write("text.iv", "hello"), 1.0); }),
              HasSubstr("text.iv: cannot be parsed as Open Inventor or VRML ("));
  EXPECT_THAT(error_of([&] { load_inventor(folder.write("cut.iv", cube_iv.substr(0, 40)), 1.0); }),
              HasSubstr("cut.iv: cannot be parsed as Open Inventor or VRML ("));
  EXPECT_THAT(
      error_of([&] { load_inventor(folder.write("no.iv", "#Inventor V2.0 ascii\nSeparator {}\n"), 1.0); }),
      EndsWith("no.iv: holds no triangle, expected a surface"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Inventor, MayBeCalledFromManyThreads) {
  const TempFolder folder;
  const auto file = folder.write("a.iv", cube_iv);
  std::vector<TriangleMesh> meshes(8);
  {
    std::vector<std::jthread> threads;
    for (TriangleMesh& mesh : meshes) threads.emplace_back([&] { mesh = load_inventor(file, 1.0); });
  }
  for (const TriangleMesh& mesh : meshes) EXPECT_EQ(mesh.triangles, meshes[0].triangles);
}

TEST(LoadObject, GuessesUnitsByKindUnlessGiven) {
  const TempFolder folder;
  const auto side = [](const ObjectModel& object) { return bounding_box(object.mesh).size().x(); };
  const auto iv = folder.write("a.iv", cube_iv);
  const auto obj = folder.write("cube.obj", cube_obj(0.05));
  const auto xml = folder.write("a.xml", "<root><geometryFile>a.iv</geometryFile></root>");
  EXPECT_NEAR(side(load_object(iv)), 0.02, 1e-9);
  EXPECT_NEAR(side(load_object(xml)), 0.02, 1e-9);
  EXPECT_NEAR(side(load_object(obj)), 0.05, 1e-9);
  EXPECT_NEAR(side(load_object(iv, {.units = "cm"})), 0.2, 1e-9);
  EXPECT_NEAR(side(load_object(xml, {.units = "cm"})), 0.2, 1e-8);
  EXPECT_NEAR(side(load_object(obj, {.units = "in", .scale = 2.0})), 0.05 * 0.0254 * 2, 1e-9);
}

TEST(LoadObject, NamesAndMaterials) {
  const TempFolder folder;
  const auto xml =
      folder.write("a.xml", "<root><material>glass</material><geometryFile>cube.obj</geometryFile></root>");
  const auto obj = folder.write("cube.obj", cube_obj(0.05));
  EXPECT_EQ(load_object(obj).name, "cube");
  EXPECT_EQ(load_object(obj).material, "");
  EXPECT_EQ(load_object(obj).source, obj);
  EXPECT_EQ(load_object(xml).material, "glass");
  const ObjectModel named = load_object(xml, {.name = "vase", .material = "stone"});
  EXPECT_EQ(named.name, "vase");
  EXPECT_EQ(named.material, "stone");
}

TEST(LoadObject, RefusesWhatIsNoObject) {
  const TempFolder folder;
  const auto obj = folder.write("cube.obj", cube_obj(0.05));
  EXPECT_THAT(error_of([&] { load_object(folder.path() / "none.obj"); }),
              EndsWith("none.obj: does not exist, expected a file of an object"));
  EXPECT_THAT(error_of([&] { load_object(folder.write("a.txt", "x")); }),
              HasSubstr("a.txt: ends in \".txt\", expected a mesh (such as .obj"));
  EXPECT_THAT(error_of([&] { load_object(folder.write("r.xml", "<robot/>")); }),
              EndsWith("r.xml:1: the outermost element is <robot>, expected <root>"));
  EXPECT_THAT(error_of([&] { load_object(obj, {.units = "miles"}); }), HasSubstr("miles"));
  EXPECT_THAT(error_of([&] { load_object(obj, {.scale = -1.0}); }),
              HasSubstr("the scale is -1, expected a positive number"));
  EXPECT_THAT(error_of([&] {
                load_object(folder.write("b.xml", "<root>\n<geometryFile>x.iv</geometryFile></root>"));
              }),
              AllOf(HasSubstr("b.xml:2: <geometryFile> is \"x.iv\", but "), EndsWith("x.iv does not exist")));
  EXPECT_THAT(
      error_of([&] {
        load_object(folder.write(
            "b.xml",
            "<root><geometryFile>cube.obj</geometryFile><geometryScaling>0</geometryScaling></root>"));
      }),
      EndsWith("b.xml:1: <geometryScaling> is \"0\", expected a positive number"));
}

/// Sets an environment variable for one scope.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { ::setenv(name, value.c_str(), 1); }
  ~Variable() { ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

TEST(ModelLibrary, FindsHandsAndObjectsByName) {
  const TempFolder folder;
  folder.write("data/hands/claw/hand.yaml", "x");
  folder.write("data/hands/human/hand.yaml", "x");
  folder.write("data/hands/notes.txt", "x");
  folder.write("data/objects/glass.obj", "x");
  folder.write("data/objects/LICENSE.txt", "x");
  folder.write("mine/claw/hand.yaml", "x");
  folder.write("single/hand.yaml", "x");
  const Variable data("EIGENGRASP_DATA_DIR", (folder.path() / "data").string());
  const Variable hands("EIGENGRASP_HANDS",
                       (folder.path() / "mine").string() + ":" + (folder.path() / "single").string());
  std::vector<std::string> names;
  for (const NamedModel& hand : list_hands()) names.push_back(hand.name);
  EXPECT_EQ(names, (std::vector<std::string>{"claw", "human", "single"}));
  EXPECT_EQ(find_hand("claw"), folder.path() / "mine/claw");  // before the data folder
  EXPECT_EQ(find_hand("human"), folder.path() / "data/hands/human");
  EXPECT_EQ(find_hand((folder.path() / "single").string()), folder.path() / "single");
  ASSERT_EQ(list_objects().size(), 1u);
  EXPECT_EQ(find_object("glass"), folder.path() / "data/objects/glass.obj");
  EXPECT_EQ(find_object((folder.path() / "data/objects/glass.obj").string()),
            folder.path() / "data/objects/glass.obj");
  EXPECT_THAT(
      error_of([] { find_hand("humn"); }),
      HasSubstr(
          "\"humn\" is no file or folder with hand.yaml and no known hand, expected one of claw, human, "
          "single (did you mean \"human\"?)"));
  EXPECT_THAT(error_of([] { find_object("cup"); }),
              HasSubstr("\"cup\" is no file and no known object, expected one of glass"));
}

TEST(ModelLibrary, KnowsTheSourceTree) {
  for (const NamedModel& hand : list_hands()) EXPECT_EQ(find_hand(hand.name), hand.path);
  const TempFolder empty;
  const Variable data("EIGENGRASP_DATA_DIR", empty.path().string());
  EXPECT_THAT(error_of([] { find_hand("human"); }), HasSubstr("(none is installed)"));
}

}  // namespace
}  // namespace eigengrasp
