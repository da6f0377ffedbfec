// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/element_file.h"

#include "ardee_sim/readers/xml.h"

namespace ardee {

Element read_element_file(const std::string& path, const Source& source) {
  return XmlFile::read(path, source).root().to_element();
}

}  // namespace ardee
