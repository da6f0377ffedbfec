// SPDX-License-Identifier: MIT
#include "fuzz/mutator.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <random>
#include <vector>

namespace ardee::fuzz {
namespace {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

constexpr std::size_t kMostChanges = 3;

/// Values at the limits of numbers and of derived sizes, and words with a meaning.
constexpr std::array kValues = {"",
                                " ",
                                "0",
                                "-0",
                                "1",
                                "-1",
                                "2",
                                "0.5",
                                "3.141592653589793",
                                "1e-320",
                                "1e-12",
                                "1e-6",
                                "100000",
                                "1e9",
                                "1e10",
                                "1e15",
                                "1e30",
                                "-1e30",
                                "1e308",
                                "1e309",
                                "nan",
                                "inf",
                                "-inf",
                                "2147483647",
                                "2147483648",
                                "-2147483648",
                                "4294967296",
                                "9223372036854775808",
                                "18446744073709551616",
                                "99999999999999999999999999999999",
                                "0x10",
                                "1,5",
                                "true",
                                "false",
                                "world",
                                "__model__",
                                "..",
                                "0 0 0",
                                "0 0 1",
                                "1 2 3 4 5 6 7"};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  std::size_t below(std::size_t count) { return engine_() % count; }
  template <typename Items>
  const typename Items::value_type& one_of(const Items& items) {
    return items[below(items.size())];
  }

 private:
  std::minstd_rand engine_;
};

std::vector<std::string>& words() {
  static std::vector<std::string> all;
  return all;
}

/// Returns the value with one of its parts, or all of it, replaced.
std::string changed_value(const std::string& value, Random& random) {
  const char* made = random.one_of(kValues);
  const std::string spaces = " \t\r\n,;:/";
  const std::size_t at = value.empty() ? 0 : random.below(value.size());
  const std::size_t begin = value.find_last_of(spaces, at) + 1;  // npos + 1 is 0
  const std::size_t end = std::min(value.find_first_of(spaces, begin), value.size());
  switch (random.below(5)) {
    case 0:
      return made;
    case 1:  // one part less
      return value.substr(0, begin) + value.substr(end);
    case 2:  // one part more
      return value.substr(0, begin) + made + " " + value.substr(begin);
    case 3:  // the other sign
      return value.substr(0, begin) + "-" + value.substr(begin);
    default:
      return value.substr(0, begin) + made + value.substr(end);
  }
}

/// Changes the elements of a document and their values.
class XmlMutator {
 public:
  XmlMutator(XMLDocument& document, Random& random) : document_(document), random_(random) {
    collect(*document_.RootElement());
  }

  /// Makes one change; it may remove elements, so a mutator makes no second one.
  void mutate() {
    XMLElement& element = *random_.one_of(elements_);
    switch (random_.below(12)) {
      case 0:
        return remove(element);
      case 1:
        return add(clone(element), parent_of(element));
      case 2:
        return add(clone(element), random_.one_of(elements_));
      case 3:
        return move(element, *random_.one_of(elements_));
      case 4:
        return add(new_element(), &element);
      case 5:
        return element.SetName(any_name().c_str());
      case 6:
        return copy_value(element, *random_.one_of(elements_));
      case 7:
        return change_attribute(element);
      default:
        return change_value(element);
    }
  }

  XMLElement& any_element() { return *random_.one_of(elements_); }
  void take(const XMLElement& of_another) {
    any_element().InsertEndChild(of_another.DeepClone(&document_));
  }

 private:
  void collect(XMLElement& element) {
    elements_.push_back(&element);
    for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
      collect(*child);
    }
  }

  /// Returns the parent; the root is its own, because a text has one root.
  tinyxml2::XMLNode* parent_of(XMLElement& element) {
    return &element == document_.RootElement() ? &element : element.Parent();
  }

  tinyxml2::XMLNode* clone(const XMLElement& element) { return element.DeepClone(&document_); }

  void add(tinyxml2::XMLNode* made, tinyxml2::XMLNode* parent) {
    if (random_.below(2) == 0) {
      parent->InsertFirstChild(made);
    } else {
      parent->InsertEndChild(made);
    }
  }

  void remove(XMLElement& element) {
    if (&element != document_.RootElement()) document_.DeleteNode(&element);
  }

  void move(XMLElement& element, XMLElement& parent) {
    if (&element == document_.RootElement()) return;
    for (const tinyxml2::XMLNode* at = &parent; at; at = at->Parent()) {
      if (at == &element) return;
    }
    add(&element, &parent);
  }

