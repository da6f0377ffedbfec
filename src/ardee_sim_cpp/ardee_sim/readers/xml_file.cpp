// SPDX-License-Identifier: MIT
#include <algorithm>

#include "ardee_sim/readers/text_file.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
constexpr std::size_t kMaxDepth = 90;  // below tinyxml2's own limit of 100

/// XML_ERROR_MISMATCHED_ELEMENT -> mismatched element
std::string in_words(std::string name) {
  constexpr std::string_view kPrefix = "XML_ERROR_";
  if (name.rfind(kPrefix, 0) == 0) name.erase(0, kPrefix.size());
  std::replace(name.begin(), name.end(), '_', ' ');
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// The position after what starts at `at`: a comment, CDATA section, declaration or tag; `step`
/// says how it nests.
std::size_t skip_markup(std::string_view text, std::size_t at, int& step) {
  const auto after = [&](std::string_view end) {
    const std::size_t found = text.find(end, at);
    return found == std::string_view::npos ? text.size() : found + end.size();
  };
  step = 0;
  if (text.substr(at, 4) == "<!--") return after("-->");
  if (text.substr(at, 9) == "<![CDATA[") return after("]]>");
  if (text.substr(at, 2) == "<?") return after("?>");
  const std::size_t end = after(">");
  if (text.substr(at, 2) == "</") {
    step = -1;
  } else if (text.substr(at, 2) != "<!" && !(end >= 2 && text[end - 2] == '/')) {
    step = 1;
  }
  return end;
}

}  // namespace

std::size_t xml_depth(std::string_view text) {
  std::ptrdiff_t depth = 0;
  std::ptrdiff_t deepest = 0;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
    int step = 0;
    at = skip_markup(text, at, step);
    depth += step;
    deepest = std::max(deepest, depth);
  }
  return static_cast<std::size_t>(deepest);
}

void check_xml_text(std::string_view text, const std::string& name) {
  const std::size_t entity = text.find("<!ENTITY");
  if (entity != std::string_view::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(entity), '\n');
    throw Error(Source{name, static_cast<int>(line), ""},
                "found an entity declaration, expected none");
  }
  const std::size_t depth = xml_depth(text);
  if (depth > kMaxDepth) {
    throw Error(Source{name, 0, ""}, "found elements nested " + std::to_string(depth) +
                                         " deep, expected at most " + std::to_string(kMaxDepth));
  }
}

XmlFile::XmlFile(const std::string& text, const std::string& name) : name_(name) {
  check_xml_text(text, name);
  if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw Error(
        Source{name, document_.ErrorLineNum(), ""},
        "found broken XML (" + in_words(document_.ErrorName()) + "), expected well-formed XML");
  }
  if (!document_.RootElement()) {
    throw Error(Source{name, 0, ""}, "found no element, expected an XML document");
  }
}

XmlFile XmlFile::read(const std::string& path, const Source& source) {
  return XmlFile(read_text_file(path, source, kMaxFileBytes), path);
}

}  // namespace ardee
