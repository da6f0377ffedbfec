// SPDX-License-Identifier: MIT
#include <sstream>

#include "ardee_sim/description/bounds.h"
#include "ardee_sim/readers/schema.h"
#include "ardee_sim/tools/support_markdown.h"

namespace ardee {
namespace {

std::string in_code(const std::string& words) {
  std::istringstream stream(words);
  std::string all;
  for (std::string word; stream >> word;) all += (all.empty() ? "`" : " `") + word + "`";
  return all;
}

/// "a|b" as `a` or `b`.
std::string alternatives(std::string text) {
  for (std::size_t bar; (bar = text.find('|')) != std::string::npos;) {
    text.replace(bar, 1, "` or `");
  }
  return "`" + text + "`";
}

/// A note whose <elements> show in Markdown.
std::string with_code(const std::string& note) {
  std::string text;
  bool inside = false;
  for (std::size_t i = 0; i < note.size(); ++i) {
    if (note[i] == '<' && !inside) text += '`';
    inside = note[i] == '<' || (inside && note[i] != ' ');
    text += note[i];
    const bool goes_on = i + 1 < note.size() && note[i + 1] == '<';
    if (note[i] == '>' && !goes_on) {
      text += '`';
      inside = false;
    }
  }
  return text;
}

std::string outcome(const SchemaRow& row) {
  const std::string note = with_code(row.note);
  switch (row.treatment) {
    case Treatment::kActs:
      return note.empty() ? "acts" : "acts: " + note;
    case Treatment::kSettled:
      return "nothing to do: " + note;
    case Treatment::kNoEffect:
      return "warning" + (*row.harmless ? " unless " + alternatives(row.harmless) : "") + ": " +
             note;
    case Treatment::kElsewhere:
      break;
  }
  return note;
}

void write_table(const Schema& schema, std::ostringstream& page) {
  page << "| in | elements and @attributes | what becomes of them |\n|---|---|---|\n";
  for (const SchemaRow& row : schema.rows()) {
    page << "| `" << row.place << "` | " << in_code(row.names) << " | " << outcome(row) << " |\n";
  }
  page << "\n";
}

struct BoundedNumbers {
  const char* names;
  bounds::Range range;
};

constexpr BoundedNumbers kBounded[] = {
    {"friction/torsional/coefficient", bounds::kFriction},
    {"slip1 slip2", bounds::kSlip},
    {"kp", bounds::kStiffness},
    {"kd", bounds::kDamping},
    {"max_vel", bounds::kMaxVelocity},
    {"min_depth", bounds::kMinDepth},
    {"patch_radius surface_radius", bounds::kRadius_m},
    {"restitution_coefficient", bounds::kRestitution},
    {"bounce/threshold", bounds::kBounceThreshold},
    {"velocity_decay/linear velocity_decay/angular", bounds::kDecay},
    {"dynamics/damping dynamics/friction spring_stiffness", bounds::kJointCoefficient},
    {"spring_reference", bounds::kJointReference},
    {"joint/physics/ode/limit/cfm joint/physics/ode/limit/erp", bounds::kJointSoftness},
    {"max_step_size", bounds::kStep_s},
    {"iters", bounds::kIterations},
    {"sor", bounds::kRelaxation},
    {"constraints/cfm", bounds::kCfm},
    {"constraints/erp", bounds::kErp},
    {"contact_max_correcting_vel", bounds::kCorrectingVelocity},
    {"contact_surface_layer", bounds::kSurfaceLayer_m},
};

void write_bounds(std::ostringstream& page) {
  page << "### Numbers that are refused\n\nBesides what is not a number: sizes and scales "
          "that are not above zero, and others than these. SI units.\n\n"
          "| number | from | to |\n|---|---|---|\n";
  for (const auto& [names, range] : kBounded) {
    page << "| " << in_code(names) << " | " << range.low << " | " << range.high << " |\n";
  }
  page << "\n";
}

}  // namespace

std::string elements_in_markdown() {
  std::ostringstream page;
  page << "## SDF\n\nVersions 1.2 to 1.12. Where a name means two things, the column on the left "
          "says which: `joint/physics` is the\n`<physics>` of a joint. What is within an element "
          "that has no effect has none either.\n\n";
  write_table(sdf_schema(), page);
  write_bounds(page);
  page << "## URDF\n\n";
  write_table(urdf_schema(), page);
  page << "## `<gazebo>` blocks of a URDF\n\nOf a link, a joint, or (without `reference`) of the "
          "robot. What SDF has as well is as there.\n\n";
  write_table(gazebo_schema(), page);
  return page.str();
}

}  // namespace ardee
