// SPDX-License-Identifier: MIT
#include <tinyxml2.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "ardee_sim/simulation/simulation.h"
#include "fuzz/inputs.h"
#include "fuzz/targets.h"

namespace ardee::fuzz {
namespace {

constexpr int kSteps = 5;

/// World with ground and light, for a model without a world. Five steps last as long as the period
/// of most sensors.
constexpr const char* kPlainWorld =
    "<sdf version='1.6'><world name='plain'><physics type='ode'><max_step_size>0.02"
    "</max_step_size></physics><light name='sun' type='directional'><cast_shadows>1</cast_shadows>"
    "</light><model name='ground'><static>1</static><link name='l'><collision name='c'><geometry>"
    "<plane/></geometry></collision><visual name='v'><geometry><plane/></geometry></visual></link>"
    "</model></world></sdf>";

/// Upper limits of pictures, scans and populations, which change the cost but not the code that
/// runs.
struct Cut {
  const char* element;
  double most;
};
constexpr std::array<Cut, 5> kCuts{
    {{"width", 16}, {"height", 12}, {"samples", 16}, {"resolution", 2}, {"model_count", 5}}};

/// Returns an element's text as the readers take it: all text directly inside.
std::string text_of(const tinyxml2::XMLElement& element) {
  std::string text;
  for (const auto* child = element.FirstChild(); child; child = child->NextSibling()) {
    if (const auto* part = child->ToText()) text += part->Value();
  }
  return text;
}

/// Gives a size to an element without one: the default of a camera is large, that of a lidar 640
/// beams a row.
void give_size(tinyxml2::XMLElement& parent, const char* size) {
  if (!parent.FirstChildElement(size)) parent.InsertNewChildElement(size)->SetText(8);
}

void give_sizes(tinyxml2::XMLElement& element) {
  if (std::strcmp(element.Name(), "horizontal") == 0) give_size(element, "samples");
  if (std::strcmp(element.Name(), "camera") != 0) return;
  tinyxml2::XMLElement* image = element.FirstChildElement("image");
  if (!image) image = element.InsertNewChildElement("image");
  for (const char* size : {"width", "height"}) give_size(*image, size);
}

void cut_sizes(tinyxml2::XMLElement& element) {
  give_sizes(element);
  for (const Cut& cut : kCuts) {
    if (std::strcmp(element.Name(), cut.element) != 0) continue;
    if (std::atof(text_of(element).c_str()) <= cut.most) continue;
    element.DeleteChildren();
    element.SetText(cut.most);
  }
  for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
    cut_sizes(*child);
  }
}

/// Returns the text with large sizes reduced; unchanged if it is not XML.
std::string with_small_sizes(const std::string& text) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) return text;
  tinyxml2::XMLElement* root = document.RootElement();
  if (!root) return text;
  cut_sizes(*root);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

/// Sink that listens to everything and keeps nothing.
class Listener : public devices::ReadingSink {
 public:
  void on_reading(const devices::Output&, const devices::Reading&) override { ++count; }
  std::size_t count = 0;
};

/// Returns the poses of all links after some steps.
std::vector<Pose> run(Simulation& simulation) {
  for (int i = 0; i < kSteps; ++i) simulation.step();
  std::vector<Pose> poses;
  for (const auto& entity : simulation.entities()) {
    for (std::size_t link = 0; link < entity->robot->model().links.size(); ++link) {
      poses.push_back(entity->robot->link_pose(link));
      if (!poses.back().p.allFinite() || !poses.back().q.coeffs().allFinite()) {
        throw std::logic_error("a link of " + entity->name() + " is nowhere");
      }
    }
  }
  return poses;
}

void command(devices::Device& device) {
  for (const devices::Input& input : device.ports().all<devices::Input>()) {
    if (input.kind == devices::command_kind<Twist>()) {
      input.on_command(Twist{{0.5, 0.0, 0.0}, {0.0, 0.0, 0.3}});
    }
    if (input.kind == devices::command_kind<double>()) input.on_command(input.high);
    if (input.kind == devices::command_kind<physics::ForceTorque>()) {
      input.on_command(physics::ForceTorque{{1, 2, 3}, {4, 5, 6}});
    }
    if (input.kind == devices::command_kind<devices::Trigger>())
      input.on_command(devices::Trigger{});
  }
  for (const devices::ParameterGroup& tuning : device.ports().all<devices::ParameterGroup>()) {
    for (const devices::TunableParameter& tunable : tuning.parameters) tunable.set(tunable.high);
  }
}

/// Sets each property to its present value: no setter may refuse what its getter returns.
void set_again(physics::PhysicsModel& model, const Model& description) {
  for (std::size_t link = 0; link < description.links.size(); ++link) {
    model.set_link_properties(link, model.link_properties(link));
  }
  for (std::size_t joint = 0; joint < description.joints.size(); ++joint) {
    for (std::size_t axis = 0; axis < model.joint_axes(joint); ++axis) {
      model.set_joint_properties(joint, axis, model.joint_properties(joint, axis));
      model.set_joint_motor(joint, axis, model.joint_motor(joint, axis));
    }
  }
}

void check_same(const std::vector<Pose>& found, const std::vector<Pose>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (found.size() != expected.size() || found[i].p != expected[i].p ||
        found[i].q.coeffs() != expected[i].q.coeffs()) {
      throw std::logic_error("reset_simulation did not give what construction gave");
    }
  }
}

void exercise(Simulation& simulation) {
  Listener listener;
  simulation.set_sink(&listener);
  const std::vector<Pose> first = run(simulation);
  for (const auto& entity : simulation.entities()) {
    for (const auto& device : entity->devices) command(*device);
    if (entity->robot->is_dynamic()) {
      set_again(entity->robot->dynamics(), entity->robot->model());
      simulation.wrenches().add({entity->robot.get(), 0, {10, 0, 0}, {0, 0, 1}, {0, 0, 0}, 0, -1});
    }
  }
  run(simulation);
  for (const Light& light : std::vector<Light>(simulation.lights())) simulation.set_light(light);
  simulation.reset_world();
  run(simulation);
  simulation.reset_simulation();
  check_same(run(simulation), first);
  while (!simulation.entities().empty()) simulation.remove(simulation.entities().back()->name());
  run(simulation);
}

}  // namespace

void simulate(const std::string& input) {
  const std::string text = with_small_sizes(input);
  Loader loader = make_loader();
  std::shared_ptr<const Model> model;
  std::optional<World> world;
  try {
    world = loader.load_world_text(text, "fuzz.world");
  } catch (const Error&) {
    model = loader.load_model_text(text, "fuzz.xml");
  }
  if (world) {
    try {
      model = loader.load_model_text(text, "fuzz.xml");
    } catch (const Error&) {
      // The world runs without the other model.
    }
  }
  if (!world) world = loader.load_world_text(kPlainWorld, "plain.world");
  SimulationOptions options;
  options.rays.threads = 1;
  Simulation simulation(*world, options, [](LogLevel, const std::string&) {});
  if (model) {
    SpawnRequest request;
    request.name = "spawned by the fuzzer";
    request.model = model;
    request.X_WM.p.z() = 0.2;
    simulation.spawn(request);
  }
  try {
    exercise(simulation);
  } catch (const Error& error) {
    throw std::logic_error(std::string("refused when it ran already: ") + error.what());
  }
}

}  // namespace ardee::fuzz
