// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/collada_fans.h"

#include <tinyxml2.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "ardee_sim/core/error.h"

namespace ardee {
namespace {

using tinyxml2::XMLElement;

/// Number of indices of a corner.
std::size_t stride_of(const XMLElement& fans) {
  unsigned last = 0;
  for (const auto* input = fans.FirstChildElement("input"); input != nullptr;
       input = input->NextSiblingElement("input")) {
    last = std::max(last, input->UnsignedAttribute("offset", 0));
  }
  return std::size_t{last} + 1;
}

/// Appends the triangles of one fan: its first corner with each pair of consecutive corners.
std::size_t add_triangles(const std::string& fan, std::size_t stride, std::string& triangles) {
  std::istringstream stream(fan);
  std::vector<std::string> corners;
  std::size_t read = 0;
  for (std::string index; stream >> index; ++read) {
    if (read % stride == 0) corners.emplace_back();
    corners.back() += index + ' ';
  }
  std::size_t count = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k, ++count) {
    triangles += corners[0] + corners[k] + corners[k + 1];
  }
  return count;
}

void convert(XMLElement& fans) {
  const std::size_t stride = stride_of(fans);
  std::string triangles;
  std::size_t count = 0;
  while (XMLElement* fan = fans.FirstChildElement("p")) {
    count += add_triangles(fan->GetText() != nullptr ? fan->GetText() : "", stride, triangles);
    fans.DeleteChild(fan);
  }
  fans.SetName("triangles");
  fans.SetAttribute("count", static_cast<unsigned>(count));
  fans.InsertNewChildElement("p")->SetText(triangles.c_str());
}

void convert_all(XMLElement& element) {
  for (XMLElement* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (std::string(child->Name()) == "trifans") {
      convert(*child);
    } else {
      convert_all(*child);
    }
  }
}

}  // namespace

std::string fans_to_triangles(const std::string& collada, const std::string& name) {
  tinyxml2::XMLDocument document;
  if (document.Parse(collada.data(), collada.size()) != tinyxml2::XML_SUCCESS) {
    throw Error(Source{name, document.ErrorLineNum(), ""},
                std::string("found ") + document.ErrorStr() + ", expected well-formed XML");
  }
  convert_all(*document.RootElement());
  tinyxml2::XMLPrinter printer(nullptr, true);
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace ardee
