// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "../temp_folder.h"
#include "../test_data.h"
#include "gps_rig.h"

namespace ardee {
using namespace devices;
namespace {

/// Sets GAZEBO_RESOURCE_PATH for its lifetime.
class ResourcePath {
 public:
  explicit ResourcePath(const std::string& path) {
    const char* before = std::getenv(kName);
    if (before) before_ = before;
    setenv(kName, path.c_str(), 1);
  }
  ~ResourcePath() { before_ ? setenv(kName, before_->c_str(), 1) : unsetenv(kName); }

 private:
  static constexpr const char* kName = "GAZEBO_RESOURCE_PATH";
  std::optional<std::string> before_;
};

TEST(GpsFiles, elements_name_them) {
  const TempFolder folder;
  folder.write("my.geofence", "<robot>" + kBands + "</robot>");
  const std::string plots = folder.write("plots.xacro", "<robot>" + kTwoPlots + "</robot>");
  const ResourcePath path(folder.path());
  const std::string keys = "<geofenceFile>file://my.geofence</geofenceFile><plotsFile>" + plots +
                           "</plotsFile><gaussianNoise>0.1</gaussianNoise>";
  EXPECT_NEAR(stand(keys, at(30), 1).back().position_std_m, 0.5, 1e-9);
}

TEST(GpsFiles, plots_of_the_worlds_field_and_the_geofence_on_the_path) {
  const TempFolder folder;
  folder.write_model("field", "<static>true</static><link name='l'/>");
  folder.write("field/plots.xacro", "<robot>" + kTwoPlots + "</robot>");
  folder.write("default_gps_behavior.geofence", "<robot>" + kBands + "</robot>");
  const ResourcePath path(folder.path());
  const auto std_in_corn = [&folder] {
    TestWorld world(free_space(0.0) + "<include><uri>file://field</uri></include>", 0.1);
    world.spawn(still(gps("<gaussianNoise>0.1</gaussianNoise>")), "ball", at(30));
    world.run(0.1);
    for (const std::string& message : world.messages()) ADD_FAILURE() << message;
    return quality(world).back().position_std_m;
  };
  EXPECT_NEAR(std_in_corn(), 0.5, 1e-9);
  folder.write(
      "custom_gps_behavior.geofence",
      "<robot>" + bands(band("0", "-1", "<mean>1</mean><variance>100</variance>")) + "</robot>");
  EXPECT_NEAR(std_in_corn(), 1.0, 1e-9);
}

TEST(GpsFiles, a_field_without_a_plot_is_open_sky) {
  const TempFolder folder;
  folder.write_model("field", "<static>true</static><link name='l'/>");
  folder.write("field/plots.xacro", "<robot>\n</robot>");
  const ResourcePath path(folder.path());
  TestWorld world(free_space(0.0) + "<include><uri>file://field</uri></include>", 0.1);
  world.spawn(still(gps("<gaussianNoise>0.1</gaussianNoise>")), "ball", at(30));
  world.run(0.1);
  EXPECT_TRUE(world.messages().empty());
  EXPECT_NEAR(quality(world).back().position_std_m, 0.1, 1e-9);
}

TEST(GpsFiles, regions_follow_fields_that_come_later_and_go) {
  const TempFolder folder;
  folder.write_model("field", "<static>true</static><link name='l'/>");
  folder.write("field/plots.xacro", "<robot>" + kTwoPlots + "</robot>");
  folder.write("default_gps_behavior.geofence", "<robot>" + kBands + "</robot>");
  const ResourcePath path(folder.path());
  const std::string field = "<include><uri>file://field</uri></include>";
  std::string robot = still(gps("<gaussianNoise>0.1</gaussianNoise>"));
  robot = robot.substr(robot.find("<model"), robot.find("</sdf>") - robot.find("<model"));
  robot.insert(robot.find("<static>"), "<pose>30 0 0.5 0 0 0</pose>");
  for (const std::string& text : {robot + field, field + robot}) {
    TestWorld world(free_space(0.0) + text, 0.1);
    world->step();
    EXPECT_EQ(quality(world).back().region, "plot 8");
    EXPECT_NEAR(quality(world).back().position_std_m, 0.5, 1e-9);
    world->remove("field");
    world->step();
    EXPECT_EQ(quality(world).back().region, "");
    EXPECT_NEAR(quality(world).back().position_std_m, 0.1, 1e-9);
    Loader loader(ResourceLocator::from_environment(), Log([](LogLevel, const std::string&) {}));
    SpawnRequest again;
    again.name = "again";
    again.model = loader.load_model(folder.path() + "/field/model.sdf");
    world->spawn(again);
    world->step();
    EXPECT_EQ(quality(world).back().region, "plot 8");
    const auto shown = world.recorder().on<RegionsReading>("/gps/regions");
    ASSERT_EQ(shown.size(), 3u) << "once a change";
    EXPECT_EQ(shown[1].regions.size(), 0u);
    EXPECT_EQ(shown[2].regions.size(), 2u);
    EXPECT_TRUE(world.messages().empty());
  }
}

TEST(GpsFiles, a_field_that_comes_later_and_is_wrong_leaves_the_regions_as_they_are) {
  const TempFolder folder;
  folder.write_model("field", "<static>true</static><link name='l'/>");
  folder.write("field/plots.xacro", "<robot>\n<plot/></robot>");
  Loader loader(ResourceLocator::from_environment(), Log([](LogLevel, const std::string&) {}));
  TestWorld world(free_space(0.0), 0.1);
  world.spawn(still(gps("<gaussianNoise>0.1</gaussianNoise>")), "ball", at(30));
  SpawnRequest field;
  field.name = "field";
  field.model = loader.load_model(folder.path() + "/field/model.sdf");
  world->spawn(field);
  world.run(0.5);
  EXPECT_EQ(quality(world).back().region, "");
  ASSERT_EQ(world.messages().size(), 1u);
  EXPECT_NE(world.messages()[0].find("plots.xacro:2"), std::string::npos) << world.messages()[0];
}

TEST(GpsFiles, shipped_geofence_has_the_measured_error_under_tall_corn) {
  const std::string keys = plot("1", 0.0, 2.2) + "<geofenceFile>" + test_data() +
                           "/../../../ardee_geofence/default_gps_behavior.geofence</geofenceFile>";
  EXPECT_NEAR(stand(keys, at(0), 1).back().position_std_m, 1.37, 1e-9);
}

/// Returns the messages of a world in which a robot with this GPS is spawned, and whether it has
/// the GPS.
std::pair<std::vector<std::string>, bool> spawned(const std::string& keys) {
  TestWorld world(free_space(0.0));
  const bool has_gps = !world.spawn(ball(gps(keys)), "ball").devices.empty();
  return {world.messages(), has_gps};
}

TEST(GpsFiles, plots_in_no_band_are_named_once_and_have_the_open_skys_noise) {
  const TempFolder folder;
  const std::string low = bands(band("0", "2", "<mean>1</mean><variance>4</variance>"));
  std::string text = "<robot>\n" + plot("7", 0.0, 1.5) + "\n";
  for (const char* id : {"8", "9", "10", "11", "12"}) text += plot(id, 30.0, 2.5) + "\n";
  const std::string keys =
      low + "<plotsFile>" + folder.write("tall.xacro", text + "</robot>") + "</plotsFile>";
  const auto [messages, has_gps] = spawned(keys);
  EXPECT_TRUE(has_gps);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("tall.xacro:3: <plot>: found plot 8 of 2.5 m, plot 9 of 2.5 m, "
                             "plot 10 of 2.5 m and 2 more in no "
                             "<biomass_height_noise_coefficient>, expected a band for it; "
                             "the noise is the open sky's there"),
            std::string::npos)
      << messages[0];
  TestWorld world(free_space(0.0), 0.1);
  world.spawn(still(gps(keys + "<gaussianNoise>0.1</gaussianNoise>")), "ball", at(30));
  world->step();
  EXPECT_EQ(quality(world).back().region, "plot 8");
  EXPECT_NEAR(quality(world).back().position_std_m, 0.1, 1e-9);
}

TEST(GpsFiles, plots_in_no_band_of_density_are_named_where_there_are_such_bands) {
  const auto density = [](const std::string& r1) {
    return "<biomass_density_noise_coefficient><r1>" + r1 +
           "</r1><r2>-1</r2><mean>1</mean><variance>9</variance>"
           "</biomass_density_noise_coefficient>";
  };
  const std::string height = band("0", "-1", "<mean>1</mean><variance>4</variance>");
  EXPECT_EQ(spawned(plot("1", 0.0, 1.0) + bands(density("5"))).first.size(), 0u);
  const auto [messages, has_gps] = spawned(plot("1", 0.0, 1.0) + bands(height + density("8")));
  EXPECT_TRUE(has_gps);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("found plot 1 of 7 plants/m2 in no "
                             "<biomass_density_noise_coefficient>, expected a band for it; it adds "
                             "no noise there"),
            std::string::npos)
      << messages[0];
}

