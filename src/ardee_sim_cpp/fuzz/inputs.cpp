// SPDX-License-Identifier: MIT
#include "fuzz/inputs.h"

#include <filesystem>

#include "test/temp_folder.h"
#include "test/test_data.h"

namespace ardee::fuzz {
namespace {

std::optional<std::string> find_package(const std::string& package) {
  if (package == "test_data") return test_data();
  const std::string folder = ARDEE_PACKAGES "/" + package;
  if (std::filesystem::is_regular_file(folder + "/package.xml")) return folder;
  return std::nullopt;
}

}  // namespace

Log quiet_log() {
  return Log([](LogLevel, const std::string&) {});
}

Loader make_loader() {
  ResourceLocator locator;
  locator.add_model_path(test_data());
  locator.add_model_path(ARDEE_PACKAGES "/ardee_models/models");
  locator.add_resource_path(test_data());
  locator.set_package_finder(find_package);
  return Loader(std::move(locator), quiet_log());
}

std::string write_input(const std::string& name, const std::string& input) {
  static const TempFolder folder;
  return folder.write(name, input);
}

}  // namespace ardee::fuzz
