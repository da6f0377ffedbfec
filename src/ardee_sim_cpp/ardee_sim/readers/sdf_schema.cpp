// SPDX-License-Identifier: MIT Treatment of each element and attribute of SDF 1.2 to 1.12.
// docs/support.md is made from this.
#include "ardee_sim/readers/schema.h"

namespace ardee {
namespace {

using namespace treatments;

constexpr char kFrames[] = "frames are known in worlds and models alone";
constexpr char kOneEngine[] = "ode is the one engine";
constexpr char kFeedback[] =
    "on a fixed joint: its links stay two bodies, between which a sensor measures";
constexpr char kNoHighlights[] = "surfaces are matt, without highlights";
constexpr char kNoWindow[] = "the simulator has no window; rviz is the view";

const std::vector<SchemaRow>& world_rows() {
  static const std::vector<SchemaRow> rows{
      {"sdf", acts, "@version world model light include"},
      {"sdf", no_effect, "actor", "there are no actors"},
      {"gazebo", acts, "@version world model light include", "the root of SDF 1.2"},
      {"gazebo", no_effect, "actor", "there are no actors"},
      {"world", acts,
       "@name include gravity physics scene gui light frame model plugin spherical_coordinates "
       "state population wind atmosphere"},
      {"world", no_effect, "audio", "there is no sound"},
      {"world", no_effect, "magnetic_field",
       "the magnetometer's plugin says what field it measures",
       "5.5645e-6 22.8758e-6 -42.3884e-6|6e-06 2.3e-05 -4.2e-05|5.5645e-06 2.28758e-05 "
       "-4.23884e-05"},
      {"world", no_effect, "actor road", "not supported in a world, left out"},
      {"world", no_effect, "joint", "not supported in a world, left out; a model may hold it"},
      {"wind", no_effect, "linear_velocity", "no wind blows", "0 0 0"},
      {"atmosphere", no_effect, "@type", "there is no air", "adiabatic"},
      {"atmosphere", no_effect, "temperature", "there is no air", "288.15"},
      {"atmosphere", no_effect, "temperature_gradient", "there is no air", "-0.0065"},
      {"atmosphere", no_effect, "pressure", "there is no air", "101325"},
      {"include", acts, "uri pose name static plugin ardee:scale ardee:label"},
      {"include", acts, "@merge placement_frame"},
      {"population", acts, "@name model pose box cylinder model_count distribution"},
      {"population", no_effect, "frame", kFrames},
      {"distribution", acts, "type rows cols step"},
      {"pose", acts, "@relative_to @degrees @rotation_format"},
      {"pose", no_effect, "@frame", "SDF 1.7's relative_to says what a pose is relative to"},
      {"frame", acts, "@name @attached_to pose"},
      {"plugin", elsewhere, "@name @filename", "see the plugins"},

      {"physics", acts,
       "@default max_step_size real_time_update_rate update_rate max_contacts gravity ode"},
      {"physics", acts, "@type", "another than ode is a warning, and ode is used"},
      {"physics", acts, "real_time_factor", "where the update rate is 0 or absent"},
      {"physics", settled, "@name", "a name for people"},
      {"physics", no_effect, "magnetic_field", "as that of the world"},
      {"physics", no_effect, "bullet simbody dart", kOneEngine},
      {"physics/ode", acts, "solver constraints"},
      {"solver", acts, "type", "quick or world, others are refused"},
      {"solver", acts, "dt", "SDF 1.2's <max_step_size>"},
      {"solver", acts, "iters sor"},
      {"solver", no_effect, "min_step_size", "all steps are equally long", "0.0001"},
      {"solver", no_effect, "precon_iters", "there is no preconditioner", "0"},
      {"solver", no_effect, "use_dynamic_moi_rescaling", "inertias are as written", "0"},
      {"solver", no_effect, "friction_model",
       "a surface's <frictionCone> says what its friction is", "pyramid_model|cone_model"},
      {"solver", no_effect, "island_threads", "one thread solves, whatever their number", "0"},
      {"solver", no_effect, "thread_position_correction", "one thread solves", "0"},
      {"constraints", acts, "cfm erp contact_max_correcting_vel contact_surface_layer"},

      {"scene", acts, "ambient background shadows sky"},
      {"scene", no_effect, "fog", "there is no fog"},
      {"scene", settled, "grid origin_visual", kNoWindow},
      {"sky", no_effect, "time", "the sky is that of noon", "10"},
      {"sky", no_effect, "sunrise", "the sky is that of noon", "6"},
      {"sky", no_effect, "sunset", "the sky is that of noon", "20"},
      {"sky", no_effect, "clouds cubemap_uri", "the sky is clear"},
      {"gui", acts, "camera"},
      {"gui", no_effect, "@fullscreen", kNoWindow, "false"},
      {"gui", no_effect, "plugin", kNoWindow},
      {"gui/camera", acts, "pose", "from where render_world looks, unless it is told"},
      {"gui/camera", settled, "@name", "a name for people"},
      {"gui/camera", no_effect, "view_controller", kNoWindow, "orbit"},
      {"gui/camera", no_effect, "projection_type", kNoWindow, "perspective"},
      {"gui/camera", no_effect, "track_visual", kNoWindow},
      {"gui/camera", no_effect, "frame", kFrames},
      {"light", acts, "@name @type cast_shadows diffuse attenuation direction spot pose",
       "a type other than directional, point and spot is refused"},
      {"light", no_effect, "specular", kNoHighlights, "0.1 0.1 0.1 1|0 0 0 1"},
      {"light", no_effect, "intensity", "<diffuse> says how bright it is", "1"},
      {"light", no_effect, "visualize", kNoWindow, "true|false"},
      {"light", no_effect, "light_on", "a light shines", "true"},
      {"light", no_effect, "frame", kFrames},
      {"attenuation", acts, "range linear constant quadratic"},
      {"spot", acts, "inner_angle outer_angle falloff"},
      {"spherical_coordinates", acts, "latitude_deg longitude_deg elevation heading_deg"},
      {"spherical_coordinates", no_effect, "surface_model", "the Earth is WGS-84's", "EARTH_WGS84"},
      {"spherical_coordinates", no_effect, "world_frame_orientation",
       "the world's axes are east, north and up at a heading of 0", "ENU"},
      {"spherical_coordinates", no_effect, "surface_axis_equatorial surface_axis_polar",
       "the Earth is WGS-84's", "0"},

      {"state", acts, "model light insertions deletions sim_time"},
      {"state", settled, "@world_name iterations wall_time real_time",
       "says nothing of where the world stands"},
      {"state", no_effect, "time", "SDF 1.3's <sim_time> sets the clock"},
      {"insertions", acts, "model light"},
      {"deletions", acts, "name"},
      {"state/model", acts, "@name pose scale link model"},
      {"state/model", settled, "joint", "joints stand as the links do, as in Gazebo"},
      {"state/model", no_effect, "frame", kFrames},
      {"state/model/model", acts, "@name pose scale link model"},
      {"state/model/model", settled, "joint", "joints stand as the links do, as in Gazebo"},
      {"state/model/model", no_effect, "frame", kFrames},
      {"state/model/link", acts, "@name pose velocity"},
      {"state/model/link", settled, "acceleration wrench collision",
       "follows from where the links are and what acts on them"},
      {"state/model/link", no_effect, "frame", kFrames},
      {"state/light", acts, "@name pose"},
      {"state/light", no_effect, "frame", kFrames},
  };
  return rows;
}

const std::vector<SchemaRow>& model_rows() {
  static const std::vector<SchemaRow> rows{
      {"model", acts,
       "@name @canonical_link @placement_frame static self_collide allow_auto_disable include "
       "model "
       "link joint plugin pose frame ardee:instances"},
      {"model", no_effect, "enable_wind", "no wind blows", "false"},
      {"model", no_effect, "gripper", "not supported, left out"},
      {"link", acts,
       "@name gravity self_collide kinematic velocity_decay inertial collision visual sensor pose"},
      {"link", no_effect, "enable_wind", "no wind blows", "false"},
      {"link", no_effect, "must_be_base_link", "joints say what is held", "false"},
      {"link", no_effect, "projector audio_sink audio_source battery light particle_emitter",
       "not supported in a link, left out"},
      {"link", no_effect, "frame", kFrames},
      {"velocity_decay", acts, "linear angular"},
      {"inertial", acts, "mass pose inertia"},
      {"inertial", no_effect, "@auto", "<mass> and <inertia> count", "false"},
      {"inertial", no_effect, "density fluid_added_mass auto_inertia_params",
       "<mass> and <inertia> count"},
      {"inertial", no_effect, "frame", kFrames},
      {"inertia", acts, "ixx ixy ixz iyy iyz izz"},
      {"collision", acts, "@name laser_retro max_contacts surface geometry pose"},
      {"collision", no_effect, "density auto_inertia_params", "<inertial> counts"},
      {"collision", no_effect, "frame", kFrames},
      {"visual", acts, "@name cast_shadows laser_retro transparency material geometry pose meta"},
      {"visual", no_effect, "visibility_flags", "all cameras see all", "4294967295"},
      {"visual", no_effect, "plugin", "visuals have no plugins"},
      {"visual", no_effect, "frame", kFrames},
      {"meta", no_effect, "layer", kNoWindow, "0"},
      {"material", acts, "script ambient diffuse emissive shader"},
      {"material", no_effect, "specular", kNoHighlights, "0 0 0 1|0 0 0"},
      {"material", no_effect, "lighting", "light falls on all", "true"},
      {"material", no_effect, "double_sided",
       "a material script's cull_hardware, or a DAE's, says that", "false"},
      {"material", no_effect, "render_order", "what is nearer is in front", "0"},
      {"material", no_effect, "shininess", kNoHighlights, "0"},
      {"material", no_effect, "pbr", "<diffuse> and textures say how it looks"},
      {"script", acts, "uri name"},
      {"shader", no_effect, "@type", "there are no shaders to choose from", "pixel|vertex"},
      {"shader", no_effect, "normal_map", "there are no normal maps", "__default__"},
      {"geometry", acts, "empty box sphere cylinder plane mesh heightmap"},
      {"geometry", no_effect, "image polyline capsule ellipsoid cone",
       "shape not supported, left out; supported are box, sphere, cylinder, plane, mesh, "
       "heightmap"},
      {"box", acts, "size"},
      {"sphere", acts, "radius"},
      {"cylinder", acts, "radius length"},
      {"plane", acts, "normal size"},
      {"mesh", acts, "uri submesh scale"},
      {"mesh", acts, "filename", "SDF 1.2's <uri>"},
      {"mesh", no_effect, "@optimization convex_decomposition", "all triangles count"},
      {"submesh", acts, "name center"},
      {"heightmap", acts, "uri size pos texture blend"},
      {"heightmap", no_effect, "use_terrain_paging", "all of the ground is there", "false"},
      {"heightmap", settled, "sampling", "the ground is flat between two heights at any number"},
      {"heightmap/texture", acts, "size diffuse"},
      {"heightmap/texture", no_effect, "normal", "there are no normal maps",
       "__default__|file://media/materials/textures/flat_normal.png"},
      {"blend", acts, "min_height fade_dist"},

      {"surface", acts, "bounce friction contact"},
      {"surface", no_effect, "soft_contact", kOneEngine},
      {"bounce", acts, "restitution_coefficient threshold"},
      {"friction", acts, "ode torsional"},
      {"friction", no_effect, "bullet", kOneEngine},
      {"friction/ode", acts, "mu mu2 fdir1 slip1 slip2"},
      {"fdir1", no_effect, "@expressed_in", "<fdir1> is in the collision's frame"},
      {"torsional", acts, "coefficient use_patch_radius patch_radius surface_radius ode"},
      {"torsional/ode", no_effect, "slip", "turning on the spot has no slip", "0"},
      {"surface/contact", acts, "ode collide_bitmask category_bitmask collide_without_contact"},
      {"surface/contact", no_effect, "collide_without_contact_bitmask",
       "<collide_bitmask> says what meets what", "1"},
      {"surface/contact", no_effect, "poissons_ratio", "<kp> and <kd> say how soft it is", "0.3"},
      {"surface/contact", no_effect, "elastic_modulus", "<kp> and <kd> say how soft it is", "-1"},
      {"surface/contact", no_effect, "bullet", kOneEngine},
      {"contact/ode", acts, "kp kd max_vel min_depth"},
      {"contact/ode", no_effect, "soft_cfm", "<kp> and <kd> say how soft it is", "0"},
      {"contact/ode", no_effect, "soft_erp", "<kp> and <kd> say how soft it is", "0.2"},

      {"joint", acts, "@name @type parent child axis axis2 physics pose"},
      {"joint", acts, "gearbox_ratio gearbox_reference_body", "of gearboxes"},
      {"joint", settled, "thread_pitch screw_thread_pitch", "screw joints are refused"},
      {"joint", no_effect, "sensor", "not supported in a joint, left out"},
      {"joint", no_effect, "frame", kFrames},
      {"axis", acts, "xyz use_parent_model_frame dynamics limit"},
      {"axis", no_effect, "initial_position", "a joint starts as the links stand", "0"},
      {"axis", no_effect, "mimic", "joints move on their own"},
      {"axis2", acts, "xyz use_parent_model_frame dynamics limit"},
      {"axis2", no_effect, "initial_position", "a joint starts as the links stand", "0"},
      {"axis2", no_effect, "mimic", "joints move on their own"},
      {"xyz", acts, "@expressed_in"},
      {"dynamics", acts, "damping friction spring_reference spring_stiffness"},
      {"limit", acts, "lower upper effort velocity"},
      {"limit", no_effect, "stiffness", "<physics><ode><limit> says how hard a stop is", "1e8"},
      {"limit", no_effect, "dissipation", "<physics><ode><limit> says how hard a stop is", "1"},
      {"joint/physics", acts, "ode"},
      {"joint/physics", acts, "provide_feedback", kFeedback},
      {"joint/physics", no_effect, "simbody", kOneEngine},
      {"joint/physics/ode", acts, "limit"},
      {"joint/physics/ode", acts, "provide_feedback", kFeedback},
      {"joint/physics/ode", settled, "implicit_spring_damper cfm_damping",
       "springs and dampers are implicit"},
      {"joint/physics/ode", no_effect, "fudge_factor", "motors are exact at the stops", "0"},
      {"joint/physics/ode", no_effect, "cfm erp", "the world's <constraints> count", "0|0.2"},
      {"joint/physics/ode", no_effect, "bounce", "stops do not bounce", "0"},
      {"joint/physics/ode", no_effect, "max_force velocity",
       "<limit> and the plugins say what drives a joint", "0"},
      {"joint/physics/ode", no_effect, "suspension", "<limit> of <physics><ode> counts"},
      {"joint/physics/ode/limit", acts, "cfm erp"},
  };
  return rows;
}

const std::vector<SchemaRow>& sensor_rows() {
  static const std::vector<SchemaRow> rows{
      {"sensor", acts, "@name @type update_rate pose ray lidar camera imu contact plugin"},
      {"sensor", acts, "topic", "where it has no plugin; else the plugin says what the topic is"},
      {"sensor", acts, "gz_frame_id ignition_frame_id frame_id navsat magnetometer",
       "where it has no plugin"},
      {"sensor", settled, "always_on", "a sensor measures whenever somebody listens"},
      {"sensor", no_effect, "visualize", kNoWindow, "false"},
      {"sensor", no_effect, "enable_metrics", "metrics are those of all sensors", "false"},
      {"sensor", no_effect,
       "force_torque altimeter air_pressure air_speed gps logical_camera rfid rfidtag sonar "
       "transceiver",
       "no plugin reads it"},
      {"sensor", no_effect, "frame", kFrames},
      {"sensor/contact", acts, "collision"},
      {"sensor/contact", acts, "topic", "where the sensor has no plugin"},
      {"ray", acts, "scan range noise"},
      {"ray", no_effect, "visibility_mask", "rays meet all", "4294967295"},
      {"lidar", acts, "scan range noise"},
      {"lidar", no_effect, "visibility_mask", "rays meet all", "4294967295"},
      {"scan", acts, "horizontal vertical"},
      {"horizontal", acts, "samples resolution min_angle max_angle"},
      {"vertical", acts, "samples resolution min_angle max_angle"},
      {"ray/range", acts, "min max"},
      {"ray/range", settled, "resolution", "Gazebo does not round ranges either"},
      {"lidar/range", acts, "min max"},
      {"lidar/range", settled, "resolution", "Gazebo does not round ranges either"},
      {"noise", acts, "@type type mean stddev precision"},
      {"noise", settled, "bias_mean bias_stddev", "Gazebo does nothing with it there either"},
      {"noise", no_effect, "dynamic_bias_stddev dynamic_bias_correlation_time",
       "the noise of rays and pictures does not drift", "0"},
      {"sensor/camera", acts, "@name horizontal_fov image clip noise distortion lens pose"},
      {"sensor/camera", no_effect, "save", "pictures are published, not kept"},
      {"sensor/camera", settled, "depth_camera", "the plugin says what is measured"},
      {"sensor/camera", no_effect, "visibility_mask", "all cameras see all", "4294967295"},
      {"sensor/camera", no_effect, "box_type segmentation_type",
       "the plugin says what is measured"},
      {"sensor/camera", acts, "trigger_topic triggered camera_info_topic optical_frame_id",
       "where the sensor has no plugin"},
      {"sensor/camera", no_effect, "frame", kFrames},
      {"sensor/camera/pose", no_effect, "@relative_to @frame", "it is relative to the sensor"},
      {"sensor/camera/pose", no_effect, "@degrees", "rotations are in radians", "false"},
      {"sensor/camera/pose", no_effect, "@rotation_format", "rotations are roll, pitch, yaw",
       "euler_rpy"},
      {"camera/image", acts, "width height format"},
      {"camera/image", settled, "anti_aliasing", "edges are smooth at any number"},
      {"clip", acts, "near far"},
      {"distortion", acts, "k1 k2 k3 p1 p2"},
      {"distortion", acts, "center", "another than 0.5 0.5 is refused"},
      {"lens", acts, "intrinsics"},
      {"lens", acts, "type", "another than gnomonical is a warning, and a pinhole is used"},
      {"lens", no_effect, "custom_function projection", "the picture is a pinhole's"},
      {"lens", settled, "scale_to_hfov cutoff_angle env_texture_size", "of wide angles only"},
      {"intrinsics", acts, "fx fy cx cy s"},
      {"imu", acts, "angular_velocity linear_acceleration"},
      {"imu", acts, "noise", "of SDF 1.4"},
      {"imu", no_effect, "topic", "the <sensor> or its plugin says what the topic is",
       "__default_topic__|__default__"},
      {"imu", no_effect, "orientation_reference_frame",
       "orientation is the world's; the plugin may begin at none"},
      {"imu", no_effect, "enable_orientation", "the message holds it", "true"},
      {"navsat", acts, "position_sensing velocity_sensing"},
      {"position_sensing", acts, "horizontal vertical"},
      {"position_sensing/horizontal", acts, "noise"},
      {"position_sensing/vertical", acts, "noise"},
      {"velocity_sensing", acts, "horizontal vertical"},
      {"velocity_sensing/horizontal", acts, "noise"},
      {"velocity_sensing/vertical", acts, "noise"},
      {"magnetometer", acts, "x y z"},
      {"magnetometer/x", acts, "noise"},
      {"magnetometer/y", acts, "noise"},
      {"magnetometer/z", acts, "noise"},
      {"angular_velocity", acts, "x y z"},
      {"linear_acceleration", acts, "x y z"},
      {"x", acts, "noise"},
      {"y", acts, "noise"},
      {"z", acts, "noise"},
      {"imu/noise", acts, "rate accel"},
      {"imu/noise", settled, "type", "gaussian"},
  };
  return rows;
}

/// The <noise> of one axis, of which the plugin reads all or only the deviation.
std::vector<SchemaRow> noise_rows() {
  std::vector<SchemaRow> rows;
  for (const char* place : {"x/noise", "y/noise", "z/noise", "imu/noise/rate", "imu/noise/accel"}) {
    rows.push_back({place, acts,
                    "@type type mean stddev bias_mean bias_stddev dynamic_bias_stddev "
                    "dynamic_bias_correlation_time precision"});
  }
  for (const char* place : {"magnetometer/x/noise", "magnetometer/y/noise", "magnetometer/z/noise",
                            "horizontal/noise", "vertical/noise"}) {
    rows.push_back({place, acts, "@type type stddev"});
    rows.push_back({place, no_effect,
                    "mean bias_mean bias_stddev dynamic_bias_stddev dynamic_bias_correlation_time "
                    "precision",
                    "<stddev> alone counts", "0"});
  }
  return rows;
}

std::vector<SchemaRow> all_rows() {
  std::vector<SchemaRow> rows;
  for (const auto& part : {world_rows(), model_rows(), sensor_rows(), noise_rows()}) {
    rows.insert(rows.end(), part.begin(), part.end());
  }
  return rows;
}

}  // namespace

const Schema& sdf_schema() {
  static const Schema schema("SDF", all_rows());
  return schema;
}

}  // namespace ardee
