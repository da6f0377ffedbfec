// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "../temp_folder.h"
#include "ardee_sim/readers/xml.h"
#include "fuzz/mutator.h"

namespace ardee::fuzz {
namespace {

constexpr std::size_t kMost = 1000;
constexpr unsigned kSeeds = 500;

const std::string kModel =
    "<sdf version='1.6'><model name='m'><pose>1 2 3 0 0 0</pose><link name='a'/></model></sdf>";

TEST(Mutator, ChangesXmlInManyWaysAndKeepsItWellFormed) {
  std::set<std::string> made;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const std::string text = mutate_text(kModel, kMost, seed);
    EXPECT_NO_THROW(XmlFile(text, "mutated")) << text;
    EXPECT_EQ(text, mutate_text(kModel, kMost, seed));
    made.insert(text);
  }
  EXPECT_GT(made.size(), kSeeds / 2);
}

TEST(Mutator, ChangesTheXmlBehindALetterAndKeepsTheLetter) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    EXPECT_EQ(mutate_text("d" + kModel, kMost, seed).substr(0, 2), "d<");
  }
}

TEST(Mutator, ChangesLinesOfOtherTextAndLeavesBytesToOthers) {
  const std::string table = "model,name,x_m\nmodel://a,b,1\n";
  std::set<std::string> made;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) made.insert(mutate_text(table, kMost, seed));
  EXPECT_GT(made.size(), kSeeds / 10);
  EXPECT_EQ(mutate_text(std::string("\x89PNG\0", 5), kMost, 1), "");
}

TEST(Mutator, MakesNothingThatIsTooLong) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    EXPECT_LE(mutate_text(kModel, kModel.size(), seed).size(), kModel.size());
    EXPECT_LE(cross_xml(kModel, kModel, kModel.size(), seed).size(), kModel.size());
  }
}

TEST(Mutator, AddsElementsOfTheDictionary) {
  const TempFolder folder;
  read_words(folder.write("words.dict", "# names\n\"gearbox_ratio\"\n"));
  int count = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    count += mutate_text(kModel, kMost, seed).find("<gearbox_ratio") != std::string::npos;
  }
  EXPECT_GT(count, 0);
}

TEST(Mutator, PutsAnElementOfOneDocumentIntoAnother) {
  const std::string made = cross_xml("<a/>", "<b/>", kMost, 1);
  EXPECT_EQ(made, "<a><b/></a>");
  EXPECT_EQ(cross_xml("<a/>", "no XML", kMost, 1), "");
}

}  // namespace
}  // namespace ardee::fuzz