TEST(GpsFiles, fields_each_number_their_plots) {
  const TempFolder folder;
  std::string includes;
  for (const char* name : {"east", "west"}) {
    folder.write_model(name, "<static>true</static><link name='l'/>");
    folder.write(std::string(name) + "/plots.xacro",
                 "<robot>" + plot("0", name[0] == 'e' ? 30.0 : -30.0, 1.0) + "</robot>");
    includes += "<include><uri>file://" + std::string(name) + "</uri></include>";
  }
  const ResourcePath path(folder.path());
  TestWorld world(free_space(0.0) + includes, 0.1);
  world.spawn(still(gps(kBands)), "ball", at(30));
  world.run(0.1);
  EXPECT_EQ(quality(world).back().region, "plot 0");
  EXPECT_EQ(world.recorder().on<RegionsReading>("/gps/regions").at(0).regions.size(), 2u);
  EXPECT_TRUE(world.messages().empty());
}

TEST(GpsFiles, what_is_wrong_is_said_once_with_its_line_and_the_robot_spawns) {
  const TempFolder folder;
  const auto geofence = [&folder](const std::string& name, const std::string& text) {
    return "<geofenceFile>" + folder.write(name, text) + "</geofenceFile>";
  };
  const auto plots = [&folder](const std::string& name, const std::string& text) {
    return kBands + "<plotsFile>" + folder.write(name, text) + "</plotsFile>";
  };
  const auto without = [](std::string text, const std::string& key) {
    const std::size_t value = text.find("<" + key + ">") + key.size() + 2;
    return text.replace(value, text.find('<', value) - value, "0");
  };
  const std::string box =
      "<periodic_noise_box><cx>0</cx><cy>0</cy><cz>0</cz><w>4</w><l>4</l><h>2</h><rot>0</rot>"
      "<nps>1</nps><nmpm>1</nmpm><nmpv>0</nmpv><nvpm>1</nvpm><nvpv>0</nvpv></periodic_noise_box>";
  const std::string one = "\n<robot>\n" + bands("\n" + band("0", "-1", "X")) + "</robot>";
  const auto with = [&one](const std::string& inside) {
    std::string text = one;
    return text.replace(text.find('X'), 1, inside);
  };
  const struct {
    std::string keys;
    std::string expected;
  } cases[] = {
      {"<plotsFile>file://nowhere/plots.xacro</plotsFile>", "nowhere/plots.xacro"},
      {geofence("a", "<robot>\n<field_gps"), "a:"},
      {geofence("b", with("<mean>1</mean><variance>-4</variance>")), "b:4"},
      {geofence("c", with("<mean>1</mean>")), "c:4"},
      {geofence("d", with("<mean>${m}</mean><variance>1</variance>")), "d:4"},
      {geofence("e", "<robot>\n<plots/></robot>"), "e:2"},
      {bands(band("2", "1", "<mean>1</mean><variance>1</variance>")), "ball.urdf:1"},
      {bands("<band/>"), "ball.urdf:1"},
      {kBands + "<plot><plot_id>1</plot_id></plot>", "<x>"},
      {"<correlationTime>0</correlationTime>", "ball.urdf:1"},
      {geofence("f", "\n<robot/>"), "f:2: <robot>: found nothing in it"},
      {plots("g", "\n<robot/>"), "g:2: <robot>: found nothing in it"},
      {plots("h", "<robot>" + kBands + "</robot>"), "h: found no <plot> and no"},
      {plots("i", "<robot>\n" + without(plot("1", 0, 1), "row_length") + "</robot>"),
       "i:2: <row_length>: found '0', expected more than 0 m"},
      {plots("j", "<robot>\n" + without(plot("1", 0, 1), "row_width") + "</robot>"),
       "j:2: <row_width>: found '0', expected more than 0 m"},
      {without(box, "h"), "<h>: found '0', expected more than 0 m"},
      {plots("k",
             "<robot>" + plot("1", 0, 1) + plot("2", 9, 1) + "\n" + plot("1", 9, 1) + "</robot>"),
       "k:2: <plot_id>: found '1' again, expected an id of its own: line 1 has it"},
  };
  for (const auto& each : cases) {
    const auto [messages, has_gps] = spawned(each.keys);
    EXPECT_FALSE(has_gps) << each.keys;
    ASSERT_EQ(messages.size(), 1u) << each.keys;
    EXPECT_NE(messages[0].find(each.expected), std::string::npos) << messages[0];
  }
}

}  // namespace
}  // namespace ardee
