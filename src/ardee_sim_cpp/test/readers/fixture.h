// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "../temp_folder.h"
#include "../test_data.h"
#include "ardee_sim/readers/loader.h"

namespace ardee {

/// Loader over a temporary model folder and the test data, with a record of its messages.
class ReadersTest : public ::testing::Test {
 protected:
  explicit ReadersTest(BadParts bad_parts = BadParts::kRefuse)
      : loader_(make_locator(), make_log(), bad_parts) {}

  static std::string data(const std::string& name) { return test_data(name); }

  std::shared_ptr<const Model> model(const std::string& body, const std::string& version = "1.5") {
    return loader_.load_model_text(
        "<sdf version='" + version + "'><model name='m'>" + body + "</model></sdf>", "test.sdf");
  }
  World world(const std::string& body, const std::string& version = "1.5") {
    return loader_.load_world_text(
        "<sdf version='" + version + "'><world name='w'>" + body + "</world></sdf>", "test.world");
  }
  std::shared_ptr<const Model> robot(const std::string& body) {
    return loader_.load_model_text("<robot name='r'>\n" + body + "</robot>", "test.urdf");
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

  bool warned(const std::string& part) const {
    return std::any_of(warnings_->begin(), warnings_->end(), [&part](const std::string& text) {
      return text.find(part) != std::string::npos;
    });
  }

  TempFolder folder_;
  std::shared_ptr<std::vector<std::string>> warnings_ =
      std::make_shared<std::vector<std::string>>();
  std::shared_ptr<std::vector<std::string>> errors_ = std::make_shared<std::vector<std::string>>();
  Loader loader_;

 private:
  ResourceLocator make_locator() const {
    ResourceLocator locator;
    locator.add_model_path(folder_.path());
    locator.add_model_path(data(""));
    const std::string root = folder_.path();
    locator.set_package_finder([root](const std::string& package) -> std::optional<std::string> {
      const std::string path = root + "/" + package;
      if (std::filesystem::is_directory(path)) return path;
      if (package == "test_data") return data("");
      return std::nullopt;
    });
    return locator;
  }
  Log make_log() {
    auto warnings = warnings_;
    auto errors = errors_;
    return Log([warnings, errors](LogLevel level, const std::string& text) {
      if (level == LogLevel::kWarning) warnings->push_back(text);
      if (level == LogLevel::kError) errors->push_back(text);
    });
  }
};

#define EXPECT_HAS(text, part)                               \
  EXPECT_NE(std::string(text).find(part), std::string::npos) \
      << "in: " << (text) << "\nmissing: " << (part)

inline void expect_near(const Eigen::Vector3d& found, const Eigen::Vector3d& expected,
                        double tolerance = 1e-9) {
  EXPECT_LT((found - expected).norm(), tolerance)
      << "found " << found.transpose() << ", expected " << expected.transpose();
}

}  // namespace ardee
