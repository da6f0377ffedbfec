// SPDX-License-Identifier: MIT
#include "ardee_sim/description/scenery.h"
#include "ardee_sim/readers/instance_table.h"
#include "fixture.h"

namespace ardee {
namespace {

const std::string kHeader = std::string(kInstanceColumns) + "\n";
constexpr const char* kGoodRow = "model://corn,plant_1,1,2,0.5,0,0,3.1,1.25,1\n";

class InstanceTable : public ReadersTest {
 protected:
  InstanceTable() {
    for (const char* name : {"corn", "weed"}) folder_.write_model(name, "<link name='link'/>");
  }

  /// Returns a field whose plants are the rows of a table.
  std::shared_ptr<const Model> field(const std::string& rows,
                                     const std::string& fixed = "<static>1</static>") {
    return table(kHeader + rows, fixed);
  }
  std::shared_ptr<const Model> table(const std::string& text,
                                     const std::string& fixed = "<static>1</static>") {
    folder_.write("field/plants.csv", text);
    return loader_.load_model(write_field(fixed + "<ardee:instances>plants.csv</ardee:instances>"));
  }
  std::string write_field(const std::string& body) {
    folder_.write_model("field", body);
    return folder_.path() + "/field/model.sdf";
  }
  std::string problem_of(const std::string& row) {
    return error_of([&] { field(kGoodRow + row + kGoodRow); });
  }
};

TEST_F(InstanceTable, HoldsWhatIncludesWouldHold) {
  std::string rows;
  std::string includes = "<static>true</static>";
  for (int i = 0; i < 500; ++i) {
    const std::string model = i % 3 == 0 ? "model://weed" : "model://corn";
    const std::string name = "plant_" + std::to_string(i % 400);  // some names twice
    const std::string n = std::to_string(i);
    const std::string pose[] = {"-" + n + ".1234", n + ".5", "0.0" + n, "0.1", "-0.2", "2.9" + n};
    const std::string scale = "1." + n;
    const std::string label = std::to_string(1 + i % 5);
    rows += model + "," + name;
    includes += "<include><uri>" + model + "</uri><name>" + name + "</name><pose>";
    for (const std::string& number : pose) {
      rows += "," + number;
      includes += number + " ";
    }
    rows += "," + scale + "," + label + "\n";
    includes += "</pose><ardee:scale>" + scale + "</ardee:scale><ardee:label>" + label +
                "</ardee:label></include>";
  }
  const auto streamed = field(rows);
  const auto nested = loader_.load_model(write_field(includes));
  ASSERT_EQ(streamed->instances.size(), 500u);
  ASSERT_EQ(nested->instances.size(), 500u);
  for (std::size_t i = 0; i < 500; ++i) {
    const Instance& a = streamed->instances[i];
    const Instance& b = nested->instances[i];
    EXPECT_EQ(a.model, b.model);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.pose.p, b.pose.p);
    EXPECT_EQ(a.pose.q.coeffs(), b.pose.q.coeffs());
    EXPECT_EQ(a.scale, b.scale);
    EXPECT_EQ(a.label, b.label);
    EXPECT_TRUE(a.is_static && b.is_static);
  }
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(InstanceTable, IsPlacedWithTheModelThatHoldsIt) {
  field(kGoodRow);
  const World w = world("<include><uri>model://field</uri><pose>10 0 0 0 0 0</pose></include>");
  const auto placed = flatten_scenery(w.models.at(0));
  ASSERT_EQ(placed.size(), 1u);
  expect_near(placed[0].X_WM.p, {11, 2, 0.5});
  EXPECT_EQ(placed[0].scale, 1.25);
  EXPECT_EQ(placed[0].label, 1u);
  EXPECT_TRUE(placed[0].model->is_static);
}

TEST_F(InstanceTable, MayBeEmptyStandBesideIncludesAndHaveWindowsLineEnds) {
  EXPECT_TRUE(field("")->instances.empty());
  const std::string row = "model://corn,p,1,2,3,0,0,0,1,0\r\n";
  const auto made = table(std::string(kInstanceColumns) + "\r\n" + row,
                          "<static>1</static><include><uri>model://weed</uri><name>p</name>"
                          "</include>");
  ASSERT_EQ(made->instances.size(), 2u);
  EXPECT_EQ(made->instances[1].name, "p_0");
  EXPECT_EQ(made->instances[1].label, 0u);
}

TEST_F(InstanceTable, RefusesARowWithItsLine) {
  const std::string file = folder_.path() + "/field/plants.csv:3: ";
  const std::pair<const char*, const char*> rows[] = {
      {"model://corn,p,nan,2,3,0,0,0,1,1\n", "column x_m: found 'nan', expected a number in ["},
      {"model://corn,p,1,inf,3,0,0,0,1,1\n", "column y_m: found 'inf', expected a number"},
      {"model://corn,p,1,2,1e10,0,0,0,1,1\n", "column z_m: found '1e10', expected a number"},
      {"model://corn,p,1,2,3,0.1x,0,0,1,1\n", "column roll_rad: found '0.1x', expected a number"},
      {"model://corn,p,1,2,3,0,,0,1,1\n", "column pitch_rad: found '', expected a number"},
      {"model://corn,p,1,2,3,0,0, 0,1,1\n", "column yaw_rad: found ' 0', expected a number"},
      {"model://corn,p,1,2,3,0,0,0,0,1\n", "column scale: found '0', expected a positive number"},
      {"model://corn,p,1,2,3,0,0,0,-1,1\n", "column scale: found '-1', expected a number in [0"},
      {"model://corn,p,1,2,3,0,0,0,1,1.5\n", "column label: found '1.5', expected a whole number"},
      {"model://corn,p,1,2,3,0,0,0,1,65536\n", "column label: found '65536', expected a number"},
      {"model://corn,,1,2,3,0,0,0,1,1\n", "column name: found '', expected a text"},
      {",p,1,2,3,0,0,0,1,1\n", "column model: found '', expected a text"},
      {"model://corn,p,1,2,3,0,0,0,1,1,\n",
       "found 11 columns in 'model://corn,p,1,2,3,0,0,0,1,1,'"},
      {"model://corn,p,1,2,3,0,0,0,1\n", "found 9 columns in"},
      {"\n", "found 1 columns in '', expected 10: model,name,x_m"},
      {"model://rice,p,1,2,3,0,0,0,1,1\n", "found 'model://rice', expected an existing file"},
      {"ftp://corn,p,1,2,3,0,0,0,1,1\n", "expected model://"},
  };
  for (const auto& [row, message] : rows) {
    const std::string error = problem_of(row);
    EXPECT_EQ(error.rfind(file, 0), 0u) << error;
    EXPECT_HAS(error, message);
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST_F(InstanceTable, RefusesABrokenFile) {
  const std::string row = kGoodRow;
  const std::string place = folder_.path() + "/field/plants.csv:";
  EXPECT_HAS(error_of([&] { field(row + row.substr(0, row.size() - 1)); }),
             place + "3: found a line without an end");
  EXPECT_HAS(error_of([&] { field(row + std::string(5000, 'x') + "\n"); }),
             place + "3: found a line of more than");
  EXPECT_HAS(error_of([&] { table(""); }), place + "1: found '', expected the header 'model,name");
  EXPECT_HAS(error_of([&] { table(row); }), place + "1: found 'model://corn,plant_1");
  EXPECT_HAS(error_of([&] { table(std::string(kInstanceColumns)); }), place + "1: found a line");
  EXPECT_HAS(error_of([&] { field(std::string("\0\x01", 2) + "\n"); }), place + "2: found 1 col");
}

TEST_F(InstanceTable, TakesTheLongestLineAndNoLonger) {
  const std::string rest = ",1,2,3,0,0,0,1,1\n";
  const std::string start = "model://corn,";
  const std::string name(1024 - start.size() - rest.size() + 1, 'n');
  EXPECT_EQ(field(start + name + rest)->instances.at(0).name, name);
  EXPECT_HAS(error_of([&] { field(start + name + "n" + rest); }), ":2: found a line of more than");
}

TEST_F(InstanceTable, RefusesAFieldThatCannotHoldOne) {
  const std::string element = "/field/model.sdf:1: <ardee:instances>: ";
  EXPECT_HAS(error_of([&] { field(kGoodRow, ""); }),
             element + "found this element, expected it in");
  const auto load = [this](const std::string& file) {
    return error_of([&] {
      loader_.load_model(
          write_field("<static>1</static><ardee:instances>" + file + "</ardee:instances>"));
    });
  };
  EXPECT_HAS(load("none.csv"), element + "found 'none.csv', expected an existing file");
  EXPECT_HAS(load(""), element + "found no text");
  EXPECT_HAS(load("../field"), element + "cannot read '");
}

TEST_F(InstanceTable, RefusesLightsAndAFieldInItself) {
  folder_.write("sun/model.sdf", "<sdf version='1.5'><light type='directional' name='s'/></sdf>");
  EXPECT_HAS(error_of([&] { field("model://sun,p,1,2,3,0,0,0,1,1\n"); }),
             "plants.csv:2: found lights alone in 'model://sun', expected a model");
  EXPECT_HAS(error_of([&] { field("model://field,p,1,2,3,0,0,0,1,1\n"); }),
             "plants.csv:2: found an include cycle");
  EXPECT_EQ(field(kGoodRow)->instances.size(), 1u);
}

}  // namespace
}  // namespace ardee
