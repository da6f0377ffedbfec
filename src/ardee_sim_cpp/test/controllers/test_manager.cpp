// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ardee_sim/controllers/manager.h"
#include "ardee_sim/core/error.h"

namespace ardee::control {
using namespace devices;
namespace {

class NoSink : public ReadingSink {
 public:
  void on_reading(const Output&, const Reading&) override {}
};

/// Claims the joints of its parameter `joints` and records the calls that it gets.
class Noting : public Controller {
 public:
  Noting(const ControllerContext& context, std::vector<std::string>& notes)
      : name_(context.name), notes_(notes) {
    for (const std::string& joint : context.settings.texts("joints")) {
      claim(context, joint, JointInterface::kVelocity, context.settings.at("joints"));
    }
  }
  void start(TimeNs now_ns) override { note("start", now_ns); }
  void update(TimeNs now_ns, double period_s, ReadingSink&) override {
    note("update", now_ns + static_cast<TimeNs>(period_s));
  }
  void stop(TimeNs now_ns) override { note("stop", now_ns); }
  void reset(TimeNs now_ns) override { note("reset", now_ns); }

 private:
  void note(const std::string& what, TimeNs now_ns) {
    notes_.push_back(name_ + " " + what + " " + std::to_string(now_ns));
  }
  std::string name_;
  std::vector<std::string>& notes_;
};

using Notes = std::vector<std::string>;
using Names = std::vector<std::string>;

class ManagerTest : public ::testing::Test {
 protected:
  ManagerTest() {
    for (const char* name : {"left", "right", "arm"}) {
      hardware_[name].name = name;
      hardware_[name].interface = JointInterface::kVelocity;
    }
    add("base", {"left", "right"});
    add("left_only", {"left"});
    add("arm", {"arm"});
    add("state", {});
    add("strange", {"knee"});
    parameters_["/robot/odd"] = {"/robot/odd", Setting::Map{{"type", text("x/Y")}}};
  }

  static Setting text(const std::string& value) { return {"", value}; }
  void add(const std::string& name, const Names& joints) {
    Setting::List list;
    for (const std::string& joint : joints) list.push_back(text(joint));
    const std::string path = "/robot/" + name;
    parameters_[path] = {
        path, Setting::Map{{"type", text("test/Noting")}, {"joints", {path + "/joints", list}}}};
  }
  Setting parameter(const std::string& name) const {
    const auto found = parameters_.find(name);
    return found == parameters_.end() ? no_parameter(name) : found->second;
  }

