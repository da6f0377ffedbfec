// SPDX-License-Identifier: MIT
#include <filesystem>

#include "ardee_sim/readers/package_index.h"
#include "fixture.h"

namespace ardee {
namespace {

class Locator : public ::testing::Test {
 protected:
  Locator() {
    locator_.add_model_path(folder_.path() + "/models");
    locator_.add_resource_path(folder_.path() + "/share");
  }
  std::string error_of(const std::string& uri) const {
    try {
      locator_.resolve(uri, Source{"f.sdf", 3, "uri"});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  TempFolder folder_;
  ResourceLocator locator_;
};

TEST_F(Locator, FindsModelUris) {
  const std::string file = folder_.write("models/a/meshes/m.dae", "");
  EXPECT_EQ(locator_.resolve("model://a/meshes/m.dae", {}), file);
}

TEST_F(Locator, FindsFileUrisOnResourceAndModelPathsAndTheirParents) {
  const std::string on_models = folder_.write("models/ground/h.png", "");
  const std::string on_share = folder_.write("share/media/t.png", "");
  const std::string beside = folder_.write("media/parent.png", "");
  EXPECT_EQ(locator_.resolve("file://ground/h.png", {}), on_models);
  EXPECT_EQ(locator_.resolve("file://media/t.png", {}), on_share);
  EXPECT_EQ(locator_.resolve("file://media/parent.png", {}), beside);
  EXPECT_EQ(locator_.resolve("file://" + beside, {}), beside);
  EXPECT_EQ(locator_.resolve(beside, {}), beside);
}

TEST_F(Locator, FindsPathsBesideTheReferringFile) {
  const std::string mesh = folder_.write("x/meshes/m.dae", "");
  EXPECT_EQ(locator_.resolve("meshes/m.dae", Source{folder_.path() + "/x/model.sdf", 1, ""}), mesh);
}

TEST_F(Locator, SaysWhereItSearched) {
  const std::string error = error_of("model://a/b.dae");
  EXPECT_HAS(error,
             "f.sdf:3: <uri>: found 'model://a/b.dae', expected an existing file; searched: ");
  EXPECT_HAS(error, folder_.path() + "/models/a/b.dae");
  EXPECT_HAS(error_of("ftp://x/y"), "expected model://, package://, file:// or a path");
  EXPECT_HAS(error_of("model://"), "found an empty path");
  EXPECT_HAS(error_of("package://nobody/x"), "searched for package 'nobody'");
}

TEST_F(Locator, NamesTheModelsThatAreNearestToAWrongOne) {
  folder_.write("models/corn_plant/model.config", "");
  folder_.write("models/stone/model.sdf", "");
  folder_.write("models/no_model/readme.txt", "");
  EXPECT_HAS(error_of("model://corm_plant"), "; nearest: corn_plant, stone");
  EXPECT_HAS(error_of("model://corm_plant/meshes/leaf.dae"), "; nearest: corn_plant, stone");
}

TEST_F(Locator, NamesTheFilesThatAreNearestToAWrongOneInItsFolder) {
  folder_.write("models/corn_plant/model.config", "");
  folder_.write("models/corn_plant/meshes/leaf.dae", "");
  folder_.write("models/corn_plant/meshes/stalk.dae", "");
  folder_.write("models/corn_plant/meshes/leaf.png", "");
  EXPECT_HAS(error_of("model://corn_plant/meshes/leav.dae"), "; nearest: leaf.dae, stalk.dae");
}

TEST_F(Locator, FindsAWorldByItsPathOrItsName) {
  const std::string farm = folder_.write("share/worlds/farm.world", "");
  EXPECT_EQ(locator_.find_world(farm), farm);
  EXPECT_EQ(locator_.find_world("worlds/farm.world"), farm);
  EXPECT_EQ(locator_.find_world("file://worlds/farm.world"), farm);
}

TEST_F(Locator, NamesTheWorldsThatAreNearestToAWrongOne) {
  folder_.write("share/worlds/corn_plot.world", "");
  folder_.write("share/worlds/farm.world", "");
  folder_.write("share/worlds/notes.txt", "");
  const auto why = [this](const std::string& world) -> std::string {
    try {
      locator_.find_world(world);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const std::string expected =
      "', expected a file, here or below a folder of GAZEBO_RESOURCE_PATH; nearest: ";
  EXPECT_EQ(why("worlds/fram.world"), "found no world 'worlds/fram.world" + expected +
                                          "worlds/farm.world, worlds/corn_plot.world");
  EXPECT_EQ(why("fram.world"),
            "found no world 'fram.world" + expected + "worlds/farm.world, worlds/corn_plot.world");
  const std::string whole = folder_.path() + "/share/worlds/fram.world";
  EXPECT_EQ(why(whole), "found no file " + whole +
                            ", expected a world file; nearest: farm.world, corn_plot.world");
  EXPECT_EQ(why("/no/such.world"), "found no file /no/such.world, expected a world file");
}

TEST_F(Locator, NamesEachPlaceThatItSearchedOnceAndInFull) {
  locator_.add_model_path(folder_.path() + "/share");
  locator_.add_model_path(folder_.path() + "/models/");
  const std::string error = error_of("file://nothing.png");
  for (const std::string place : {"/share/nothing.png", "/models/nothing.png", "/nothing.png"}) {
    const std::string whole = " " + folder_.path() + place;
    EXPECT_HAS(error, whole);
    EXPECT_EQ(error.find(whole), error.rfind(whole)) << error;
  }
  EXPECT_HAS(error_of("beside.dae"),
             "searched: " + (std::filesystem::current_path() / "beside.dae").string());
}

TEST_F(Locator, ChoosesTheNewestSdfOfGazeboClassic) {
  folder_.write("models/a/model.config",
                "<model><sdf version='1.4'>old.sdf</sdf><sdf version='1.6'>model.sdf</sdf>"
                "<sdf version='1.5'>mid.sdf</sdf><sdf version='1.9'>new.sdf</sdf><sdf "
                "version='1.10'>new.sdf</sdf></model>");
  for (const char* name : {"old", "mid", "model", "new"})
    folder_.write("models/a/" + std::string(name) + ".sdf", "");
  EXPECT_EQ(locator_.resolve_model("model://a", {}), folder_.path() + "/models/a/model.sdf");
  folder_.write("models/b/model.config",
                "<model><sdf version='1.8'>x.sdf</sdf><sdf version='1.9'>y.sdf</sdf></model>");
  folder_.write("models/b/y.sdf", "");
  EXPECT_EQ(locator_.resolve_model("model://b", {}), folder_.path() + "/models/b/y.sdf");
}

TEST_F(Locator, TakesModelSdfWithoutAConfigAndAFileAsItIs) {
  const std::string sdf = folder_.write("models/a/model.sdf", "");
  EXPECT_EQ(locator_.resolve_model("model://a", {}), sdf);
  EXPECT_EQ(locator_.resolve_model("model://a/model.sdf", {}), sdf);
}

TEST_F(Locator, FindsPackagesByTheirManifest) {
  folder_.write("src/deep/pkg_folder/package.xml", "<package><name> my_pkg </name></package>");
  folder_.write("src/ignored/CATKIN_IGNORE", "");
  folder_.write("src/ignored/other/package.xml", "<package><name>other</name></package>");
  PackageIndex index({folder_.path() + "/src"});
  EXPECT_EQ(index.find("my_pkg"), folder_.path() + "/src/deep/pkg_folder");
  EXPECT_EQ(index.find("other"), std::nullopt);
  EXPECT_EQ(index.find("no_such_package"), std::nullopt);
}

TEST_F(Locator, FindsModelsThatPackagesExportToGazebo) {
  folder_.write("src/farm/package.xml",
                "<package><name>farm</name><export><gazebo_ros "
                "gazebo_model_path='${prefix}/models:${prefix}/..'/></export></package>");
  folder_.write("src/plain/package.xml", "<package><name>plain</name><export/></package>");
  const std::string barn = folder_.write("src/farm/models/barn/model.sdf", "");
  const std::string mesh = folder_.write("src/farm/meshes/cow.dae", "");
  auto index = std::make_shared<PackageIndex>(std::vector<std::string>{folder_.path() + "/src"});
  locator_.set_model_path_exports([index] { return index->exported_model_paths(); });
  EXPECT_EQ(locator_.resolve_model("model://barn", {}), barn);
  EXPECT_EQ(locator_.resolve("model://farm/meshes/cow.dae", {}), mesh);
  EXPECT_HAS(error_of("model://sty"), folder_.path() + "/src/farm/models/sty");
  const std::string own = folder_.write("models/barn/model.sdf", "");
  EXPECT_EQ(locator_.resolve_model("model://barn", {}), own) << "GAZEBO_MODEL_PATH comes first";
}

TEST_F(Locator, ReadsEveryExportOfAPackage) {
  folder_.write("src/farm/package.xml",
                "<package><name>farm</name><export><gazebo_ros gazebo_media_path='${prefix}'/>"
                "<other gazebo_model_path='/nowhere'/>"
                "<gazebo_ros plugin_path='${prefix}/lib' gazebo_model_path='${prefix}/a'/>"
                "<gazebo_ros gazebo_model_path='${prefix}/b:${prefix}/c/${prefix}'"
                " gazebo_media_path='/media'/></export></package>");
  PackageIndex index({folder_.path() + "/src"});
  const std::string farm = folder_.path() + "/src/farm";
  EXPECT_EQ(index.exported_model_paths(),
            (std::vector<std::string>{farm + "/a", farm + "/b", farm + "/c/" + farm}));
  EXPECT_EQ(index.exported_media_paths(), (std::vector<std::string>{farm, "/media"}));
}

TEST_F(Locator, FindsWorldsBelowTheMediaPathsThatPackagesExport) {
  folder_.write("src/farm/package.xml",
                "<package><name>farm</name><export><gazebo_ros "
                "gazebo_media_path='${prefix}'/></export></package>");
  const std::string world = folder_.write("src/farm/worlds/barn.world", "");
  auto index = std::make_shared<PackageIndex>(std::vector<std::string>{folder_.path() + "/src"});
  EXPECT_HAS(error_of("file://worlds/barn.world"), "expected an existing file");
  locator_.set_media_path_exports([index] { return index->exported_media_paths(); });
  EXPECT_EQ(locator_.resolve("file://worlds/barn.world", {}), world);
}

TEST(PathList, LeavesOutEmptyParts) {
  EXPECT_EQ(split_path_list("/a::/b:"), (std::vector<std::string>{"/a", "/b"}));
}

TEST_F(Locator, FindsWhatWasDownloadedFromFuel) {
  locator_.add_fuel_cache(folder_.path() + "/none");
  locator_.add_fuel_cache(folder_.path() + "/fuel");
  const std::string cone = "fuel/fuel.gazebosim.org/openrobotics/models/construction cone/";
  folder_.write(cone + "9/model.sdf", "");
  const std::string newest = folder_.write(cone + "10/model.sdf", "");
  const std::string mesh = folder_.write(cone + "9/meshes/a.dae", "");
  const std::string uri = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Construction%20Cone";
  EXPECT_EQ(locator_.resolve_model(uri, {}), newest);
  EXPECT_EQ(locator_.resolve_model(uri + "/tip", {}), newest);
  EXPECT_EQ(locator_.resolve(uri + "/9/files/meshes/a.dae", {}), mesh);
  for (const std::string& each :
       {uri + "/11", std::string("https://fuel.gazebosim.org/1.0/OpenRobotics/models"),
        std::string("http://x")}) {
    EXPECT_THROW(locator_.resolve(each, {}), FileError) << each;
    EXPECT_HAS(error_of(each), "found '" + each + "', expected what was downloaded before");
    EXPECT_HAS(error_of(each), folder_.path() + "/fuel");
  }
}

}  // namespace
}  // namespace ardee
