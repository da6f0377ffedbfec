// SPDX-License-Identifier: MIT
#include <algorithm>

#include "ardee_sim/core/text_file.h"
#include "ardee_sim/readers/limits.h"
#include "ardee_sim/readers/xml.h"
#include "ardee_sim/readers/xml_text.h"

namespace ardee {
namespace {

/// XML_ERROR_MISMATCHED_ELEMENT -> mismatched element
std::string in_words(std::string name) {
  constexpr std::string_view kPrefix = "XML_ERROR_";
  if (name.rfind(kPrefix, 0) == 0) name.erase(0, kPrefix.size());
  std::replace(name.begin(), name.end(), '_', ' ');
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

}  // namespace

XmlFile::XmlFile(const std::string& text, const std::string& name) : name_(name) {
  const std::string plain = plain_xml(text, name);
  if (document_.Parse(plain.data(), plain.size()) != tinyxml2::XML_SUCCESS) {
    throw Error(
        Source{name, document_.ErrorLineNum(), ""},
        "found broken XML (" + in_words(document_.ErrorName()) + "), expected well-formed XML");
  }
  const tinyxml2::XMLElement* root = document_.RootElement();
  if (!root) throw Error(Source{name, 0, ""}, "found no element, expected an XML document");
  for (const auto* node = document_.FirstChild(); node; node = node->NextSibling()) {
    if (node == root || node->ToComment()) continue;
    throw Error(Source{name, node->GetLineNum(), ""},
                "found more beside the root element, expected nothing but comments");
  }
}

XmlFile XmlFile::read(const std::string& path, const Source& source) {
  return XmlFile(read_text_file(path, source, kMaxXmlBytes), path);
}

}  // namespace ardee
