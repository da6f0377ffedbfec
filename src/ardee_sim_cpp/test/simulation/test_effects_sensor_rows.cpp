// SPDX-License-Identifier: MIT
// Rows for the elements of SDF's sensors that act and hold numbers.
#include <tuple>

#include "effects.h"

namespace ardee {
namespace {

void add_rays(std::vector<Effect>& rows) {
  const std::string wall =
      still("wall", in_link(collision("<box><size>0.1 20 9</size></box>")), "6 0 1 0.2 0.3 0.4");
  const std::string up =
      "<vertical><samples>3</samples><min_angle>-0.1</min_angle><max_angle>0.1"
      "</max_angle>{}</vertical>";
  const auto with = [&](const std::string& whole) { return lidar(whole, kRange) + wall; };
  rows.push_back({"sensor/update_rate", lidar(scan(), kRange, "", "{}") + wall, "10", "50"});
  for (const auto& [name, one, other] :
       {std::tuple("samples", "4", "7"), std::tuple("resolution", "1", "2"),
        std::tuple("min_angle", "-0.2", "0.05"), std::tuple("max_angle", "0.1", "0.2")}) {
    const std::string cut = std::string("<") + name + ">";
    std::string across =
        "<horizontal><samples>5</samples><min_angle>-0.3</min_angle><max_angle>0.3"
        "</max_angle>{}</horizontal>";
    std::string upward = up;
    for (std::string* text : {&across, &upward}) {  // the requested part stands alone
      const std::size_t from = text->find(cut);
      if (from == std::string::npos) continue;
      const std::string end = std::string("</") + name + ">";
      text->erase(from, text->find(end) + end.size() - from);
    }
    rows.push_back({std::string("horizontal/") + name, with(across), one, other});
    rows.push_back({std::string("vertical/") + name, with(scan("", upward)), one, other});
  }
  const auto newer = [](const std::string& range) {
    return post("ray", "<lidar><scan>" + scan() + "</scan><range>" + range + "</range></lidar>",
                "gazebo_ros_block_laser", "<topicName>scan</topicName>");
  };
  const std::string gaussian = "<noise><type>gaussian_quantized</type>";
  rows.insert(
      rows.end(),
      {{"lidar/range/min", newer("{}<max>30</max>") + wall, "0.1", "8"},
       {"lidar/range/max", newer("<min>0.1</min>{}") + wall, "30", "3"},
       {"ray/range/min", lidar(scan(), "{}<max>30</max>") + wall, "0.1", "8"},
       {"ray/range/max", lidar(scan(), "<min>0.1</min>{}") + wall, "30", "3"},
       {"noise/mean", lidar(scan(), kRange, gaussian + "{}</noise>") + wall, "0", "0.1"},
       {"noise/stddev", lidar(scan(), kRange, gaussian + "{}</noise>") + wall, "0", "0.1"},
       {"noise/precision", lidar(scan(), kRange, gaussian + "{}</noise>") + wall, "0", "0.3"}});
}

void add_cameras(std::vector<Effect>& rows) {
  const std::string thing = still("cube", in_link(visual(kCube)), "3 0 1 0 0 0.4") +
                            "<light name='sun' type='directional'/>";
  const auto lens = [&](const std::string& inside) {
    return camera("<lens><type>gnomonical</type><intrinsics>" + inside + "</intrinsics></lens>") +
           thing;
  };
  rows.insert(rows.end(),
              {{"sensor/camera/horizontal_fov", camera("{}") + thing, "1", "1.5"},
               {"camera/image/width",
                camera("", "", "<image>{}<height>18</height></image>") + thing, "24", "30"},
               {"camera/image/height", camera("", "", "<image>{}<width>24</width></image>") + thing,
                "18", "20"},
               {"clip/near", camera("<clip>{}<far>100</far></clip>") + thing, "0.1", "3"},
               {"clip/far", camera("<clip><near>0.1</near>{}</clip>") + thing, "100", "2.5"}});
  for (const char* number : {"k1", "k2", "k3", "p1", "p2"}) {
    rows.push_back({std::string("distortion/") + number,
                    camera("<distortion>{}</distortion>") + thing, "0", "0.3"});
  }
  for (const char* number : {"fx", "fy", "cx", "cy"}) {
    rows.push_back({std::string("intrinsics/") + number, lens("{}"), "10", "14"});
  }
  rows.push_back({"intrinsics/s", lens("{}"), "0", "3"});
}

void add_imus(std::vector<Effect>& rows) {
  for (const std::string axis : {"x", "y", "z"}) {
    rows.push_back({"magnetometer/" + axis + "/noise/stddev",
                    still("m", in_link("<sensor name='s' type='magnetometer'><topic>field</topic>"
                                       "<magnetometer><" +
                                       axis +
                                       "><noise type='gaussian'>{}</noise>"
                                       "</" +
                                       axis + "></magnetometer></sensor>")),
                    "0", "1"});
  }
  const auto noise = [](const std::string& others) {
    return "<noise type='gaussian_quantized'>" + others + "{}</noise>";
  };
  struct Number {
    const char* name;
    const char* others;
  };
  const Number numbers[] = {
      {"mean", ""},
      {"stddev", ""},
      {"bias_mean", ""},
      {"bias_stddev", ""},
      {"dynamic_bias_stddev", "<dynamic_bias_correlation_time>1</dynamic_bias_correlation_time>"},
      {"dynamic_bias_correlation_time", "<dynamic_bias_stddev>1</dynamic_bias_stddev>"},
      {"precision", "<mean>0.3</mean>"}};
  for (const Number& number : numbers) {
    const std::string one = noise(number.others);
    for (const std::string axis : {"x", "y", "z"}) {
      rows.push_back(
          {axis + "/noise/" + number.name,
           imu("<angular_velocity><" + axis + ">" + one + "</" + axis + "></angular_velocity>"),
           "0", "0.2"});
    }
    if (std::string(number.name).rfind("dynamic", 0) == 0 ||
        std::string(number.name) == "precision") {
      continue;  // SDF 1.4's <noise> lacks it
    }
    for (const std::string kind : {"rate", "accel"}) {
      rows.push_back({"imu/noise/" + kind + "/" + number.name,
                      imu("<noise><type>gaussian</type><" + kind + ">{}</" + kind + "></noise>"),
                      "0", "0.2"});
    }
  }
}

}  // namespace

void add_sensor_effects(std::vector<Effect>& rows) {
  for (const auto add : {add_rays, add_cameras, add_imus}) add(rows);
}

}  // namespace ardee