  /// Returns the message of the exception that an action throws; empty for none.
  template <typename Action>
  static std::string error_of(Action action) {
    try {
      action();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::string switched(const Names& start, const Names& stop,
                       Strictness strictness = Strictness::kStrict) {
    return error_of([&] { manager_.switch_controllers({start, stop, strictness}); });
  }
  std::string running() const {
    std::string names;
    for (const ControllerState& each : manager_.list()) {
      if (each.state == "running") names += (names.empty() ? "" : " ") + each.name;
    }
    return names;
  }
  void load(const Names& names) {
    for (const std::string& name : names) manager_.load(name);
  }

  Notes notes_;
  NoSink nobody_;
  Model model_;
  Hardware hardware_;
  SensorHandles sensors_;
  Log log_{[](LogLevel, const std::string&) {}};
  std::map<std::string, Setting> parameters_;
  ControllerTypes types_{{"test/Noting", [this](const ControllerContext& context) {
                            return std::make_unique<Noting>(context, notes_);
                          }}};
  Manager manager_{{"/robot", model_, hardware_, sensors_, log_,
                    [this](const std::string& name) { return parameter(name); }},
                   types_};
};

TEST_F(ManagerTest, SaysWhyItLoadsNoController) {
  const auto why = [this](const std::string& name) {
    return error_of([&] { manager_.load(name); });
  };
  load({"base"});
  EXPECT_EQ(why("base"), "could not load controller 'base': one with this name is loaded already");
  EXPECT_EQ(why("nothing"),
            "could not load controller 'nothing': found no parameter /robot/nothing/type, expected "
            "the type of the controller; are its parameters on the server?");
  EXPECT_EQ(why("odd"),
            "could not load controller 'odd': /robot/odd/type: found 'x/Y', expected one of "
            "test/Noting");
  EXPECT_EQ(why("strange"),
            "could not load controller 'strange': /robot/strange/joints: found joint 'knee', "
            "expected one that a transmission names");
  EXPECT_EQ(manager_.list().size(), 1u);
}

TEST_F(ManagerTest, ListsInTheOrderOfLoading) {
  load({"state", "base"});
  const auto list = manager_.list();
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name, "state");
  EXPECT_EQ(list[0].type, "test/Noting");
  EXPECT_EQ(list[0].claims.at(0).interface, "hardware_interface::JointStateInterface");
  EXPECT_TRUE(list[0].claims.at(0).joints.empty());
  EXPECT_EQ(list[1].claims.at(0).interface, "hardware_interface::VelocityJointInterface");
  EXPECT_EQ(list[1].claims.at(0).joints, (Names{"left", "right"}));
  EXPECT_EQ(manager_.type_names(), Names{"test/Noting"});
}

TEST_F(ManagerTest, GoesThroughTheStates) {
  const auto state = [this] { return manager_.list().at(0).state; };
  load({"base"});
  EXPECT_EQ(state(), "initialized");
  switched({"base"}, {});
  EXPECT_EQ(state(), "running");
  EXPECT_EQ(error_of([this] { manager_.unload("base"); }),
            "could not unload controller 'base': it is running, expected it stopped");
  switched({}, {"base"});
  EXPECT_EQ(state(), "stopped");
  manager_.unload("base");
  EXPECT_TRUE(manager_.list().empty());
  EXPECT_EQ(error_of([this] { manager_.unload("base"); }),
            "could not unload controller 'base': no controller with this name is loaded");
}

TEST_F(ManagerTest, StrictRefusesWhatBestEffortPassesOver) {
  load({"base", "arm"});
  switched({"base"}, {});
  const struct {
    Names start, stop;
    const char* why;
    const char* running;  // running with best effort
  } cases[]{
      {{"ghost", "arm"}, {}, "could not start controller 'ghost': no controller", "base arm"},
      {{}, {"ghost", "base"}, "could not stop controller 'ghost': no controller", ""},
      {{"base", "arm"}, {}, "could not start controller 'base': it is running already", "base arm"},
      {{}, {"arm", "base"}, "could not stop controller 'arm': it is not running", ""},
  };
  for (const auto& each : cases) {
    EXPECT_EQ(switched(each.start, each.stop).rfind(each.why, 0), 0u)
        << switched(each.start, each.stop);
    EXPECT_EQ(running(), "base");
    EXPECT_EQ(switched(each.start, each.stop, Strictness::kBestEffort), "");
    EXPECT_EQ(running(), each.running);
    switched({"base"}, {"arm"}, Strictness::kBestEffort);
  }
}

TEST_F(ManagerTest, NeverStartsAndStopsTheSame) {
  load({"base"});
  for (const Strictness each : {Strictness::kStrict, Strictness::kBestEffort}) {
    EXPECT_EQ(switched({"base"}, {"base"}, each),
              "conflicting switching command: found controller 'base' both to start and to stop");
  }
  EXPECT_EQ(running(), "");
}

TEST_F(ManagerTest, NoJointHasTwoMasters) {
  load({"base", "left_only", "arm", "state"});
  const std::string conflict =
      "could not switch controllers, due to resource conflict: 'base' and 'left_only' both claim "
      "joint 'left'";
  EXPECT_EQ(switched({"base", "left_only"}, {}), conflict);
  EXPECT_EQ(running(), "");
  EXPECT_EQ(switched({"base", "arm", "state"}, {}), "");
  EXPECT_EQ(switched({"left_only"}, {"arm"}, Strictness::kBestEffort), conflict);
  EXPECT_EQ(running(), "base arm state");
  EXPECT_EQ(switched({"left_only"}, {"base"}), "");
  EXPECT_EQ(running(), "left_only arm state");
}

TEST_F(ManagerTest, StopsBeforeItStartsAndUpdatesInTheNextCycle) {
  load({"left_only", "base"});
  switched({"left_only"}, {});
  manager_.update(10, 10.0, nobody_);
  switched({"base"}, {"left_only"});
  manager_.update(20, 10.0, nobody_);
  EXPECT_EQ(notes_, (Notes{"left_only start 0", "left_only update 20", "left_only stop 10",
                           "base start 10", "base update 30"}));
}

TEST_F(ManagerTest, RestartsAndResetsThoseThatRun) {
  load({"base", "arm"});
  switched({"base"}, {});
  notes_.clear();
  manager_.restart(5);
  EXPECT_EQ(notes_, (Notes{"base stop 5", "base start 5"}));
  notes_.clear();
  manager_.reset(7);
  EXPECT_EQ(notes_, (Notes{"base stop 7", "base reset 7", "base start 7", "arm reset 7"}));
}

TEST_F(ManagerTest, UnloadsAll) {
  load({"base", "arm"});
  switched({"base"}, {});
  manager_.unload_all();
  EXPECT_TRUE(manager_.list().empty());
  EXPECT_EQ(notes_.back(), "base stop 0");
}

}  // namespace
}  // namespace ardee::control
