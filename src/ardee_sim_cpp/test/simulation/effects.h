// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace ardee {

/// Two values of an element that make one world behave differently.
struct Effect {
  std::string element;  // "place/name", as in the table of elements
  std::string world;    // {} stands for the element
  const char* one;
  const char* other;
};

inline std::string in_model(const std::string& name, const std::string& inside,
                            const std::string& pose = "0 0 0 0 0 0") {
  return "<model name='" + name + "'><pose>" + pose + "</pose>" + inside + "</model>";
}
inline std::string in_link(const std::string& inside, const std::string& name = "l") {
  return "<link name='" + name + "'>" + inside + "</link>";
}
inline std::string still(const std::string& name, const std::string& inside,
                         const std::string& pose = "0 0 0 0 0 0") {
  return in_model(name, "<static>true</static>" + inside, pose);
}
inline std::string collision(const std::string& geometry, const std::string& more = "") {
  return "<collision name='c'><geometry>" + geometry + "</geometry>" + more + "</collision>";
}
inline std::string visual(const std::string& geometry, const std::string& more = "") {
  return "<visual name='v'><geometry>" + geometry + "</geometry>" + more + "</visual>";
}
inline std::string physics_block(const std::string& inside) {
  return "<physics type='ode'>" + inside + "</physics>";
}

constexpr char kCube[] = "<box><size>1 1 1</size></box>";
constexpr char kFloor[] =
    "<model name='floor'><static>true</static><link name='l'><collision name='c'><geometry><plane>"
    "<normal>0 0 1</normal></plane></geometry></collision></link></model>";

/// Returns a cube of one kilogram that is thrown down askew, on ground of the same kind.
inline std::string thrown(const std::string& in_collision, const std::string& z_m = "0.495") {
  const std::string ground = "<plane><normal>0 0 1</normal></plane>";
  return still("floor", in_link(collision(ground, in_collision))) +
         in_model("cube", in_link(collision(kCube, in_collision)), "0 0 0.5 0 0 0") +
         "<state world_name='w'><model name='cube'><link name='l'><pose>0 0 " + z_m +
         " 0 0 0.3</pose>"
         "<velocity>1 0.5 -1 0 0 1</velocity></link></model></state>";
}

/// Returns a pile with more contacts than the direct solver takes.
inline std::string pile() {
  std::string cubes = kFloor;
  for (int i = 0; i < 20; ++i) {
    cubes += in_model(
        "c" + std::to_string(i), in_link(collision(kCube)),
        std::to_string(0.1 * (i % 3)) + " 0 " + std::to_string(0.49 + 0.99 * i) + " 0 0 0");
  }
  return cubes;
}

/// Returns a weight on a joint of the world, 1 m out along x.
inline std::string jointed(const std::string& in_joint, const std::string& type = "revolute",
                           const std::string& in_arm = "",
                           const std::string& joint_pose = "-1 0 0 0 0 0") {
  return in_model("arm", in_link("<pose>1 0 0 0 0 0</pose>" + in_arm) + "<joint name='j' type='" +
                             type + "'><parent>world</parent><child>l</child><pose>" + joint_pose +
                             "</pose>" + in_joint + "</joint>");
}
inline std::string axis(const std::string& inside, const std::string& xyz = "0 1 0",
                        const std::string& name = "axis") {
  return "<" + name + "><xyz>" + xyz + "</xyz>" + inside + "</" + name + ">";
}
/// Returns a joint of two axes whose weight turns about both.
inline std::string two_axes(const std::string& first, const std::string& second,
                            const std::string& joint_pose = "-1 0 0 0 0 0") {
  return jointed(first + second, "universal", "", joint_pose) +
         "<state world_name='w'><model name='arm'><link name='l'><pose>1 0 0 0 0 0</pose><velocity>"
         "0 1 0 0 0 1</velocity></link></model></state>";
}

/// Returns a sensor on a post of 1 m.
inline std::string post(const std::string& type, const std::string& in_sensor,
                        const std::string& plugin, const std::string& keys) {
  return still(
      "post_of_" + type,
      in_link("<sensor name='s' type='" + type + "'>" + in_sensor +
              "<plugin name='p' filename='lib" + plugin + ".so'>" + keys + "</plugin></sensor>"),
      "0 0 1 0 0 0");
}
inline std::string lidar(const std::string& scan, const std::string& range,
                         const std::string& noise = "", const std::string& in_sensor = "",
                         const std::string& type = "ray") {
  return post(
      type,
      in_sensor + "<ray><scan>" + scan + "</scan><range>" + range + "</range>" + noise + "</ray>",
      type == "ray" ? "gazebo_ros_block_laser" : "gazebo_ros_gpu_laser",
      "<topicName>scan</topicName>");
}
inline std::string scan(const std::string& more = "", const std::string& vertical = "") {
  return "<horizontal><samples>5</samples><min_angle>-0.3</min_angle><max_angle>0.3</max_angle>" +
         more + "</horizontal>" + vertical;
}
constexpr char kRange[] = "<min>0.1</min><max>30</max>";
constexpr char kPicture[] = "<image><width>24</width><height>18</height></image>";

inline std::string camera(const std::string& in_camera, const std::string& in_sensor = "",
                          const std::string& image = kPicture) {
  return post(
      "camera",
      "<update_rate>20</update_rate>" + in_sensor + "<camera>" + image + in_camera + "</camera>",
      "gazebo_ros_camera", "<exposure>1</exposure>");
}
/// Returns a camera with a cube, a ground and a wall 3 m ahead, in the given light.
inline std::string pictured(
    const std::string& of_cube,
    const std::string& light =
        "<light name='sun' type='directional'><cast_shadows>1</cast_shadows>"
        "<direction>0.6 0.5 -1</direction></light>",
    const std::string& in_visual = "") {
  return camera("") + light + still("cube", in_link(visual(of_cube, in_visual)), "3 0 1 0 0 0.4") +
         still("ground", in_link(visual("<box><size>20 20 0.1</size></box>"))) +
         still("wall", in_link(visual("<box><size>0.1 20 9</size></box>")), "6 0 1 0 0 0");
}
inline std::string lamp(const std::string& type, const std::string& inside) {
  return "<light name='lamp' type='" + type + "'><pose>2 1.5 4 0 0 0</pose>" + inside + "</light>";
}

/// Returns an IMU at rest with a <noise>.
inline std::string imu(const std::string& in_imu) {
  return post("imu", "<update_rate>50</update_rate><imu>" + in_imu + "</imu>",
              "gazebo_ros_imu_sensor",
              "<topicName>imu</topicName><frameName>l</frameName><updateRateHZ>50</updateRateHZ>");
}

std::vector<Effect> effects();
void add_sensor_effects(std::vector<Effect>& rows);

}  // namespace ardee
