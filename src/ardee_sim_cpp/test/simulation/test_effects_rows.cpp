// SPDX-License-Identifier: MIT
// Rows for the elements of SDF that act and hold numbers or switches.
#include "../test_data.h"
#include "effects.h"

namespace ardee {
namespace {

void add_world(std::vector<Effect>& rows) {
  const std::string falling = in_model("ball", in_link(""));
  const auto solver = [](const std::string& part) {
    return physics_block("<ode><solver>{}</solver></ode>") + part;
  };
  const auto constraints = [](const std::string& part) {
    return physics_block("<ode><constraints>{}</constraints></ode>") + part;
  };
  rows.insert(
      rows.end(),
      {{"world/gravity", "{}" + falling, "0 0 -9.8", "0 0 -1.6"},
       {"physics/gravity", physics_block("{}") + falling, "0 0 -9.8", "0 0 -1.6"},
       {"physics/max_step_size", physics_block("{}") + falling, "0.001", "0.002"},
       {"physics/@default",
        physics_block("") +
            "<physics name='other' type='ode' {}><max_step_size>0.002</max_step_size>"
            "</physics>" +
            falling,
        "0", "1"},
       {"physics/real_time_update_rate", physics_block("{}"), "100", "200"},
       {"physics/update_rate", physics_block("{}"), "100", "200"},
       {"physics/real_time_factor", physics_block("{}"), "1", "2"},
       {"physics/max_contacts", physics_block("{}") + thrown(""), "20", "1"},
       {"solver/dt", solver(falling), "0.001", "0.002"},
       {"solver/iters", solver(pile()), "5", "50"},
       {"solver/sor", solver(pile()), "1.3", "0.7"},
       {"constraints/cfm", constraints(thrown("")), "0", "0.1"},
       {"constraints/erp", constraints(jointed(axis("<limit><lower>0.1</lower></limit>"))), "0.2",
        "0.8"},
       {"constraints/contact_max_correcting_vel",
        constraints(
            thrown("<surface><contact><ode><max_vel>10</max_vel></ode></contact></surface>")),
        "100", "0.001"},
       {"constraints/contact_surface_layer", constraints(thrown("", "0.4995")), "0.001", "0.0001"},
       {"scene/ambient", "<scene>{}</scene>" + pictured(kCube), "0.1 0.1 0.1 1", "0.6 0.6 0.6 1"},
       {"scene/background", "<scene>{}</scene>" + camera(""), "0 0 0 1", "1 1 1 1"},
       {"scene/shadows", "<scene>{}</scene>" + pictured(kCube), "0", "1"},
       {"pose/@degrees", "<model name='m'><pose {}>0 0 0 0 0 1</pose>" + in_link("") + "</model>",
        "0", "1"}});
  const std::string receiver =
      in_model("m",
               in_link("") +
                   "<plugin name='p' filename='libhector_gazebo_ros_gps.so'><updateRate>50"
                   "</updateRate><useWorldSphericalCoordinates>1"
                   "</useWorldSphericalCoordinates></plugin>",
               "5 3 0 0 0 0");
  for (const std::string angle : {"latitude_deg", "longitude_deg", "elevation", "heading_deg"}) {
    rows.push_back({"spherical_coordinates/" + angle,
                    "<spherical_coordinates>{}</spherical_coordinates>" + receiver, "10", "20"});
  }
}

void add_population(std::vector<Effect>& rows) {
  const auto of = [](const std::string& region, const std::string& distribution,
                     const std::string& more = "") {
    return "<population name='p'>" + more + in_model("m", in_link("")) + region + "<distribution>" +
           distribution + "</distribution></population>";
  };
  const std::string box = "<box><size>4 4 0</size></box>";
  const std::string grid = "<type>grid</type>";
  rows.insert(rows.end(),
              {{"population/model_count", of(box, "<type>linear-x</type>", "{}"), "2", "3"},
               {"distribution/rows", of(box, grid + "{}"), "2", "3"},
               {"distribution/cols", of(box, grid + "{}"), "2", "3"},
               {"distribution/step", of(box, grid + "<cols>2</cols>{}"), "1 1 0", "2 2 0"}});
}

void add_lights(std::vector<Effect>& rows) {
  const std::string sun =
      "<light name='sun' type='directional'><direction>0.6 0.5 -1</direction>{}</light>";
  rows.insert(
      rows.end(),
      {{"light/cast_shadows", pictured(kCube, sun), "0", "1"},
       {"light/diffuse", pictured(kCube, sun), "1 1 1 1", "0.2 0.2 0.2 1"},
       {"light/direction", pictured(kCube, "<light name='sun' type='directional'>{}</light>"),
        "0 0 -1", "1 0 -1"},
       {"attenuation/range", pictured(kCube, lamp("point", "<attenuation>{}</attenuation>")), "20",
        "3"},
       {"attenuation/constant", pictured(kCube, lamp("point", "<attenuation>{}</attenuation>")),
        "1", "3"},
       {"attenuation/linear", pictured(kCube, lamp("point", "<attenuation>{}</attenuation>")), "0",
        "1"},
       {"attenuation/quadratic", pictured(kCube, lamp("point", "<attenuation>{}</attenuation>")),
        "0", "1"},
       {"spot/inner_angle",
        pictured(kCube, lamp("spot",
                             "<spot><outer_angle>1.5</outer_angle><falloff>1</falloff>{}"
                             "</spot>")),
        "0.1", "1.2"},
       {"spot/outer_angle",
        pictured(kCube, lamp("spot",
                             "<spot><inner_angle>0.1</inner_angle><falloff>1</falloff>{}"
                             "</spot>")),
        "0.3", "1.5"},
       {"spot/falloff",
        pictured(kCube, lamp("spot",
                             "<spot><inner_angle>0.1</inner_angle><outer_angle>1.5"
                             "</outer_angle>{}</spot>")),
        "1", "4"}});
}

void add_state(std::vector<Effect>& rows) {
  const std::string ball = in_model("ball", in_link(collision(kCube)), "0 0 0.5 0 0 0");
  const auto of_model = [&](const std::string& inside) {
    return kFloor + ball + "<state world_name='w'><model name='ball'>" + inside +
           "</model></state>";
  };
  rows.insert(rows.end(), {{"state/sim_time", "<state world_name='w'>{}</state>", "1 0", "2 5"},
                           {"state/model/scale", of_model("{}"), "1 1 1", "1 1 0.5"},
                           {"state/model/link/velocity",
                            of_model("<link name='l'><pose>0 0 0.5 0 0 0</pose>{}</link>"),
                            "0 0 0 0 0 0", "1 0 0 0 0 0"}});
}

void add_models(std::vector<Effect>& rows) {
  const std::string above = "0 0 5 0 0 0";
  rows.insert(
      rows.end(),
      {{"model/static", in_model("m", "{}" + in_link("")), "0", "1"},
       {"model/allow_auto_disable",
        physics_block("<max_step_size>0.01</max_step_size>") + kFloor +
            in_model("cube", "{}" + in_link(collision(kCube)), "0 0 0.499 0 0 0"),
        "0", "1"},
       {"joint/gearbox_ratio",
        in_model("gears", in_link("", "post") + in_link("", "a") + in_link("", "b") +
                              "<joint name='to_a' type='revolute'><parent>post</parent><child>a"
                              "</child>" +
                              axis("") +
                              "</joint><joint name='to_b' type='revolute'><parent>post</parent>"
                              "<child>b</child>" +
                              axis("") +
                              "</joint><joint name='gear' type='gearbox'><parent>a</parent><child>"
                              "b</child><gearbox_reference_body>post</gearbox_reference_body>{}" +
                              axis("") + axis("", "0 1 0", "axis2") + "</joint>") +
            "<state world_name='w'><model name='gears'><link name='a'><pose>0 0 0 0 0 0</pose>"
            "<velocity>0 0 0 0 1 0</velocity></link></model></state>",
        "-1", "-2"},
       {"model/self_collide",
        in_model("m", "{}" + in_link(collision(kCube), "a") +
                          in_link("<pose>0.9 0 0 0 0 0</pose>" + collision(kCube), "b")),
        "0", "1"},
       {"link/self_collide",
        in_model("m", in_link("<self_collide>1</self_collide>" + collision(kCube), "a") +
                          in_link("{}<pose>0.9 0 0 0 0 0</pose>" + collision(kCube), "b")),
        "0", "1"},
       {"link/gravity", in_model("m", in_link("{}")), "0", "1"},
       {"link/kinematic", in_model("m", in_link("{}")), "0", "1"},
       {"inertial/mass",
        jointed(axis("<dynamics><damping>3</damping></dynamics>"), "revolute",
                "<inertial>{}</inertial>"),
        "1", "5"},
       {"velocity_decay/linear", in_model("m", in_link("<velocity_decay>{}</velocity_decay>")), "0",
        "0.1"},
       {"velocity_decay/angular",
        jointed(axis(""), "revolute", "<velocity_decay>{}</velocity_decay>"), "0", "0.1"},
       {"visual/cast_shadows",
        pictured(kCube,
                 "<light name='s' type='directional'><cast_shadows>1"
                 "</cast_shadows><direction>0.6 0.5 -1</direction>"
                 "</light>",
                 "{}"),
        "0", "1"},
       {"visual/transparency", pictured(kCube, "<light name='s' type='directional'/>", "{}"), "0",
        "0.7"},
       {"collision/laser_retro",
        lidar(scan(), kRange) + still("wall", in_link(collision(kCube, "{}")), "3 0 1 0 0 0"),
        "100", "200"},
       {"visual/laser_retro",
        lidar(scan(), kRange, "", "", "gpu_ray") +
            still("wall", in_link(visual(kCube, "{}")), "3 0 1 0 0 0"),
        "100", "200"},
       {"collision/max_contacts", thrown("{}"), "10", "1"}});
  for (const char* color : {"ambient", "diffuse", "emissive"}) {
    rows.push_back({std::string("material/") + color,
                    pictured(kCube, lamp("point", ""), "<material>{}</material>"), "0.1 0.1 0.1 1",
                    "0.9 0.9 0.9 1"});
  }
  // The axes are those of a body that is released with a spin about all of them.
  for (const char* moment : {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"}) {
    const bool is_off_diagonal = moment[1] != moment[2];
    rows.push_back(
        {std::string("inertia/") + moment,
         in_model("m", in_link("<inertial><mass>1</mass><inertia>{}</inertia></inertial>")) +
             "<state world_name='w'><model name='m'><link name='l'><pose>0 0 0 0 0 0</pose>"
             "<velocity>0 0 0 9 8 7</velocity></link></model></state>",
         is_off_diagonal ? "0.0" : "1.0", is_off_diagonal ? "0.3" : "1.5"});
  }
}

void add_shapes(std::vector<Effect>& rows) {
  const std::string data = "<uri>file://" + test_data();
  const std::string cube = data + "/meshes/cube.obj</uri>";
  const std::string parts =
      data + "/meshes/parts_z_up.dae</uri><submesh><name>Leaf</name>{}</submesh>";
  const std::string heights = data + "/images/grey8.png</uri>";
  const auto seen = [](const std::string& shape, const std::string& pose = "3 0 1 0.3 0.2 0.4") {
    return lidar(scan(), kRange) + still("thing", in_link(collision(shape)), pose);
  };
  // The camera looks from above.
  const auto ground = [&](const std::string& inside) {
    const std::string shape = "<heightmap>" + heights + inside + "</heightmap>";
    const std::string down = "<pose>0 0 9 0 1.2 0</pose>";
    return lidar(scan(), kRange, "", down) + camera("", down) +
           still("ground", in_link(collision(shape) + visual(shape)));
  };
  const std::string flat = "<size>20 20 0.5</size>";
  const auto texture = [&](const std::string& file, const std::string& more) {
    return "<texture>" + more + "<diffuse>" + data.substr(5) + "/images/" + file +
           "</diffuse><normal>__default__</normal></texture>";
  };
  const auto blended = [&](const std::string& blend) {
    return ground(flat + texture("rgb.png", "<size>5</size>") +
                  texture("grey8.png", "<size>5</size>") + "<blend>" + blend + "</blend>");
  };
  rows.insert(
      rows.end(),
      {{"box/size", seen("<box>{}</box>"), "1 1 1", "2 1 1"},
       {"sphere/radius", seen("<sphere>{}</sphere>"), "1", "0.5"},
       {"cylinder/radius", seen("<cylinder><length>1</length>{}</cylinder>"), "1", "0.5"},
       {"cylinder/length", seen("<cylinder><radius>0.1</radius>{}</cylinder>", "3 0 1 1.5 0 0"),
        "0.2", "4"},
       {"plane/normal", seen("<plane>{}</plane>", "3 0 0 0 0 0"), "0 0 1", "-1 0 0.5"},
       {"plane/size", camera("") + still("p", in_link(visual("<plane>{}</plane>"))), "2 2",
        "30 30"},
       {"mesh/scale", seen("<mesh>" + cube + "{}</mesh>"), "1 1 1", "2 2 2"},
       {"submesh/center",
        lidar(scan(), kRange) +
            still("thing", in_link(collision("<mesh>" + parts + "</mesh>")), "3 -0.5 0.5 0 0 0"),
        "0", "1"},
       {"heightmap/size", ground("{}"), "20 20 0.5", "20 20 5"},
       {"heightmap/pos", ground(flat + "{}"), "0 0 0", "0 0 1"},
       {"heightmap/texture/size", ground(flat + texture("rgb.png", "{}")), "5", "7"},
       {"blend/min_height", blended("<fade_dist>0.1</fade_dist>{}"), "0.1", "0.4"},
       {"blend/fade_dist", blended("<min_height>0.1</min_height>{}"), "0.1", "0.3"}});
}

void add_surfaces(std::vector<Effect>& rows) {
  const auto friction = [](const std::string& more) {
    return thrown("<surface><friction><ode>" + more + "</ode></friction></surface>");
  };
  const auto torsional = [](const std::string& more) {
    return thrown("<surface><friction><torsional>" + more + "</torsional></friction></surface>");
  };
  const auto contact = [](const std::string& more) {
    return thrown("<surface><contact>" + more + "</contact></surface>");
  };
  const auto bounce = [](const std::string& more) {
    return thrown("<surface><bounce>" + more + "</bounce></surface>");
  };
  rows.insert(
      rows.end(),
      {{"bounce/restitution_coefficient", bounce("<threshold>0.1</threshold>{}"), "0", "0.8"},
       {"bounce/threshold", bounce("<restitution_coefficient>0.8</restitution_coefficient>{}"),
        "0.1", "100"},
       {"friction/ode/mu", friction("{}"), "1", "0.1"},
       {"friction/ode/mu2", friction("{}"), "1", "0.1"},
       {"friction/ode/fdir1", friction("<mu>0.1</mu>{}"), "1 0 0", "0 1 0"},
       {"friction/ode/slip1", friction("{}"), "0", "1"},
       {"friction/ode/slip2", friction("{}"), "0", "1"},
       {"surface/contact/collide_bitmask", contact("{}"), "65535", "0"},
       {"surface/contact/category_bitmask", contact("<collide_bitmask>2</collide_bitmask>{}"), "2",
        "1"},
       {"surface/contact/collide_without_contact", contact("{}"), "0", "1"},
       {"contact/ode/kp", contact("<ode>{}</ode>"), "1e12", "1e3"},
       {"contact/ode/kd", contact("<ode><kp>1e4</kp>{}</ode>"), "1", "1000"},
       {"contact/ode/max_vel", contact("<ode>{}</ode>"), "0.01", "0"},
       {"contact/ode/min_depth",
        thrown("<surface><contact><ode>{}</ode></contact></surface>", "0.4995"), "0.001", "0.0001"},
       {"torsional/coefficient", torsional("<patch_radius>0.5</patch_radius>{}"), "1", "0.1"},
       {"torsional/use_patch_radius",
        torsional("<patch_radius>0.5</patch_radius><surface_radius>1</surface_radius>{}"), "1",
        "0"},
       {"torsional/patch_radius", torsional("{}"), "0", "0.5"},
       {"torsional/surface_radius", torsional("<use_patch_radius>0</use_patch_radius>{}"), "0",
        "1"}});
}

void add_joints(std::vector<Effect>& rows) {
  const std::string second = axis("", "0 0 1", "axis2");
  const auto in_axis = [&](const std::string& inside) { return two_axes(axis(inside), second); };
  const std::string turned = "-1 0 0 1.5707963267948966 0 0";
  const auto stopped = [](const std::string& limit) {
    return jointed(axis("<limit><lower>-1</lower><upper>0.01</upper></limit>") +
                   "<physics><ode><limit>" + limit + "</limit></ode></physics>");
  };
  rows.insert(
      rows.end(),
      {{"axis/xyz", jointed("<axis>{}</axis>"), "0 1 0", "0 1 1"},
       {"axis2/xyz", two_axes(axis(""), "<axis2>{}</axis2>"), "0 0 1", "1 0 0"},
       {"axis/use_parent_model_frame", jointed(axis("{}"), "revolute", "", turned), "0", "1"},
       {"axis2/use_parent_model_frame",
        two_axes(axis("", "1 0 0"), axis("{}", "0 0 1", "axis2"), turned), "0", "1"},
       {"dynamics/damping", in_axis("<dynamics>{}</dynamics>"), "0", "5"},
       {"dynamics/friction", in_axis("<dynamics>{}</dynamics>"), "0", "5"},
       {"dynamics/spring_stiffness", in_axis("<dynamics>{}</dynamics>"), "0", "50"},
       {"dynamics/spring_reference",
        in_axis("<dynamics><spring_stiffness>50</spring_stiffness>{}</dynamics>"), "0", "1"},
       {"limit/lower", in_axis("<limit><upper>1</upper>{}</limit>"), "-1", "0.1"},
       {"limit/upper", in_axis("<limit><lower>-1</lower>{}</limit>"), "1", "0.001"},
       {"joint/physics/ode/limit/cfm", stopped("{}"), "0", "1"},
       {"joint/physics/ode/limit/erp", stopped("<cfm>0.1</cfm>{}"), "0.1", "0.9"}});
}

/// Adds rows for poses.
void add_poses(std::vector<Effect>& rows) {
  const char* const here = "3 0 1 0 0 0";
  const char* const there = "4 0 1 0 0 0.3";
  const auto seen = [](const std::string& model) {
    return lidar(scan(), kRange) + "<model name='thing'><static>1</static>" + model + "</model>";
  };
  const auto saved = [&](const std::string& models) {
    return seen(in_link(collision(kCube)) + "<model name='inner'>" + in_link(collision(kCube)) +
                "</model>") +
           lamp("point", "") + camera("") +
           still("ground", in_link(visual("<box><size>20 20 0.1</size></box>"))) +
           "<state world_name='w'>" + models + "</state>";
  };
  rows.insert(
      rows.end(),
      {{"model/pose", seen("{}" + in_link(collision(kCube))), here, there},
       {"link/pose", seen(in_link("{}" + collision(kCube))), here, there},
       {"collision/pose", seen(in_link(collision(kCube, "{}"))), here, there},
       {"visual/pose", camera("") + still("m", in_link(visual(kCube, "{}"))), here, there},
       {"frame/pose",
        seen("<frame name='f'>{}</frame><link name='l'><pose relative_to='f'>0 0 0 0 0 0</pose>" +
             collision(kCube) + "</link>"),
        here, there},
       {"inertial/pose", jointed(axis(""), "revolute", "<inertial>{}</inertial>"), "0 0 0 0 0 0",
        "1 0 0 0 0 0"},
       {"joint/pose",
        in_model("arm", in_link("") +
                            "<joint name='j' type='revolute'>{}<parent>world</parent>"
                            "<child>l</child>" +
                            axis("") + "</joint>"),
        "-1 0 0 0 0 0", "-2 0 0 0 0 0"},
       {"population/pose",
        "<population name='p'>{}" + in_model("m", in_link("")) +
            "<box><size>4 4 0</size></box><distribution><type>linear-x</type></distribution>"
            "</population>",
        here, there},
       {"light/pose",
        camera("") + still("ground", in_link(visual("<box><size>20 20 0.1</size></box>"))) +
            "<light name='lamp' type='point'>{}</light>",
        "2 0 3 0 0 0", "6 0 1 0 0 0"},
       {"sensor/pose",
        lidar(scan(), kRange, "", "{}") + still("m", in_link(collision(kCube)), here),
        "0 0 0 0 0 0", "1 0 0 0 0 0.1"},
       {"sensor/camera/pose", camera("{}") + still("m", in_link(visual(kCube)), here),
        "0 0 0 0 0 0", "1 0 0 0 0 0.1"},
       {"state/model/pose", saved("<model name='thing'>{}</model>"), here, there},
       {"state/model/link/pose", saved("<model name='thing'><link name='l'>{}</link></model>"),
        here, there},
       {"state/model/model/pose",
        saved("<model name='thing'><model name='inner'>{}</model></model>"), here, there},
       {"state/model/model/scale",
        saved("<model name='thing'><model name='inner'><pose>3 0 1 0 0 0</pose>{}</model></model>"),
        "1 1 1", "2 2 2"},
       {"state/light/pose", saved("<light name='lamp'>{}</light>"), "2 0 3 0 0 0", "6 0 1 0 0 0"}});
}

}  // namespace

std::vector<Effect> effects() {
  std::vector<Effect> rows;
  for (const auto add : {add_world, add_population, add_lights, add_state, add_models, add_shapes,
                         add_surfaces, add_joints, add_poses, add_sensor_effects}) {
    add(rows);
  }
  return rows;
}

}  // namespace ardee
