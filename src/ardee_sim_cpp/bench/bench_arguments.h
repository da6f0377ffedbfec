// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/pose.h"

namespace ardee::bench {

/// Command line of pairs `--name value`, each with a default; an argument with an empty default is
/// required.
class BenchArguments {
 public:
  BenchArguments(int argc, char** argv, std::map<std::string, std::string> defaults,
                 const std::string& usage)
      : values_(std::move(defaults)) {
    for (int i = 1; i < argc; i += 2) {
      const auto found = values_.find(argv[i]);
      if (found == values_.end() || i + 1 == argc) {
        throw Error("found '" + std::string(argv[i]) + "'\n" + usage);
      }
      found->second = argv[i + 1];
    }
    for (const auto& [name, value] : values_) {
      if (value.empty()) throw Error("found no " + name + ", expected one\n" + usage);
    }
  }

  const std::string& text(const std::string& name) const { return values_.at(name); }
  double number(const std::string& name) const { return numbers(name, 1).front(); }
  /// Returns a pose from 'X Y Z YAW' in m and rad.
  Pose pose(const std::string& name) const {
    const std::vector<double> found = numbers(name, 4);
    return Pose::from_xyz_rpy({found[0], found[1], found[2]}, {0, 0, found[3]});
  }

 private:
  std::vector<double> numbers(const std::string& name, std::size_t count) const {
    std::istringstream text(values_.at(name));
    std::vector<double> found{std::istream_iterator<double>(text), {}};
    if (found.size() != count || !text.eof()) {
      throw Error(name + ": found '" + values_.at(name) + "', expected " + std::to_string(count) +
                  " number(s)");
    }
    return found;
  }

  std::map<std::string, std::string> values_;
};

/// Runs a program that drives down a lane: calls `bench` with the command line. `own` adds to the
/// defaults of all such programs, or replaces them. Returns the exit code; 0 for
/// -h, which prints the usage, and 2 for an error.
inline int run_bench(int argc, char** argv, std::map<std::string, std::string> own,
                     const std::string& usage,
                     const std::function<void(const BenchArguments&)>& bench) {
  if (argc == 2 && (std::string(argv[1]) == "-h" || std::string(argv[1]) == "--help")) {
    std::cout << usage << "\n";
    return 0;
  }
  try {
    own.merge(std::map<std::string, std::string>{{"--world", ""},
                                                 {"--robot", ""},
                                                 {"--pose", "0 0 0.175 0"},
                                                 {"--lane-m", "6"},
                                                 {"--speed-m-s", "0.5"}});
    bench(BenchArguments(argc, argv, own, usage));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << std::filesystem::path(argv[0]).filename().string() << ": " << error.what() << "\n";
    return 2;
  }
}

}  // namespace ardee::bench
