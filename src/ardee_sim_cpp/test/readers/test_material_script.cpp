// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/material_script.h"
#include "fixture.h"

namespace ardee {
namespace {

/// Reads a script and keeps the messages about it.
MaterialScript read_script(const std::string& text, std::string* said = nullptr) {
  std::string warnings;
  Log log([&warnings](LogLevel, const std::string& warning) { warnings += warning + "\n"; });
  MaterialScript made = parse_material_script(text, "s", log);
  if (said) *said = warnings;
  return made;
}

constexpr const char* kListingA14 = R"(material Corn/LeavesBase
{
  technique
  {
    pass
    {
      alpha_rejection greater 128

      texture_unit
      {
        texture AG20lef3.tif
      }
      cull_hardware none
      cull_software none
    }
  }
})";

TEST(MaterialScript, ReadsListingA14) {
  const Material m = read_script(kListingA14).at("Corn/LeavesBase");
  EXPECT_TRUE(m.two_sided);
  EXPECT_NEAR(m.alpha_rejection, 128.0 / 255.0, 1e-6);
  EXPECT_EQ(m.texture_path, "AG20lef3.tif");
  EXPECT_EQ(m.diffuse, Color(1, 1, 1, 1));
}

TEST(MaterialScript, IsOneSidedUnlessItSaysOtherwise) {
  const MaterialScript s = read_script(
      "material A { technique { pass { cull_hardware clockwise\n } } }\nmaterial B { technique { "
      "pass { } } }");
  EXPECT_FALSE(s.at("A").two_sided);
  EXPECT_FALSE(s.at("B").two_sided);
  EXPECT_LT(s.at("B").alpha_rejection, 0.0f);
}

TEST(MaterialScript, ReadsColoursAndPassesOverTheRest) {
  const MaterialScript s = read_script(R"(
    import * from "other.material" // a comment { with a brace
    vertex_program glow glsl { source x.glsl }
    /* a longer
       comment } */
    material "Two words" {
      receive_shadows off
      technique {
        pass {
          ambient 0.1 0.2 0.3
          diffuse 0.4 0.5 0.6 0.7
          specular 0.8 0.9 1 12.5
          emissive 0.2 0.2 0.2 1
          vertex_program_ref glow { param_named time 1 }
          texture_unit { texture "a b.png"
            tex_address_mode wrap }
          texture_unit { texture second.png
          }
        }
        pass { diffuse 0 0 0
        }
      }
      technique { pass { diffuse 0 0 0
      } }
    })");
  const Material& m = s.at("Two words");
  EXPECT_TRUE(m.ambient.isApprox(Color(0.1f, 0.2f, 0.3f, 1)));
  EXPECT_TRUE(m.diffuse.isApprox(Color(0.4f, 0.5f, 0.6f, 0.7f)));
  EXPECT_TRUE(m.specular.isApprox(Color(0.8f, 0.9f, 1, 1)));
  EXPECT_TRUE(m.emissive.isApprox(Color(0.2f, 0.2f, 0.2f, 1)));
  EXPECT_EQ(m.texture_path, "a b.png");
}

TEST(MaterialScript, InheritsFromAParent) {
  const MaterialScript s =
      read_script(std::string(kListingA14) +
                  "\nmaterial Mid : Corn/LeavesBase { technique { pass { diffuse 1 0 0\n } } }");
  EXPECT_TRUE(s.at("Mid").two_sided);
  EXPECT_EQ(s.at("Mid").texture_path, "AG20lef3.tif");
  EXPECT_EQ(s.at("Mid").diffuse, Color(1, 0, 0, 1));
}

class ScriptedVisual : public ReadersTest {
 protected:
  Material material(const std::string& script) {
    return *model(
                "<link name='a'><visual "
                "name='v'><geometry><sphere><radius>1</radius></sphere></geometry>"
                "<material><script>" +
                script + "</script></material></visual></link>")
                ->links.at(0)
                .visuals.at(0)
                .material;
  }
};

TEST_F(ScriptedVisual, FindsScriptAndTextureInTheFoldersOfListingA24) {
  folder_.write("corn/materials/scripts/corn.material", kListingA14);
  const std::string texture = folder_.write("corn/materials/textures/AG20lef3.tif", "x");
  const Material m = material(
      "<uri>model://corn/materials/scripts </uri><uri>model://corn/materials/textures/</uri>"
      "<name>Corn/LeavesBase</name>");
  EXPECT_TRUE(m.two_sided);
  EXPECT_EQ(m.texture_path, texture);
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(ScriptedVisual, KnowsGazebosOwnColours) {
  const Material m =
      material("<uri>file://media/materials/scripts/gazebo.material</uri><name>Gazebo/Red</name>");
  EXPECT_EQ(m.diffuse, Color(1, 0, 0, 1));
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(ScriptedVisual, IsGreyWithAWarningWhereScriptOrTextureIsMissing) {
  const Material none = material("<uri>model://nowhere</uri><name>Corn/Stem</name>");
  EXPECT_EQ(none.diffuse, Material().diffuse);
  EXPECT_TRUE(
      warned("found no material 'Corn/Stem' (and nothing at model://nowhere), grey is used"));
  folder_.write("corn/materials/scripts/corn.material", kListingA14);
  const Material bare =
      material("<uri>model://corn/materials/scripts</uri><name>Corn/LeavesBase</name>");
  EXPECT_EQ(bare.texture_path, "");
  EXPECT_TRUE(bare.two_sided);
  EXPECT_TRUE(warned("found no texture 'AG20lef3.tif'"));
}

TEST_F(ScriptedVisual, SurvivesATruncatedScript) {
  folder_.write("corn/corn.material", std::string(kListingA14).substr(0, 100));
  EXPECT_EQ(material("<uri>model://corn</uri><name>Corn/LeavesBase</name>").diffuse,
            Material().diffuse);
  EXPECT_TRUE(warned("corn.material:6: found a block without end, expected '}'"));
}

TEST_F(ScriptedVisual, ColoursBesideTheScriptGoOverIt) {
  const auto m = model(
      "<link name='a'><visual "
      "name='v'><geometry><sphere><radius>1</radius></sphere></geometry><material>"
      "<script><name>Gazebo/Red</name></script><diffuse>0 1 0 "
      "1</diffuse></material></visual></link>");
  EXPECT_EQ(m->links.at(0).visuals.at(0).material->diffuse, Color(0, 1, 0, 1));
  EXPECT_EQ(m->links.at(0).visuals.at(0).material->ambient, Color(1, 0, 0, 1));
}

TEST(MaterialScript, KnowsAbstractMaterials) {
  std::string said;
  const MaterialScript s = read_script(
      "abstract material Base { technique { pass { diffuse 0 1 0 1\n } } }\n"
      "material Green : Base { }",
      &said);
  EXPECT_EQ(s.at("Green").diffuse, Color(0, 1, 0, 1));
  EXPECT_EQ(said, "");
}

TEST(MaterialScript, OfABadMaterialKeepsTheOthers) {
  std::string said;
  const MaterialScript s = read_script(
      "material A : Nobody { technique { pass { } } }\n"
      "material B { technique { pass { diffuse red 0 0\n } } }\n"
      "material C { technique { pass { diffuse 0 0 1\n } } }",
      &said);
  EXPECT_EQ(s.size(), 1u);
  EXPECT_EQ(s.at("C").diffuse, Color(0, 0, 1, 1));
  EXPECT_HAS(said,
             "s:1: found parent material 'Nobody', expected one defined before; the "
             "material is left out\n");
  EXPECT_HAS(said, "s:2: ");
}

}  // namespace
}  // namespace ardee
