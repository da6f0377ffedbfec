// SPDX-License-Identifier: MIT
#include "fixture.h"

namespace ardee {
namespace {

using SdfWorld = ReadersTest;

TEST_F(SdfWorld, ReadsListingA15sSettings) {
  const World w = world(R"(
    <gui><camera name="user_camera"><pose>1.953330 -2.960521 2.117045 0 0.411456 1.892190</pose></camera></gui>
    <light name='sundir' type='directional'>
      <cast_shadows>1</cast_shadows><pose>0 0 10 0 -0 0</pose>
      <diffuse>1.0 0.95 0.8 1</diffuse><specular>0.7 0.7 0.7 1</specular>
      <attenuation><range>1000</range><constant>0.9</constant><linear>0.01</linear><quadratic>0.001</quadratic></attenuation>
      <direction>-0.3 0.4 -1.0</direction>
    </light>
    <physics type="ode"><max_step_size>0.005</max_step_size><real_time_factor>1.0</real_time_factor>
      <real_time_update_rate>0.0</real_time_update_rate><gravity>0 0 -9.8</gravity></physics>
    <scene><sky><clouds><speed>12</speed></clouds></sky><grid>true</grid></scene>)");
  EXPECT_EQ(w.name, "w");
  EXPECT_NEAR(w.gui_camera->p.x(), 1.95333, 1e-12);
  const Light& light = w.lights.at(0);
  EXPECT_EQ(light.name, "sundir");
  EXPECT_TRUE(light.cast_shadows);
  EXPECT_EQ(light.pose.p.z(), 10.0);
  EXPECT_TRUE(light.diffuse.isApprox(Color(1, 0.95f, 0.8f, 1)));
  EXPECT_EQ(light.range_m, 1000.0);
  EXPECT_EQ(light.attenuation_quadratic, 0.001);
  expect_near(light.direction, Eigen::Vector3d(-0.3, 0.4, -1).normalized());
  EXPECT_EQ(w.physics.step_s, 0.005);
  EXPECT_EQ(w.physics.real_time_update_rate_hz, 200.0);  // real time, at 5 ms a step
  EXPECT_EQ(w.physics.gravity_m_per_s2, Eigen::Vector3d(0, 0, -9.8));
  EXPECT_TRUE(w.scene.sky && w.scene.shadows);
  EXPECT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(warned("<clouds>: has no effect: the sky is clear"));
  EXPECT_TRUE(warned("<specular>: has no effect: surfaces are matt, without highlights"));
}

TEST_F(SdfWorld, PaceIsTheUpdateRateElseTheRealTimeFactorElseRealTime) {
  const auto rate = [this](const std::string& keys) {
    return world("<physics type='ode'><max_step_size>0.01</max_step_size>" + keys + "</physics>")
        .physics.real_time_update_rate_hz;
  };
  EXPECT_EQ(rate("<real_time_update_rate>500</real_time_update_rate>"
                 "<real_time_factor>1</real_time_factor>"),
            500.0);
  EXPECT_EQ(rate("<real_time_factor>2</real_time_factor>"), 200.0);
  EXPECT_EQ(rate("<real_time_update_rate>0</real_time_update_rate>"), 0.0);
  EXPECT_EQ(rate(""), 100.0);
}

TEST_F(SdfWorld, ReadsTheSolver) {
  const World w = world(R"(<physics type='ode'><max_contacts>12</max_contacts><ode>
      <solver><type>world</type><iters>70</iters><sor>1.1</sor></solver>
      <constraints><cfm>1e-5</cfm><erp>0.3</erp><contact_max_correcting_vel>50</contact_max_correcting_vel>
        <contact_surface_layer>0.002</contact_surface_layer></constraints></ode></physics>)");
  EXPECT_EQ(w.physics.solver, PhysicsParams::Solver::kWorld);
  EXPECT_EQ(w.physics.iterations, 70);
  EXPECT_EQ(w.physics.sor, 1.1);
  EXPECT_EQ(w.physics.cfm, 1e-5);
  EXPECT_EQ(w.physics.erp, 0.3);
  EXPECT_EQ(w.physics.max_correcting_velocity_m_per_s, 50.0);
  EXPECT_EQ(w.physics.contact_surface_layer_m, 0.002);
  EXPECT_EQ(w.physics.max_contacts, 12);
}

TEST_F(SdfWorld, ReadsOldPhysicsAndNewGravity) {
  const World old = world(
      "<physics type='ode'><update_rate>500</update_rate><ode><solver><dt>0.002</dt></solver></ode>"
      "<gravity>0 0 -3</gravity></physics>",
      "1.3");
  EXPECT_EQ(old.physics.step_s, 0.002);
  EXPECT_EQ(old.physics.real_time_update_rate_hz, 500.0);
  EXPECT_EQ(old.physics.gravity_m_per_s2.z(), -3.0);
  const World now = world("<gravity>0 0 -1.6</gravity><physics type='bullet'/>", "1.6");
  EXPECT_EQ(now.physics.gravity_m_per_s2.z(), -1.6);
  EXPECT_TRUE(warned("found type 'bullet', ode is used"));
}

TEST_F(SdfWorld, ReadsThePace) {
  const auto rate = [this](const std::string& body) {
    return world("<physics type='ode'><max_step_size>0.01</max_step_size>" + body + "</physics>")
        .physics.real_time_update_rate_hz;
  };
  EXPECT_EQ(rate(""), 100.0);
  EXPECT_EQ(rate("<real_time_factor>2</real_time_factor>"), 200.0);
  EXPECT_EQ(rate("<real_time_update_rate>0</real_time_update_rate>"), 0.0);
  EXPECT_EQ(rate("<real_time_update_rate>50</real_time_update_rate><real_time_factor>2</"
                 "real_time_factor>"),
            50.0);
  EXPECT_HAS(error_of([&] { rate("<real_time_update_rate>-1</real_time_update_rate>"); }),
             "<real_time_update_rate>: found '-1', expected a number in [0, 1e+06]");
}

TEST_F(SdfWorld, TakesTheDefaultOfSeveralPhysics) {
  const World w = world(
      "<physics name='a' type='ode'><max_step_size>0.002</max_step_size></physics>"
      "<physics name='b' default='1' type='ode'><max_step_size>0.004</max_step_size></physics>");
  EXPECT_EQ(w.physics.step_s, 0.004);
}

TEST_F(SdfWorld, ReadsSceneAndPlaceOnEarth) {
  const World w = world(R"(
      <scene><ambient>0.1 0.2 0.3 1</ambient><background>0.4 0.5 0.6 1</background><shadows>0</shadows><grid>0</grid></scene>
      <spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>40.1</latitude_deg>
        <longitude_deg>-88.2</longitude_deg><elevation>220</elevation><heading_deg>90</heading_deg></spherical_coordinates>
      <plugin name='p' filename='libp.so'/>)");
  EXPECT_TRUE(w.scene.ambient.isApprox(Color(0.1f, 0.2f, 0.3f, 1)));
  EXPECT_TRUE(w.scene.background.isApprox(Color(0.4f, 0.5f, 0.6f, 1)));
  EXPECT_FALSE(w.scene.sky || w.scene.shadows);
  EXPECT_EQ(w.spherical_coordinates->latitude_deg, 40.1);
  EXPECT_EQ(w.spherical_coordinates->longitude_deg, -88.2);
  EXPECT_EQ(w.spherical_coordinates->elevation_m, 220.0);
  EXPECT_EQ(w.spherical_coordinates->heading_deg, 90.0);
  EXPECT_EQ(w.plugins.at(0).filename, "libp.so");
}

TEST_F(SdfWorld, ReadsPointAndSpotLights) {
  const World w = world(R"(<light name='p' type='point'/>
      <light name='s' type='spot'><spot><inner_angle>0.1</inner_angle><outer_angle>0.5</outer_angle><falloff>1</falloff></spot></light>)");
  EXPECT_EQ(w.lights.at(0).type, Light::Type::kPoint);
  EXPECT_EQ(w.lights.at(1).type, Light::Type::kSpot);
  EXPECT_EQ(w.lights.at(1).outer_angle_rad, 0.5);
}

TEST_F(SdfWorld, APointLightNeedsNoDirection) {
  const World w = world("<light name='p' type='point'><direction>0 0 0</direction></light>");
  EXPECT_EQ(w.lights.at(0).type, Light::Type::kPoint);
  EXPECT_HAS(error_of([&] {
               world("<light name='d' type='directional'><direction>0 0 0</direction></light>");
             }),
             "direction of length zero");
}

TEST_F(SdfWorld, AnEmptyPoseIsNone) {
  const World w = world("<model name='a'><pose/><link name='l'><pose> </pose></link></model>");
  expect_near(w.models.at(0).pose.p, {0, 0, 0});
  expect_near(w.models.at(0).model->links.at(0).X_ML.p, {0, 0, 0});
}

TEST_F(SdfWorld, SaysWhatItLeavesOut) {
  world("<actor name='a'/><road name='r'/><state world_name='w'/>");
  EXPECT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(warned("<actor>: has no effect: not supported in a world, left out"));
}

TEST_F(SdfWorld, OfAVersionBeforeTheFirstIsReadAsThat) {
  EXPECT_EQ(world("", "1.0").name, "w");
  EXPECT_TRUE(warned("found version 1.0, read as SDF 1.2"));
}

TEST_F(SdfWorld, ALightOfItsOwnIsRead) {
  const auto made = loader_.load_model_or_light_text(
      "<sdf version='1.6'><light name='lamp' type='point'><pose>0 0 2 0 0 0</pose></light></sdf>",
      "lamp.sdf");
  const Light light = std::get<Light>(made);
  EXPECT_EQ(light.name, "lamp");
  EXPECT_EQ(light.type, Light::Type::kPoint);
  EXPECT_EQ(light.pose.p.z(), 2.0);
  const auto model = loader_.load_model_or_light_text(
      "<sdf version='1.6'><model name='m'><link name='l'/></model></sdf>", "m.sdf");
  EXPECT_EQ(std::get<0>(model)->name, "m");
}

}  // namespace
}  // namespace ardee