  std::string any_name() {
    if (words().empty() || random_.below(2) == 0) return any_element().Name();
    return random_.one_of(words());
  }

  XMLElement* new_element() {
    XMLElement* made = document_.NewElement(any_name().c_str());
    made->SetText(random_.one_of(kValues));
    return made;
  }

  void copy_value(XMLElement& to, const XMLElement& from) {
    if (from.GetText()) to.SetText(std::string(from.GetText()).c_str());
  }

  void change_value(XMLElement& element) {
    if (element.FirstChildElement()) return change_attribute(element);
    const char* text = element.GetText();
    element.SetText(changed_value(text ? text : "", random_).c_str());
  }

  /// Removes or changes an attribute; an element without attributes gets one.
  void change_attribute(XMLElement& element) {
    std::vector<std::string> names;
    for (const auto* a = element.FirstAttribute(); a; a = a->Next()) names.push_back(a->Name());
    if (names.empty()) return element.SetAttribute("name", random_.one_of(kValues));
    const std::string& name = random_.one_of(names);
    if (random_.below(4) == 0) return element.DeleteAttribute(name.c_str());
    const std::string value = element.Attribute(name.c_str());
    element.SetAttribute(name.c_str(), changed_value(value, random_).c_str());
  }

  XMLDocument& document_;
  Random& random_;
  std::vector<XMLElement*> elements_;
};

/// Returns the start of the XML, which may follow a letter that names a format.
std::size_t xml_begin(const std::string& input) { return std::min(input.find('<'), input.size()); }

bool parse(const std::string& input, XMLDocument& document) {
  const std::size_t begin = xml_begin(input);
  return document.Parse(input.data() + begin, input.size() - begin) == tinyxml2::XML_SUCCESS &&
         document.RootElement();
}

/// Returns the document as text; empty if it is too long.
std::string print(const XMLDocument& document, const std::string& prefix, std::size_t most) {
  tinyxml2::XMLPrinter printer(nullptr, true);
  document.Print(&printer);
  const std::string text = prefix + printer.CStr();
  return text.size() <= most ? text : "";
}

std::string mutate_xml(XMLDocument& document, const std::string& prefix, std::size_t most,
                       Random& random) {
  for (std::size_t changes = 1 + random.below(kMostChanges); changes > 0; --changes) {
    XmlMutator(document, random).mutate();
  }
  return print(document, prefix, most);
}

std::string mutate_lines(const std::string& input, Random& random) {
  const std::size_t at = random.below(input.size());
  const std::size_t begin = input.rfind('\n', at) + 1;  // npos + 1 is 0
  const std::size_t end = std::min(input.find('\n', begin), input.size());
  const std::string line = input.substr(begin, end - begin);
  const std::string before = input.substr(0, begin);
  const std::string after = input.substr(end);
  switch (random.below(6)) {
    case 0:
      return before + after;
    case 1:
      return before + line + "\n" + line + after;
    case 2:
      return input + "\n" + line;
    default:
      return before + changed_value(line, random) + after;
  }
}

bool is_text(const std::string& input) {
  return !input.empty() && std::all_of(input.begin(), input.end(), [](unsigned char c) {
    return c >= 0x20 || c == '\n' || c == '\r' || c == '\t';
  });
}

}  // namespace

void read_words(const std::string& dictionary_path) {
  std::ifstream stream(dictionary_path);
  for (std::string line; std::getline(stream, line);) {
    const bool is_word = line.size() > 2 && line.front() == '"' && line.back() == '"';
    if (is_word) words().push_back(line.substr(1, line.size() - 2));
  }
}

std::string mutate_text(const std::string& input, std::size_t most, unsigned seed) {
  Random random(seed);
  XMLDocument document;
  if (parse(input, document)) {
    return mutate_xml(document, input.substr(0, xml_begin(input)), most, random);
  }
  if (!is_text(input)) return "";
  const std::string made = mutate_lines(input, random);
  return made.size() <= most ? made : "";
}

std::string cross_xml(const std::string& input, const std::string& other, std::size_t most,
                      unsigned seed) {
  Random random(seed);
  XMLDocument document;
  XMLDocument source;
  if (!parse(input, document) || !parse(other, source)) return "";
  XmlMutator(document, random).take(XmlMutator(source, random).any_element());
  return print(document, input.substr(0, xml_begin(input)), most);
}

}  // namespace ardee::fuzz
