// SPDX-License-Identifier: MIT
// The private extension ardee_sim._core; ardee_sim/*.py is the interface.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <string>

#include "ardee_sim/description/scenery.h"
#include "descriptions.h"
#include "simulation.h"
#include "unlocked.h"

namespace ardee::python {
namespace {

using namespace pybind11::literals;
using Names = std::vector<std::string>;

const char* level_name(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return "debug";
    case LogLevel::kInfo:
      return "info";
    case LogLevel::kWarning:
      return "warning";
    case LogLevel::kError:
      return "error";
  }
  throw std::logic_error("found a level without a name");
}

/// Messages quote files, which may hold bytes that are no UTF-8.
py::object readable(const std::string& text) {
  const auto size = static_cast<Py_ssize_t>(text.size());
  return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(text.data(), size, "replace"));
}

py::list log_of(const std::vector<LogLine>& lines) {
  py::list made;
  for (const LogLine& line : lines) {
    made.append(py::make_tuple(level_name(line.level), readable(line.text)));
  }
  return made;
}

/// x, y, z, w.
Eigen::Quaterniond quaternion(const Eigen::Vector4d& xyzw) {
  return Eigen::Quaterniond(xyzw[3], xyzw[0], xyzw[1], xyzw[2]).normalized();
}

py::tuple tuple_of(const RelativeState& state) {
  const Eigen::Vector4d xyzw = state.pose.q.coeffs();
  return py::make_tuple(state.pose.p, xyzw, state.twist.linear, state.twist.angular);
}

py::dict visuals_of(const Model& model) {
  py::dict names;
  for (std::uint32_t i = 0; i < model.links.size(); ++i) {
    const std::vector<Visual>& visuals = model.links[i].visuals;
    for (std::uint32_t k = 0; k < visuals.size(); ++k) {
      names[py::int_(render::visual_number(i, k))] = visuals[k].name;
    }
  }
  return names;
}

/// Returns a tuple for each piece of static scenery: scoped name, file of the world's model that
/// contains it, position, quaternion, scale, label, number in instance pictures, names of its
/// visuals by their numbers in pictures of visuals.
py::list placements_of(const LoadedWorld& loaded) {
  py::list made;
  std::map<const Model*, py::dict> visuals;  // of many plants of one model
  std::int64_t instance_number = 1;
  // A simulation numbers a world's models in the order of their names.
  std::map<std::string, Instance> models;
  for (const Instance& each : loaded.world()->models) models.emplace(each.name, each);
  for (auto& [_, each] : models) {
    each.is_static |= each.model->is_static || each.model->links.empty();
    const auto placements = each.is_static ? flatten_scenery(each) : std::vector<Placement>();
    const PlacementNames name = placement_names(each);
    for (std::size_t k = 0; k < placements.size(); ++k) {
      const Placement& placed = placements[k];
      const Eigen::Vector4d xyzw = placed.X_WM.q.coeffs();
      const auto [names, is_new] = visuals.try_emplace(placed.model.get());
      if (is_new) names->second = visuals_of(*placed.model);
      made.append(py::make_tuple(name(k), each.model->source.file, placed.X_WM.p, xyzw,
                                 placed.scale, placed.label,
                                 instance_number + static_cast<std::int64_t>(k), names->second));
    }
    instance_number += std::max<std::int64_t>(1, static_cast<std::int64_t>(placements.size()));
  }
  return made;
}

void bind_world(py::module_& module) {
  py::class_<LoadedModel, std::shared_ptr<LoadedModel>>(module, "Model")
      .def_property_readonly("name", [](const LoadedModel& m) { return m.model->name; });
  py::class_<LoadedWorld, std::shared_ptr<LoadedWorld>>(module, "World")
      .def_static(
          "from_file",
          [](const std::string& name, const Names& models, const Names& media,
             const Names& packages) {
            return LoadedWorld::from_file(name, {models, media, packages});
          },
          py::call_guard<Unlocked>())
      .def_static(
          "from_string",
          [](const std::string& text, const std::string& path, const Names& models,
             const Names& media, const Names& packages) {
            return std::make_shared<LoadedWorld>(text, path,
                                                 LoadedWorld::Folders{models, media, packages});
          },
          py::call_guard<Unlocked>())
      .def(
          "load_model",
          [](LoadedWorld& world, const std::string& text, const std::string& name) {
            return std::const_pointer_cast<LoadedModel>(world.load_model(text, name));
          },
          py::call_guard<Unlocked>())
      .def("name", [](const LoadedWorld& w) { return w.world()->name; })
      .def("path", &LoadedWorld::path)
      .def("placements", &placements_of);
}

void raise(const char* name, const Error& error) {
  const py::object type = py::module_::import("ardee_sim.errors").attr(name);
  PyErr_SetObject(type.ptr(), readable(error.what()).ptr());
}

