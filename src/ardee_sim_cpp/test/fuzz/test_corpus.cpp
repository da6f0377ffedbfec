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

class Corpus : public ::testing::TestWithParam<Target> {};

/// A corpus of refused inputs alone would test little.
TEST_P(Corpus, EachInputIsTakenOrRefusedByAnErrorAndOneIsTaken) {
  int accepted = 0;
  for (const auto& entry :
       fs::directory_iterator(std::string(ARDEE_CORPUS "/") + GetParam().name)) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_NO_THROW(accepted += accepts(GetParam(), bytes_of(entry.path())));
  }
  EXPECT_GT(accepted, 0);
}

INSTANTIATE_TEST_SUITE_P(Targets, Corpus, ::testing::ValuesIn(targets()),
                         [](const auto& info) { return std::string(info.param.name); });

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
