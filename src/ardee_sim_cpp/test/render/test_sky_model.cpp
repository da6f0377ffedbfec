// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/render/sky_model.h"
#include "pictures.h"

namespace ardee::test {
namespace {

Daylight day_of(double elevation_deg, double turbidity = 3.0, double cloud = 0.0,
                double azimuth_deg = 135.0) {
  return {azimuth_deg, elevation_deg, turbidity, cloud};
}

/// Direction at an azimuth from north and a height above the horizon.
Eigen::Vector3d towards_sky(double azimuth_deg, double elevation_deg) {
  return day_of(elevation_deg, 3.0, 0.0, azimuth_deg).to_sun_W();
}

/// Returns shares of the noon sun's light, from display values.
Eigen::Vector3f decoded(const Eigen::Vector3f& shown) {
  return (shown / SkyModel::kNoonSun).array().pow(2.2f);
}

float luminance(const Eigen::Vector3f& shown) {
  return decoded(shown).dot(Eigen::Vector3f(0.2126f, 0.7152f, 0.0722f));
}

TEST(Daylight, AzimuthIsClockwiseFromNorth) {
  EXPECT_TRUE(towards_sky(0, 0).isApprox(Eigen::Vector3d(0, 1, 0), 1e-12));
  EXPECT_TRUE(towards_sky(90, 0).isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  EXPECT_TRUE(towards_sky(90, 30).isApprox(Eigen::Vector3d(std::sqrt(0.75), 0, 0.5), 1e-12));
}

TEST(Daylight, NumbersOutOfRangeAreRefused) {
  EXPECT_NO_THROW(check_daylight(day_of(0.0, 2.0, 1.0)));
  const double nan = std::nan("");
  for (const Daylight& wrong : {day_of(-0.1), day_of(90.1), day_of(45, 1.9), day_of(45, 11),
                                day_of(45, 3, -0.1), day_of(45, 3, 1.1), day_of(nan)}) {
    EXPECT_THROW(check_daylight(wrong), Error);
  }
  try {
    check_daylight(day_of(-5));
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "daylight: found elevation_deg -5, expected 0 to 90");
  }
}

/// At the zenith the air mass is 1; at 550 nm and turbidity 3 the transmittance is
/// exp(-0.008735 * 0.55^-4.08 - 0.09238 * 0.55^-1.3) = exp(-0.1001 - 0.2010) = 0.7400, at 60
/// degrees (air mass 1.1539) exp(-0.3011 * 1.1539) = 0.7065.
TEST(SkyModel, SunIsDimmedByItsWayThroughTheAir) {
  EXPECT_NEAR(SkyModel(day_of(60)).sun()[1], SkyModel::kNoonSun, 1e-6);
  EXPECT_NEAR(decoded(SkyModel(day_of(90)).sun())[1], 0.7400 / 0.7065, 0.001);
}

/// Preetham at the zenith, the sun there too, turbidity 3: chi is (4/9 - 3/120) pi = 1.3177 and the
/// luminance (4.0453 * 3 - 4.9710) tan(chi) - 0.2155 * 3 + 2.4192 = 29.48 kcd/m^2. The noon sun
/// lights a white surface to 133.8 * 0.7065 / pi = 30.09 kcd/m^2. Perez at 60 degrees, relative to
/// that: (1 - 0.9269 exp(-0.6387 / 0.5)) (1 + 5.2572 exp(-2.2153 pi / 3) + 0.1693 / 4) / ((1 -
/// 0.9269 exp(-0.6387)) (1 + 5.2572 + 0.1693)) = 0.3523.
TEST(SkyModel, ClearSkyIsThatOfThePaper) {
  const SkyModel sky(day_of(90));
  const float zenith = luminance(sky.color({0, 0, 1}));
  EXPECT_NEAR(zenith, 29.48f / 30.09f, 0.003f);
  EXPECT_NEAR(luminance(sky.color(towards_sky(40, 30))) / zenith, 0.3523f, 0.002f);
}

TEST(SkyModel, LightIsSteadyDownToTheHorizon) {
  const auto red = [](double elevation_deg) { return SkyModel(day_of(elevation_deg, 2)).sun()[0]; };
  for (const double elevation_deg : {1e-6, 1e-4, 1e-3, 1e-2}) {
    EXPECT_NEAR(red(elevation_deg), red(0.0), 0.01f * red(0.0) + 10.0 * elevation_deg);
  }
  EXPECT_EQ(SkyModel(day_of(0, 2, 1.0)).sun()[0], 0.0f);
}

TEST(SkyModel, NoonIsWhiteAndALowSunRed) {
  const Eigen::Vector3f noon = SkyModel(day_of(60)).sun();
  EXPECT_TRUE(noon.isApprox(Eigen::Vector3f::Constant(SkyModel::kNoonSun), 1e-5f));
  const Eigen::Vector3f low = decoded(SkyModel(day_of(5)).sun());
  EXPECT_GT(low[0], 1.5f * low[1]);
  EXPECT_GT(low[1], 1.5f * low[2]);
  EXPECT_LT(low[0], 0.5f);
}

TEST(SkyModel, ClearSkyIsBlueAndBrightestAboutTheSun) {
  const SkyModel sky(day_of(40));
  const Eigen::Vector3f opposite = decoded(sky.color(towards_sky(315, 60)));
  EXPECT_GT(opposite[2], 1.3f * opposite[0]);
  const float about_the_sun = luminance(sky.color(towards_sky(135, 45)));
  for (double azimuth = 180; azimuth <= 450; azimuth += 30) {
    EXPECT_GT(about_the_sun, luminance(sky.color(towards_sky(azimuth, 45)))) << azimuth;
  }
}

TEST(SkyModel, SkyTurnsWithTheSun) {
  const SkyModel one(day_of(30, 4, 0.3, 90)), other(day_of(30, 4, 0.3, 210));
  EXPECT_TRUE(one.color(towards_sky(10, 20)).isApprox(other.color(towards_sky(130, 20)), 1e-4f));
}

/// CIE: the zenith is three times as bright as the horizon, and the sky has no colour. The light of
/// a level plane is 7/9 of that of the zenith.
TEST(SkyModel, FullCloudIsTheOvercastSkyOfCie) {
  const SkyModel sky(day_of(50, 3, 1.0));
  EXPECT_NEAR(luminance(sky.sun()), 0.0f, 1e-5f);
  const Eigen::Vector3f zenith = sky.color({0, 0, 1});
  EXPECT_NEAR(zenith[0], zenith[2], 1e-5f);
  EXPECT_NEAR(luminance(zenith) / luminance(sky.color({1, 0, 0})), 3.0f, 1e-3f);
  EXPECT_TRUE(sky.color(towards_sky(20, 30)).isApprox(sky.color(towards_sky(200, 30)), 1e-5f));
  const float level = luminance(sky.ambient({0, 0, 1})) - luminance(sky.ambient({0, 0, -1}));
  EXPECT_NEAR(level / luminance(zenith), 7.0f / 9.0f, 1e-3f);
}

/// Kasten and Czeplak: under full cloud the ground gets a quarter of a clear day's light.
TEST(SkyModel, CloudsTakeThreeQuartersOfTheLight) {
  const auto on_ground = [](double cloud) {
    const SkyModel sky(day_of(50, 3, cloud));
    const float from_sky = luminance(sky.ambient({0, 0, 1})) - luminance(sky.ambient({0, 0, -1}));
    return from_sky + static_cast<float>(std::sin(50 * kPi / 180)) * decoded(sky.sun())[1];
  };
  EXPECT_NEAR(on_ground(1.0) / on_ground(0.0), 0.25f, 0.01f);
  EXPECT_NEAR(on_ground(0.5) / on_ground(0.0), 1.0 - 0.75 * std::pow(0.5, 3.4), 0.01f);
}

TEST(SkyModel, PicturesShowIt) {
  TestStage stage;
  MaterialLibrary materials((Log()));
  RayScene rays(SceneKind::kVisual, {}, Log());
  rays.prepare({{0, 0, 1}});
  Camera camera;  // looks along x
  camera.X_WC = Pose::from_xyz_rpy({0, 0, 1}, {0, -0.5, 0});
  camera.width = camera.height = 9;
  const auto blue_to_red = [&](double cloud) {
    const Renderer renderer(rays.pictures(), materials, stage.scene, {}, day_of(50, 3, cloud));
    const Image image = renderer.render(camera, {});
    const std::size_t middle = image.index(4, 4);
    return static_cast<double>(image.samples8[middle + 2]) / image.samples8[middle];
  };
  EXPECT_GT(blue_to_red(0.0), 1.2);
  EXPECT_NEAR(blue_to_red(1.0), 1.0, 0.02);
}

}  // namespace
}  // namespace ardee::test
