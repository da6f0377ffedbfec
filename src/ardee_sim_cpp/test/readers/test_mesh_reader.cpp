// SPDX-License-Identifier: MIT
#include <ctime>

#include "ardee_sim/core/text_file.h"
#include "ardee_sim/readers/mesh_reader.h"
#include "fixture.h"

// Assimp leaks some memory when it refuses a broken file; the leak check is for our own code.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }

namespace ardee {
namespace {

/// Reads a file and keeps the messages about it.
struct Reading {
  explicit Reading(const std::string& path)
      : log([this](LogLevel, const std::string& text) { said += text + "\n"; }),
        file(read_mesh_file(path, Source{"test", 1, "uri"}, log)) {}

  std::string said;
  Log log;
  MeshFile file;
};

MeshFile read(const std::string& name) {
  const Reading reading(test_data("meshes/" + name));
  EXPECT_EQ(reading.said, "");
  return reading.file;
}

void expect_box(const SubMesh& part, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  Eigen::Vector3f least = part.vertices.at(0);
  Eigen::Vector3f most = least;
  for (const Eigen::Vector3f& vertex : part.vertices) {
    least = least.cwiseMin(vertex);
    most = most.cwiseMax(vertex);
  }
  EXPECT_LT((least - low).norm(), 1e-5f) << least.transpose();
  EXPECT_LT((most - high).norm(), 1e-5f) << most.transpose();
}

/// Returns the volume by the divergence theorem; positive if the triangles face outwards.
double volume(const SubMesh& part) {
  double sum = 0.0;
  for (const auto& t : part.triangles) {
    sum += part.vertices[t[0]].dot(part.vertices[t[1]].cross(part.vertices[t[2]])) / 6.0;
  }
  return sum;
}

TEST(MeshReader, ReadsEachFormat) {
  for (const char* name : {"cube.stl", "solid_header.stl", "cube.obj", "two_sided.dae"}) {
    const MeshFile file = read(name);
    ASSERT_EQ(file.parts.size(), 1u) << name;
    EXPECT_EQ(file.parts[0].triangles.size(), 12u) << name;
    expect_box(file.parts[0], {0, 0, 0}, {1, 1, 1});
    EXPECT_NEAR(volume(file.parts[0]), 1.0, 1e-6) << name;
  }
}

TEST(MeshReader, AppliesNodeTransformsAndNamesPartsByNode) {
  const MeshFile file = read("parts_z_up.dae");
  ASSERT_EQ(file.parts.size(), 2u);
  EXPECT_EQ(file.parts[0].name, "Stem");
  expect_box(file.parts[0], {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(file.parts[1].name, "Leaf");
  expect_box(file.parts[1], {9, 0, 0}, {10, 1, 1});
  EXPECT_EQ(part_names(file), (std::vector<std::string>{"Stem", "Leaf"}));
}

TEST(MeshReader, AppliesTheUnitAndNotTheUpAxis) {
  expect_box(read("parts_inch.dae").parts.at(1), {9 * 0.0254f, 0, 0}, {0.254f, 0.0254f, 0.0254f});
  expect_box(read("parts_y_up.dae").parts.at(1), {9, 0, 0}, {10, 1, 1});
}

TEST(MeshReader, KeepsTrianglesOutwardsUnderAMirror) {
  const MeshFile file = read("mirrored.dae");
  expect_box(file.parts.at(0), {-1, 0, 0}, {0, 1, 1});
  EXPECT_NEAR(volume(file.parts.at(0)), 1.0, 1e-6);
}

TEST(MeshReader, ReadsMaterials) {
  const MeshFile one_sided = read("parts_z_up.dae");
  const Material& material =
      one_sided.materials.at(static_cast<std::size_t>(one_sided.parts.at(0).material));
  EXPECT_TRUE(material.diffuse.isApprox(Color(0.2f, 0.4f, 0.6f, 1)));
  EXPECT_FALSE(material.two_sided);
  EXPECT_TRUE(read("two_sided.dae").materials.at(0).two_sided);
  EXPECT_EQ(read("cube.stl").parts.at(0).material, -1);
}

TEST(MeshReader, FindsTexturesBesideTheMeshAndInTheModelsFolder) {
  const TempFolder folder;
  const std::string obj =
      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";
  const std::string path = folder.write("meshes/m.obj", obj);
  folder.write("meshes/m.mtl", "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd leaf.png\n");
  EXPECT_EQ(Reading(path).file.materials.back().texture_path, "");
  const std::string in_model = folder.write("materials/textures/leaf.png", "x");
  EXPECT_EQ(Reading(path).file.materials.back().texture_path, in_model);
  const std::string beside = folder.write("meshes/leaf.png", "x");
  const MeshFile file = Reading(path).file;
  EXPECT_EQ(file.materials.back().texture_path, beside);
  // v counts upwards from the picture's lower edge, as in the file.
  EXPECT_EQ(file.parts.at(0).texcoords.at(2), Eigen::Vector2f(0, 1));
}

/// Returns the area of all triangles of a file.
double area(const MeshFile& file) {
  double sum = 0.0;
  for (const SubMesh& part : file.parts) {
    for (const auto& t : part.triangles) {
      const Eigen::Vector3f& a = part.vertices[t[0]];
      sum += 0.5 * (part.vertices[t[1]] - a).cross(part.vertices[t[2]] - a).norm();
    }
  }
  return sum;
}

std::size_t triangles(const MeshFile& file) {
  std::size_t sum = 0;
  for (const SubMesh& part : file.parts) sum += part.triangles.size();
  return sum;
}

/// Block of 1 x 2 x 3 m in quadrilaterals, and the six corners of an L of 3 square metres.
const std::string kBlock =
    "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
const std::string kL = "0 0 0 2 0 0 2 1 0 1 1 0 1 2 0 0 2 0";

std::string collada(const std::string& primitives, const std::string& cameras = "",
                    const std::string& nodes = "") {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><up_axis>Z_UP</up_axis></asset>" +
         cameras +
         "<library_geometries><geometry id='g' name='g'><mesh><source id='s'>"
         "<float_array id='a' count='18'>" +
         kL +
         "</float_array><technique_common><accessor source='#a' count='6' stride='3'>"
         "<param name='X' type='float'/><param name='Y' type='float'/><param name='Z' "
         "type='float'/></accessor></technique_common></source><vertices id='v'>"
         "<input semantic='POSITION' source='#s'/></vertices>" +
         primitives +
         "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='w'>" +
         nodes +
         "<node id='n' name='n'><instance_geometry url='#g'/></node></visual_scene>"
         "</library_visual_scenes><scene><instance_visual_scene url='#w'/></scene></COLLADA>";
}

std::string primitive(const std::string& name, int count, const std::string& indices) {
  return "<" + name + " count='" + std::to_string(count) +
         "'><input semantic='VERTEX' source='#v' offset='0'/>" + indices + "</" + name + ">";
}

TEST(MeshPolygons, AreCutIntoTriangles) {
  const TempFolder folder;
  const Reading quads(folder.write("block.obj", kBlock));
  EXPECT_EQ(triangles(quads.file), 12u);
  EXPECT_NEAR(volume(quads.file.parts.at(0)), 6.0, 1e-6);
  const Reading mixed(folder.write("mixed.obj", kBlock + "f 1 2 3\n"));
  EXPECT_EQ(triangles(mixed.file), 13u);
  const Reading ply(folder.write(
      "l.ply",
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty "
      "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n2 0 "
      "0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n6 0 1 2 3 4 5\n"));
  EXPECT_NEAR(area(ply.file), 3.0, 1e-6);
  EXPECT_EQ(quads.said + mixed.said + ply.said, "");
}

TEST(MeshPolygons, OfEachKindOfCollada) {
  const TempFolder folder;
  for (const std::string& each :
       {primitive("polylist", 1, "<vcount>6</vcount><p>0 1 2 3 4 5</p>"),
        primitive("polylist", 2, "<vcount>4 4</vcount><p>0 1 2 3 0 3 4 5</p>"),
        primitive("polygons", 1, "<p>0 1 2 3 4 5</p>"),
        primitive("polygons", 2, "<p>0 1 2 3</p><p>0 3 4 5</p>"),
        primitive("tristrips", 2, "<p>0 1 3 2</p><p>0 3 5 4</p>"),
        primitive("trifans", 1, "<p>3 4 5 0 1 2</p>"),
        primitive("trifans", 2, "<p>0 1 2 3</p><p>0 3 4 5</p>"),
        primitive("triangles", 2, "<p>0 1 2 0 2 3</p>") +
            primitive("trifans", 1, "<p>0 3 4 5</p>")}) {
    const Reading reading(folder.write("l.dae", collada(each)));
    EXPECT_NEAR(area(reading.file), 3.0, 1e-6) << each;
    EXPECT_EQ(reading.said, "") << each;
    for (const SubMesh& part : reading.file.parts) {
      for (const auto& t : part.triangles) {
        const Eigen::Vector3f& a = part.vertices[t[0]];
        EXPECT_GT((part.vertices[t[1]] - a).cross(part.vertices[t[2]] - a).z(), 0.0f) << each;
      }
    }
  }
}

TEST(MeshReader, FollowsALongChainOfColladaParametersOnce) {
  const TempFolder folder;
  std::string chain;
  for (int i = 0; i < 20'000; ++i) {
    chain += "<newparam sid='" + std::to_string(i) + "'><sampler2D><source>" +
             std::to_string(i + 1) + "</source></sampler2D></newparam>";
  }
  const std::string effect = "<library_effects><effect id='e'><profile_COMMON>" + chain +
                             "</profile_COMMON></effect></library_effects>";
  const std::string part = primitive("triangles", 1, "<p>0 1 2</p>");
  const std::clock_t start = std::clock();
  EXPECT_EQ(triangles(Reading(folder.write("l.dae", collada(part, effect))).file), 1u);
  // The limit is ten times the need of a slow machine; work that grows with the square takes far
  // longer.
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 5.0);
}

TEST(MeshReader, RefusesColladaThatTheLibraryWouldNotOutlive) {
  const TempFolder folder;
  const std::string part = primitive("triangles", 1, "<p>0 1 2</p>");
  const std::string effect =
      "<library_effects><effect id='e'><profile_COMMON><newparam sid='a'><sampler2D><source>a"
      "</source></sampler2D></newparam></profile_COMMON></effect></library_effects>";
  const std::string skew = "<node id='k'><skew>45 0 1 0 1 0 0</skew></node>";
  const std::string in_node = "<node id='k'><mesh/></node>";
  for (const std::string& text :
       {collada(part, effect), collada(part, "", skew), collada(part, "", in_node),
        collada(primitive("triangles", 1, "")), collada(primitive("polygons", 2, "<p>0 1 2</p>")),
        collada(primitive("polylist", 1, "<vcount>3</vcount>"))}) {
    const std::string path = folder.write("l.dae", text);
    EXPECT_THROW(Reading{path}, Error) << text;
  }
  EXPECT_EQ(triangles(Reading(folder.write("l.dae", collada(part))).file), 1u);
}

TEST(MeshPolygons, AFanNeedNotBeFlat) {
  const TempFolder folder;
  const Reading cone(
      folder.write("cone.dae", collada(primitive("trifans", 1, "<p>0 1 3 5 1</p>"))));
  EXPECT_EQ(triangles(cone.file), 3u);
}

TEST(MeshPolygons, AFanIsReadWhateverStandsBesideTheElements) {
  const TempFolder folder;
  std::string fan = collada(primitive("trifans", 1, "<p>3 4 5 0 1 2</p>"));
  const std::string declaration = "<?xml version='1.0'?>";
  fan.erase(0, declaration.size());
  std::string note = fan;
  note.insert(note.find("<asset>"), "<?note made by hand?>");
  for (const std::string& text : {declaration + note, "<!-- a comment -->\n" + declaration + fan}) {
    EXPECT_NEAR(area(Reading(folder.write("l.dae", text)).file), 3.0, 1e-6) << text;
  }
}

/// Returns the message of the exception that reading a file throws; empty for none.
std::string error_of(const std::string& path) {
  try {
    const Reading reading(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Each tooth of a comb of many teeth is cut off only after all corners were tested.
TEST(MeshPolygons, TakeAtMostSomeSecondsAFile) {
  std::string corners;
  std::string face = "f";
  const int teeth = 500;
  for (int k = 0; k < teeth; ++k) {
    corners += "v " + std::to_string(k) + " 0 0\nv " + std::to_string(k) + " " +
               std::to_string(1 + (k * 7919) % 13) + " 0\n";
  }
  for (int k = 1; k <= 2 * teeth; ++k) face += " " + std::to_string(k * 379 % 1000 + 1);
  std::string text = corners;
  for (int k = 0; k < 200; ++k) text += face + "\n";
  const TempFolder folder;
  EXPECT_HAS(error_of(folder.write("combs.obj", text)), "found too many polygons of many corners");
}

/// Returns nodes of a library, each of which holds the next `copies` times.
std::string chain(int length, int copies) {
  std::string nodes;
  for (int k = 0; k < length; ++k) {
    nodes += "<node id='c" + std::to_string(k) + "'>";
    for (int copy = 0; copy < copies; ++copy) {
      nodes += "<instance_node url='#c" + std::to_string(k + 1) + "'/>";
    }
    nodes += "</node>";
  }
  return "<library_nodes>" + nodes + "<node id='c" + std::to_string(length) +
         "'><instance_geometry url='#g'/></node></library_nodes>";
}

TEST(MeshReader, LooksAtEachNodeOfAColladaFileOnce) {
  const TempFolder folder;
  const auto error = [&](int length, int copies) {
    const std::string triangle = primitive("triangles", 1, "<p>0 1 2</p>");
    return error_of(
        folder.write("chain.dae", collada(triangle, chain(length, copies),
                                          "<node id='top'><instance_node url='#c0'/></node>")));
  };
  EXPECT_EQ(error(900, 1), "");
  EXPECT_EQ(error(10, 2), "");
  EXPECT_HAS(error(20'000, 1), "found nodes more than 1000 deep in each other");
  EXPECT_HAS(error(40, 2), "found too many nodes");
  const std::string ring =
      "<library_nodes><node id='a'><instance_node url='#b'/></node><node id='b'>"
      "<node id='c'><instance_node url='#a'/></node></node></library_nodes>";
  EXPECT_HAS(
      error_of(folder.write("ring.dae", collada(primitive("triangles", 1, "<p>0 1 2</p>"), ring))),
      "within itself, expected a tree");
}

TEST(MeshPolygons, WhatIsNoneIsToldOnce) {
  const TempFolder folder;
  const Reading reading(folder.write("rest.obj", kBlock + "l 1 2 3\np 1\nf 1 2 2\n"));
  EXPECT_EQ(triangles(reading.file), 12u);
  EXPECT_EQ(reading.said, "test:1: <uri>: left out of '" + folder.path() +
                              "/rest.obj': 1 point(s), 2 line(s), 1 face(s) without area\n");
}

TEST(MeshReader, PassesOverCamerasOfOneName) {
  const auto camera = [](const std::string& id) {
    return "<camera id='" + id +
           "' name='cam'><optics><technique_common><perspective><xfov>40</xfov><znear>1</znear>"
           "<zfar>9</zfar></perspective></technique_common></optics></camera>";
  };
  const TempFolder folder;
  const Reading reading(folder.write(
      "c.dae", collada(primitive("triangles", 1, "<p>0 1 2</p>"),
                       "<library_cameras>" + camera("c1") + camera("c2") + "</library_cameras>",
                       "<node id='n1' name='cam'><instance_camera url='#c1'/></node>"
                       "<node id='n2' name='cam'><instance_camera url='#c2'/></node>")));
  EXPECT_EQ(triangles(reading.file), 1u);
}

/// The buffer holds the corners (0, 0, 0), (1, 0, 0), (0, 1, 0) and the indices 0, 1, 2.
TEST(MeshReader, ReadsGltfWithItsNodesAndAsItsAxesLie) {
  const std::string gltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"name":"root","translation":[0,5,0],"children":[1]},
             {"name":"tri","mesh":0,"scale":[2,2,2]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],
    "buffers":[{"byteLength":44,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA="}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
                 {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
  const TempFolder folder;
  const Reading reading(folder.write("t.gltf", gltf));
  ASSERT_EQ(reading.file.parts.size(), 1u);
  EXPECT_EQ(reading.file.parts[0].name, "tri");
  expect_box(reading.file.parts[0], {0, 5, 0}, {2, 7, 0});
  EXPECT_EQ(reading.said, "");
  EXPECT_THROW(Reading(folder.write("t.glb", "glTF\x02")), Error);
}

TEST(MeshReader, ASolidMayBeCalledVertex) {
  const TempFolder folder;
  const Reading reading(folder.write(
      "v.stl",
      "solid vertex_cube\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
      "0\nendloop\nendfacet\nendsolid vertex_cube\n"));
  EXPECT_EQ(triangles(reading.file), 1u);
}

TEST(MeshReader, RefusesAnStlFacetOfFourCorners) {
  const TempFolder folder;
  const std::string path = folder.write(
      "q.stl",
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex "
      "0 1 0\nendloop\nendfacet\nendsolid a\n");
  EXPECT_HAS(error_of(path), "found a facet of 4 corners in STL '" + path + "', line 3");
}

TEST(MeshReader, ReadsNumbersOfAnObjThatBeginWithAPoint) {
  const TempFolder folder;
  folder.write("m.mtl", "newmtl a\nKd .5 .25 0\n");
  const Reading reading(folder.write(
      "m.obj", "mtllib ./m.mtl\nv 0 0 .5\nv -.5 0 .5\nv 0\t.25 .5\nusemtl a\nf 1 2 3\n"));
  expect_box(reading.file.parts.at(0), {-0.5f, 0, 0.5f}, {0, 0.25f, 0.5f});
  EXPECT_TRUE(reading.file.materials.back().diffuse.isApprox(Color(0.5f, 0.25f, 0, 1)));
  EXPECT_EQ(reading.said, "");
}

TEST(MeshPolygons, AFaceOfTwoCornersIsALine) {
  const TempFolder folder;
  const Reading reading(folder.write("two.obj", kBlock + "f 1 2\nf 3\n"));
  EXPECT_EQ(triangles(reading.file), 12u);
  EXPECT_EQ(reading.said,
            "test:1: <uri>: left out of '" + folder.path() + "/two.obj': 1 point(s), 1 line(s)\n");
}

TEST(MeshReader, CutsOffWhatFollowsTheTrianglesOfABinaryStl) {
  const std::string path = test_data("meshes/cube.stl");
  const std::string cube = read_text_file(path, Source{}, 10000);
  const TempFolder folder;
  const Reading reading(folder.write("long.stl", cube + "tail"));
  EXPECT_EQ(triangles(reading.file), 12u);
  EXPECT_EQ(reading.said, "test:1: <uri>: found 4 bytes after the last triangle of '" +
                              folder.path() + "/long.stl', expected none; left out\n");
}

}  // namespace
}  // namespace ardee
