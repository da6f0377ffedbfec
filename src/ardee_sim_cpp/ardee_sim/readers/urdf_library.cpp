// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/urdf_library.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>
#include <vector>

namespace ardee {
namespace {

/// Collects what urdfdom logs while it lives; urdfdom knows no other way to say what is wrong.
class Listener : public console_bridge::OutputHandler {
 public:
  Listener() : lock_(mutex()) { console_bridge::useOutputHandler(this); }
  ~Listener() override { console_bridge::restorePreviousOutputHandler(); }

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) said_.push_back(text);
  }
  const std::vector<std::string>& said() const { return said_; }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }

  std::lock_guard<std::mutex> lock_;  // the handler is global to the process
  std::vector<std::string> said_;
};

}  // namespace

urdf::ModelInterfaceSharedPtr parse_with_urdfdom(const std::string& text, const Source& source,
                                                 Log& log) {
  urdf::ModelInterfaceSharedPtr robot;
  std::vector<std::string> said;
  {
    Listener listener;
    robot = urdf::parseURDF(text);
    said = listener.said();
  }
  if (!robot || !robot->getRoot()) {
    std::string why;
    for (const std::string& line : said) why += (why.empty() ? "" : "; ") + line;
    throw Error(source, "found a URDF that does not parse (" + why + "), expected a robot");
  }
  for (const std::string& line : said) log.warn(source.to_string() + ": " + line);
  return robot;
}

}  // namespace ardee
