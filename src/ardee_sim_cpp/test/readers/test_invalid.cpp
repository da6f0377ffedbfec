// SPDX-License-Identifier: MIT
#include <set>

#include "fixture.h"

namespace ardee {
namespace {

namespace fs = std::filesystem;

/// Returns the parts of the message that the first lines of a broken file name: <!-- expected: PART
/// -->.
std::vector<std::string> expected_parts(const fs::path& file) {
  const std::string mark = "<!-- expected: ";
  std::ifstream stream(file);
  std::vector<std::string> parts;
  for (std::string line; std::getline(stream, line) && line.rfind(mark, 0) == 0;) {
    parts.push_back(line.substr(mark.size(), line.rfind(" -->") - mark.size()));
  }
  return parts;
}

class Invalid : public ReadersTest {
 protected:
  std::string load(const fs::path& file) {
    return error_of([&] {
      if (file.extension() == ".world") {
        loader_.load_world(file.string());
      } else {
        loader_.load_model(file.string());
      }
    });
  }
};

TEST_F(Invalid, EachBrokenFileIsRefusedWithItsMessage) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(data("invalid"))) {
    const fs::path kind = entry.path().extension();
    if (kind == ".sdf" || kind == ".world" || kind == ".urdf") files.insert(entry.path());
  }
  EXPECT_GT(files.size(), 80u);
  for (const fs::path& file : files) {
    const auto parts = expected_parts(file);
    EXPECT_FALSE(parts.empty()) << file;
    const std::string error = load(file);
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 0) << error;
    for (const std::string& part : parts) EXPECT_HAS(error, part);
  }
}

TEST_F(Invalid, TheLoaderGoesOnAfterwards) {
  load(data("invalid/include_cycle.world"));
  load(data("invalid/zero_mass.sdf"));
  EXPECT_EQ(world("<include><uri>model://valid.xml</uri></include>").models.size(), 1u);
}

TEST_F(Invalid, DeepNestingIsRefused) {
  std::string deep;
  for (int i = 0; i < 10000; ++i) deep += "<model name='m'>";
  std::string closed = deep;
  for (int i = 0; i < 10000; ++i) closed += "</model>";
  for (const std::string& body : {deep, closed}) {
    EXPECT_HAS(error_of([&] { model(body); }), "deep, expected fewer");
    EXPECT_HAS(error_of([&] { robot(body); }), "deep, expected fewer");
  }
  std::string dae = "<COLLADA>";
  for (int i = 0; i < 10000; ++i) dae += "<node>";
  folder_.write("deep/deep.dae", dae);
  EXPECT_HAS(error_of([&] {
               model(
                   "<link name='a'><visual "
                   "name='v'><geometry><mesh><uri>model://deep/deep.dae</uri></mesh>"
                   "</geometry></visual></link>");
             }),
             "deep, expected fewer");
}

TEST_F(Invalid, DeepIncludesAreRefused) {
  for (int i = 0; i < 100; ++i) {
    folder_.write_model("m" + std::to_string(i),
                        "<include><uri>model://m" + std::to_string(i + 1) + "</uri></include>");
  }
  EXPECT_HAS(error_of([&] { world("<include><uri>model://m0</uri></include>"); }),
             "found includes nested more than 32 deep");
}

TEST_F(Invalid, MissingFilesAreNamed) {
  EXPECT_HAS(error_of([&] { loader_.load_world("/no/such.world"); }),
             "/no/such.world: found no file '/no/such.world', expected a readable file");
  EXPECT_HAS(error_of([&] { loader_.load_model(folder_.path()); }), "expected a readable file");
}

TEST_F(Invalid, EveryCutOfAModelGivesAnErrorOrAModel) {
  const std::string whole =
      "<sdf version='1.5'><model name='m'><link "
      "name='a'><inertial><mass>1</mass></inertial><collision name='c'>"
      "<geometry><box><size>1 1 1</size></box></geometry></collision></link></model></sdf>";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(error_of([&] { loader_.load_model_text(whole.substr(0, length), "cut"); }), "")
        << length;
  }
  EXPECT_EQ(error_of([&] { loader_.load_model_text(whole, "whole"); }), "");
}

TEST_F(Invalid, BytesChangedAtRandomNeverCrash) {
  std::ifstream stream(data("meshes/parts_z_up.dae"));
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  std::uint32_t state = 1;
  const auto draw = [&state](std::uint32_t below) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % below;
  };
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    std::string changed = whole;
    for (int k = 0; k < 3; ++k) {
      changed[draw(static_cast<std::uint32_t>(whole.size()))] = static_cast<char>(32 + draw(95));
    }
    const std::string name = "fuzz" + std::to_string(i) + "/m.dae";
    folder_.write(name, changed);
    refused += !error_of([&] {
                  model("<link name='a'><visual name='v'><geometry><mesh><uri>model://" + name +
                        "</uri></mesh></geometry></visual></link>");
                }).empty();
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace ardee
