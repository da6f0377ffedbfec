// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fuzz/targets.h"

namespace ardee::fuzz {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Target& target : targets()) all.emplace_back(target.name);
  return all;
}

class Corpus : public ::testing::TestWithParam<std::string> {};

/// A corpus of refused inputs alone would test little.
TEST_P(Corpus, EachInputIsTakenOrRefusedByAnErrorAndOneIsTaken) {
  int accepted = 0;
  for (const auto& entry : fs::directory_iterator(ARDEE_CORPUS "/" + GetParam())) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_NO_THROW(accepted += accepts(*find_target(GetParam()), bytes_of(entry.path())));
  }
  EXPECT_GT(accepted, 0);
}

INSTANTIATE_TEST_SUITE_P(Targets, Corpus, ::testing::ValuesIn(names()),
                         [](const auto& instance) { return instance.param; });

TEST(CorpusFiles, AreSmall) {
  constexpr std::uintmax_t kMostBytes = 200'000;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(ARDEE_CORPUS)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  EXPECT_LE(bytes, kMostBytes);
}

}  // namespace
}  // namespace ardee::fuzz
