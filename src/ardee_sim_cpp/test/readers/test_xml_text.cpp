// SPDX-License-Identifier: MIT
// Tests that each text has one reading: encodings, declarations, names, and texts that are refused
// unread.
#include <array>

#include "fixture.h"

namespace ardee {
namespace {

class XmlText : public ReadersTest {
 protected:
  std::shared_ptr<const Model> load(const std::string& text) {
    return loader_.load_model_text(text, "t.xml");
  }
  std::string link_name(const std::string& text) { return load(text)->links.at(0).name; }
  std::string error(const std::string& text) {
    return error_of([&] { load(text); });
  }
};

const std::string kRobot = "<robot name='r'><link name='a'/></robot>";

TEST_F(XmlText, NamesAreTheSameWhereverTheyStand) {
  const auto joined = [this](const std::string& name, const std::string& elsewhere) {
    return load("<robot name='r'><link name='" + name + "'/><link name='z'/><joint name='" + name +
                "' type='fixed'><parent link='" + elsewhere + "'/><child link='z'/></joint>" +
                "<gazebo reference='" + elsewhere +
                "'><selfCollide>1</selfCollide></gazebo></robot>");
  };
  using Spellings = std::array<const char*, 3>;
  for (const auto& [name, elsewhere, read] :
       std::vector<Spellings>{{" a", "a", "a"},
                              {"a ", " a", "a"},
                              {"a&b", "a&b", "a&b"},
                              {"a&amp;b", "a&b", "a&b"},
                              {"a\r\nb", "a\nb", "a\nb"},
                              {"&#233;", "\xC3\xA9", "\xC3\xA9"},
                              {"&lt;a", "&#60;a", "<a"},
                              {"a  b", "a  b", "a  b"},
                              {"a\tb", "a&#9;b", "a\tb"}}) {
    const auto model = joined(name, elsewhere);
    EXPECT_EQ(model->canonical_link, read);
    EXPECT_EQ(model->joints.at(0).name, read);
    EXPECT_EQ(model->joints.at(0).parent, read);
    EXPECT_TRUE(model->links.at(0).self_collide);
  }
  EXPECT_TRUE(warnings_->empty());
  for (const std::string blank : {"", " ", "\n", "&#32;"}) {
    EXPECT_HAS(error("<robot name='r'><link name='" + blank + "'/></robot>"),
               "t.xml:1: <link>: found no attribute 'name', expected one");
  }
  EXPECT_HAS(error("<robot name='r'><link name=' a'/><link name='a '/></robot>"),
             "found a second link 'a', expected unique names");
}

TEST_F(XmlText, EncodingsAreConverted) {
  const std::string declared = "<?xml version='1.0' encoding='ISO-8859-1'?>";
  EXPECT_EQ(link_name(declared + "<robot name='r'><link name='\xE9'/></robot>"), "\xC3\xA9");
  EXPECT_EQ(link_name(declared + "<robot name='r'><link name='&#233;'/></robot>"), "\xC3\xA9");
  EXPECT_EQ(link_name("\xEF\xBB\xBF<?xml version='1.0' encoding='UTF-8'?>" + kRobot), "a");
  // Plain ASCII is the same in any declared encoding.
  EXPECT_EQ(link_name("<?xml version='1.0' encoding='utf-16'?>" + kRobot), "a");
  EXPECT_EQ(link_name("<?xml version='1.0' encoding='latin-99'?>" + kRobot), "a");
  std::string little, big;
  for (const char c : kRobot) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const std::string& text :
       std::vector<std::string>{little, big, "\xFF\xFE" + little, "\xFE\xFF" + big}) {
    EXPECT_EQ(link_name(text), "a");
  }
}

TEST_F(XmlText, AnEncodingThatIsUnknownOrDoesNotFitIsRefused) {
  EXPECT_HAS(error("<?xml version='1.0' encoding='latin-99'?><robot name='\xE9'/>"),
             "t.xml: found encoding 'latin-99', expected UTF-8 or one that is known");
  EXPECT_HAS(error("<?xml version='1.0' encoding='us-ascii'?><robot name='\xE9'/>"),
             "found bytes that are no us-ascii");
  EXPECT_HAS(error("\xFF\xFE<"), "found bytes that are no UTF-16");
  EXPECT_HAS(error(std::string("<robot name='r'>\n\0<link name='a'/></robot>", 38)),
             "t.xml:2: found a NUL byte, expected text");
}

TEST_F(XmlText, InstructionsAndADeclarationMayStandAnywhere) {
  for (const std::string& text : std::vector<std::string>{
           "<!-- first -->\n<?xml version='1.0'?>" + kRobot, "\n\n <?xml version='1.0'?>" + kRobot,
           "<?xml version='1.0'?><!DOCTYPE robot SYSTEM \"it's>.dtd\">" + kRobot + "<!-- last -->",
           "<?xml-model href='x'?>" + kRobot + "<?end?>",
           "<robot name='r'><?inside?><link name='a'/></robot>",
           "<robot name='r'><!--><?x --><link name='a'/></robot>"}) {
    EXPECT_EQ(link_name(text), "a") << text;
  }
  EXPECT_HAS(error("<?one\ntwo?>\n<robot name='r'/>"), "t.xml:3: <robot>: found no <link>");
}

TEST_F(XmlText, ACommentOrTextDeclaresNothing) {
  const std::string entity = "<!ENTITY rows SYSTEM \"rows.xml\">";
  EXPECT_EQ(link_name("<!-- " + entity + " -->" + kRobot), "a");
  EXPECT_EQ(link_name("<robot name='r'><![CDATA[" + entity + "]]><link name='a'/></robot>"), "a");
  for (const std::string& real : std::vector<std::string>{"<!DOCTYPE robot [" + entity + "]>",
                                                          "<!DOCTYPE robot [\n<!ELEMENT a (b)>\n]>",
                                                          "<!--> -->" + entity, entity}) {
    EXPECT_HAS(error(real + kRobot),
               "t.xml:1: found a declaration of an entity, element or the like");
  }
}

TEST_F(XmlText, ASecondRootIsRefused) {
  EXPECT_HAS(error(kRobot + "\n<robot/>"), "t.xml:2: found more beside the root element");
  EXPECT_HAS(error(kRobot + kRobot), "t.xml:1: found more beside the root element");
  EXPECT_NE(error(kRobot + "rest"), "");
  EXPECT_NE(error("rest" + kRobot), "");
}

TEST_F(XmlText, WhatLooksLikeMarkupInAnAttributeIsText) {
  EXPECT_EQ(link_name("<robot name='/>'><link name=\">\" type='<?x?>'/></robot>"), ">");
  std::string deep;
  for (int i = 0; i < 1000; ++i) deep += "<a b='/>'>";
  EXPECT_HAS(error(deep), "deep, expected fewer");
}

TEST_F(XmlText, SdfIsReadAlike) {
  const auto model = load(
      "<!-- <!ENTITY x 'y'> -->\n<?xml version='1.0'?><sdf version='1.6'><model name=' m '>"
      "<link name='a&b'/><link name='z'/><joint name='j' type='fixed'><parent>\n a&amp;b "
      "\n</parent>"
      "<child><![CDATA[z]]></child></joint></model></sdf>");
  EXPECT_EQ(model->name, "m");
  EXPECT_EQ(model->joints.at(0).parent, "a&b");
  EXPECT_EQ(model->joints.at(0).child, "z");
}

}  // namespace
}  // namespace ardee