void bind_state(py::class_<BoundSimulation>& bound) {
  bound
      .def("spawn",
           [](BoundSimulation& sim, const std::string& name, std::shared_ptr<LoadedModel> model,
              const Eigen::Vector3d& xyz_m, const Eigen::Vector3d& rpy_rad,
              const std::string& robot_namespace,
              const std::map<std::string, double>& joint_positions, bool is_static, double scale,
              std::uint32_t label) {
             sim.spawn({name, std::move(model), Pose::from_xyz_rpy(xyz_m, rpy_rad), robot_namespace,
                        joint_positions, is_static, scale, label});
           })
      .def("remove", &BoundSimulation::remove)
      .def("state",
           [](BoundSimulation& sim, const std::string& name, const std::string& reference) {
             return tuple_of(sim.state(name, reference));
           })
      .def("set_state",
           [](BoundSimulation& sim, const std::string& name, const Eigen::Vector3d& xyz_m,
              const Eigen::Vector4d& quat_xyzw, const Eigen::Vector3d& v_m_s,
              const Eigen::Vector3d& w_rad_s, const std::string& reference) {
             sim.set_state(name, {{xyz_m, quaternion(quat_xyzw)}, {v_m_s, w_rad_s}}, reference);
           })
      .def("snapshot", &BoundSimulation::snapshot)
      .def("restore", &BoundSimulation::restore);
}

/// Place, rotation, width, height, horizontal field of view, near_m; velocities, times of exposure
/// and readout.
using GivenCamera = std::tuple<Eigen::Vector3d, Eigen::Vector4d, int, int, double, double,
                               Eigen::Vector3d, Eigen::Vector3d, double, double>;

render::Camera camera_of(const GivenCamera& given) {
  render::Camera camera;
  Eigen::Vector4d quat_xyzw;
  Twist& twist_W = camera.motion.twist_W;
  std::tie(camera.X_WC.p, quat_xyzw, camera.width, camera.height, camera.horizontal_fov_rad,
           camera.near_m, twist_W.linear, twist_W.angular, camera.motion.exposure_time_s,
           camera.motion.readout_time_s) = given;
  camera.X_WC.q = quaternion(quat_xyzw);
  return camera;
}

void bind_readings(py::class_<BoundSimulation>& bound) {
  bound.def("demand", &BoundSimulation::demand)
      .def("undemand", &BoundSimulation::undemand)
      .def("demands", &BoundSimulation::demands)
      .def("latest", &BoundSimulation::latest)
      .def("drain", &BoundSimulation::drain)
      .def("dropped", &BoundSimulation::dropped)
      .def("want_contacts", &BoundSimulation::want_contacts)
      .def("contacts", &BoundSimulation::contacts)
      .def("take_touches", &BoundSimulation::take_touches)
      .def("picture",
           [](BoundSimulation& sim, const GivenCamera& given, std::optional<float> exposure,
              const std::string& white_balance, bool light, bool depth, bool ids, bool visuals) {
             render::ImageFormation development;
             development.exposure = exposure;
             const auto balance = render::parse_white_balance(white_balance);
             if (!balance) {
               throw Error("white_balance: found '" + white_balance + "', " +
                           render::kWhiteBalanceForms);
             }
             development.white_balance = *balance;
             return sim.picture(camera_of(given), {light, depth, ids, visuals}, development);
           })
      .def("lone_pixels", [](BoundSimulation& sim, const GivenCamera& given,
                             const std::vector<std::int32_t>& instances) {
        return sim.lone_pixels(camera_of(given), instances);
      });
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  py::register_exception_translator([](std::exception_ptr problem) {
    try {
      std::rethrow_exception(problem);
    } catch (const PhysicsFault& each) {
      raise("PhysicsError", each);
    } catch (const Error& each) {
      raise("ArdeeError", each);
    }
  });
  bind_description(module);
  bind_world(module);
  py::class_<BoundSimulation> bound(module, "Simulation");
  bound
      .def(py::init<std::shared_ptr<LoadedWorld>, std::uint64_t, int>(), "world"_a, "seed"_a,
           "ray_threads"_a)
      .def("close", &BoundSimulation::close)
      .def("step", &BoundSimulation::step)
      .def("reset", &BoundSimulation::reset)
      .def("set_noise_seed", &BoundSimulation::set_noise_seed)
      .def("set_daylight", &BoundSimulation::set_daylight)
      .def("command", &BoundSimulation::command)
      .def("call", &BoundSimulation::call)
      .def("set_parameters", &BoundSimulation::set_parameters)
      .def("start_controllers", &BoundSimulation::start_controllers)
      .def("stop_controllers", &BoundSimulation::stop_controllers)
      .def("controllers", &BoundSimulation::controllers)
      .def("entities", &BoundSimulation::entities)
      .def("description", &BoundSimulation::description)
      .def("scenery", &BoundSimulation::scenery)
      .def("topics", &BoundSimulation::topics)
      .def("take_log", [](BoundSimulation& sim) { return log_of(sim.take_log()); })
      .def("time_ns", &BoundSimulation::time_ns)
      .def("step_count", &BoundSimulation::step_count)
      .def("step_ns", &BoundSimulation::step_ns)
      .def("gravity_m_s2", &BoundSimulation::gravity_m_s2);
  bind_state(bound);
  bind_readings(bound);
  py::module_::import("atexit").attr("register")(py::cpp_function(&Unlocked::end));
}

}  // namespace ardee::python
