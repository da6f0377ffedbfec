// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/material_script.h"

#include <vector>

#include "ardee_sim/description/parameters.h"

namespace ardee {
namespace {

struct Token {
  std::string text;
  int line;
};

/// Words, quoted strings and braces, comments left out.
std::vector<Token> tokens_of(const std::string& text) {
  std::vector<Token> tokens;
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    std::size_t end = at + 1;
    if (c == '\n') {
      ++line;
    } else if (text.compare(at, 2, "//") == 0) {
      end = std::min(text.find('\n', at), text.size());
    } else if (text.compare(at, 2, "/*") == 0) {
      const std::size_t close = text.find("*/", at + 2);
      end = close == std::string::npos ? text.size() : close + 2;
      for (std::size_t i = at; i < end; ++i) line += text[i] == '\n';
    } else if (c == '"') {
      end = std::min(text.find_first_of("\"\n", at + 1), text.size());
      tokens.push_back({text.substr(at + 1, end - at - 1), line});
      if (end < text.size() && text[end] == '"') ++end;
    } else if (c == '{' || c == '}') {
      tokens.push_back({std::string(1, c), line});
    } else if (!std::isspace(static_cast<unsigned char>(c))) {
      end = std::min(text.find_first_of(" \t\r\n{}", at), text.size());
      tokens.push_back({text.substr(at, end - at), line});
    }
    at = end;
  }
  return tokens;
}

class ScriptReader {
 public:
  ScriptReader(const std::string& text, const std::string& name, Log& log,
               const MaterialScript& known)
      : name_(name), tokens_(tokens_of(text)), log_(log), known_(known) {}

  MaterialScript read() {
    while (at_ < tokens_.size()) {
      std::vector<Token> words = statement();
      if (!opens()) continue;
      // Materials that serve as parents.
      if (!words.empty() && words[0].text == "abstract") words.erase(words.begin());
      if (!words.empty() && words[0].text == "material") {
        material_or_warning(words);
      } else {
        skip_block();
      }
    }
    return std::move(materials_);
  }

 private:
  /// The words of one line up to a brace, which stays.
  std::vector<Token> statement() {
    std::vector<Token> words;
    while (at_ < tokens_.size() && tokens_[at_].text != "{" && tokens_[at_].text != "}") {
      if (!words.empty() && tokens_[at_].line != words[0].line) break;
      words.push_back(tokens_[at_++]);
    }
    if (words.empty() && at_ < tokens_.size() && tokens_[at_].text == "}") ++at_;
    return words;
  }

  bool opens() const { return at_ < tokens_.size() && tokens_[at_].text == "{"; }
  bool closes() const { return at_ < tokens_.size() && tokens_[at_].text == "}"; }

  Error unfinished(int line) const {
    return Error(Source{name_, line, ""}, "found a block without end, expected '}'");
  }

  void skip_block() {
    const int line = tokens_[at_].line;
    int depth = 0;
    do {
      if (at_ >= tokens_.size()) throw unfinished(line);
      if (tokens_[at_].text == "{") ++depth;
      if (tokens_[at_].text == "}") --depth;
      ++at_;
    } while (depth > 0);
  }

  /// Reads one material; an error in it does not affect the others.
  void material_or_warning(const std::vector<Token>& words) {
    const std::size_t begin = at_;
    try {
      material(words);
    } catch (const Error& problem) {
      if (at_ == tokens_.size()) throw;  // the script ends within it
      at_ = begin;
      skip_block();
      log_.warn(std::string(problem.what()) + "; the material is left out");
    }
  }

  void material(const std::vector<Token>& words) {
    if (words.size() < 2) {
      throw Error(Source{name_, words[0].line, ""}, "found 'material', expected a name after it");
    }
    std::string material_name = words[1].text;
    Material made;  // white, OGRE's default: a texture keeps its own colours
    made.ambient = made.diffuse = Color::Ones();
    for (std::size_t i = 2; i + 1 < words.size(); ++i) {
      if (words[i].text == ":") made = parent(words[i + 1].text, words[0].line);
    }
    made.name = material_name;
    techniques_ = 0;
    block("material", made);
    materials_[material_name] = made;
  }

  Material parent(const std::string& parent_name, int line) const {
    for (const MaterialScript* script : {&materials_, &known_, &gazebo_materials()}) {
      const auto found = script->find(parent_name);
      if (found != script->end()) return found->second;
    }
    throw Error(Source{name_, line, ""},
                "found parent material '" + parent_name + "', expected one defined before");
  }

  /// Reads from '{' to the '}' that belongs to it.
  void block(const std::string& kind, Material& made) {
    const int line = tokens_[at_++].line;
    int passes = 0;
    int units = 0;
    while (!closes()) {
      if (at_ >= tokens_.size()) throw unfinished(line);
      const std::vector<Token> words = statement();
      const std::string key = words.empty() ? "" : words[0].text;
      if (opens()) {
        const bool wanted = (kind == "material" && key == "technique" && techniques_++ == 0) ||
                            (kind == "technique" && key == "pass" && passes++ == 0) ||
                            (kind == "pass" && key == "texture_unit" && units++ == 0);
        wanted ? block(key, made) : skip_block();
      } else if (kind == "pass") {
        pass_attribute(words, made);
      } else if (kind == "texture_unit" && key == "texture" && words.size() > 1) {
        made.texture_path = words[1].text;
      }
    }
    ++at_;
  }

  void pass_attribute(const std::vector<Token>& words, Material& made) const {
    const std::string& key = words[0].text;
    if (key == "ambient") set_color(words, made.ambient);
    if (key == "diffuse") set_color(words, made.diffuse);
    if (key == "specular") set_color(words, made.specular);
    if (key == "emissive") set_color(words, made.emissive);
    if (key == "cull_hardware" && words.size() > 1) made.two_sided = words[1].text == "none";
    if (key == "alpha_rejection" && words.size() > 2) {
      const double threshold = number(words[2]);
      const bool greater = words[1].text == "greater" || words[1].text == "greater_equal";
      made.alpha_rejection = greater ? static_cast<float>(threshold / 255.0) : -1.0f;
    }
  }

  double number(const Token& word) const {
    return parse_number(word.text, Source{name_, word.line, ""});
  }

  /// r g b [a] [shininess]; "vertexcolour" and the like are skipped.
  void set_color(const std::vector<Token>& words, Color& color) const {
    if (words.size() < 4) return;
    for (int i = 0; i < 3; ++i) {
      color[i] = static_cast<float>(number(words[static_cast<std::size_t>(i) + 1]));
    }
    const bool specular = words[0].text == "specular";
    if (words.size() > (specular ? 5u : 4u)) color[3] = static_cast<float>(number(words[4]));
    color = color.cwiseMax(0.0f).cwiseMin(1.0f);
  }

  std::string name_;
  std::vector<Token> tokens_;
  Log& log_;
  const MaterialScript& known_;
  MaterialScript materials_;
  std::size_t at_ = 0;
  int techniques_ = 0;
};

}  // namespace

MaterialScript parse_material_script(const std::string& text, const std::string& name, Log& log,
                                     const MaterialScript& known) {
  return ScriptReader(text, name, log, known).read();
}

}  // namespace ardee
