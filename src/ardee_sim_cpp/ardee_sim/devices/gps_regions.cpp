// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/gps_regions.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/core/text_file.h"
#include "ardee_sim/readers/element_file.h"

namespace ardee::devices {
namespace {

constexpr double kBelowGround_m = 2.0;  // greatest depth of ground in a plot below its centre

constexpr const char* kBands = "field_gps_noise_characteristics";
constexpr const char* kHeightBand = "biomass_height_noise_coefficient";
constexpr const char* kDensityBand = "biomass_density_noise_coefficient";
constexpr const char* kPlot = "plot";
constexpr const char* kBox = "periodic_noise_box";

bool is_part(const std::string& name) { return name == kBands || name == kPlot || name == kBox; }

double required(Parameters& parameters, const char* key, double low, double high) {
  parameters.required_text(key);
  return parameters.number(key, 0.0, low, high);
}

double side(Parameters& parameters, const char* key) {
  const double length_m = required(parameters, key, 0.0, limits::kFarthest_m);
  if (length_m == 0.0) throw parameters.error(key, "expected more than 0 m");
  return length_m;
}

GpsNoise noise_of(const NoiseBands& bands, double value) {
  const GpsNoise* found = bands.find(value);
  return found ? *found : GpsNoise{};
}

}  // namespace

/// Contents of files and plugins, before the bands are known for all plots.
struct GpsRegions::Parts {
  struct Plot {
    GpsRegion region;
    Source source;
    double height_m = 0.0;
    double density_per_m2 = 0.0;
  };

  NoiseBands height_bands;
  NoiseBands density_bands;
  bool has_bands = false;
  std::vector<Plot> plots;
  std::vector<GpsRegion> boxes;

  void add_bands(const Element& element, Log& log) {
    has_bands = true;
    for (const Element& band : element.children) {
      if (band.name == kHeightBand) {
        height_bands.add(band, log);
      } else if (band.name == kDensityBand) {
        density_bands.add(band, log);
      } else {
        throw Error(band.source, std::string("found <") + band.name + ">, expected " + kHeightBand +
                                     " or " + kDensityBand);
      }
    }
  }

  void add_plot(const Element& element, Log& log) {
    Parameters parameters(element);
    Plot plot;
    plot.region.name = "plot " + parameters.required_text("plot_id");
    plot.source = element.source;
    const auto place = [&](const char* key) {
      return required(parameters, key, -limits::kFarthest_m, limits::kFarthest_m);
    };
    const Eigen::Vector3d middle{place("x"), place("y"), place("z")};
    const double turn_rad = place("rotation");
    parameters.required_text("row_count");
    const int rows = parameters.integer("row_count", 1, 1, 1000000);
    const double row_width_m = side(parameters, "row_width");
    const double row_length_m = side(parameters, "row_length");
    plot.height_m = required(parameters, "average_height", 0.0, 100.0);
    plot.density_per_m2 = parameters.number("average_density", 0.0, 0.0);
    parameters.ignore({"plot_range_index", "plot_crossrange_index"});
    parameters.finish(log);
    // An antenna above the crop sees the sky.
    plot.region.size_m = {row_length_m, rows * row_width_m, plot.height_m + kBelowGround_m};
    plot.region.pose.p = middle + Eigen::Vector3d(0.0, 0.0, (plot.height_m - kBelowGround_m) / 2.0);
    plot.region.pose.q = quaternion_from_rpy({0.0, 0.0, turn_rad});
    plots.push_back(plot);
  }

  void add_box(const Element& element, Log& log) {
    Parameters parameters(element);
    const auto place = [&](const char* key) {
      return required(parameters, key, -limits::kFarthest_m, limits::kFarthest_m);
    };
    GpsRegion box;
    box.name = "box " + std::to_string(boxes.size());
    box.pose.p = {place("cx"), place("cy"), place("cz")};
    box.pose.q = quaternion_from_rpy({0.0, 0.0, place("rot")});
    for (int axis = 0; axis < 3; ++axis) {
      static constexpr const char* kSides[] = {"w", "l", "h"};
      box.size_m[axis] = side(parameters, kSides[axis]);
    }
    PeriodicNoise noise;
    noise.period_s = required(parameters, "nps", 1e-3, limits::kAbsurd);
    noise.mean_mean = required(parameters, "nmpm", -limits::kAbsurd, limits::kAbsurd);
    noise.mean_variance = required(parameters, "nmpv", 0.0, limits::kAbsurd);
    noise.variance_mean = required(parameters, "nvpm", 0.0, limits::kAbsurd);
    noise.variance_variance = required(parameters, "nvpv", 0.0, limits::kAbsurd);
    parameters.finish(log);
    box.periodic = noise;
    boxes.push_back(box);
  }

  /// An id denotes one plot of its file; each field has its own numbering.
  void add_all(const Element& parent, Log& log) {
    std::map<std::string, int> ids;  // with their lines
    for (const Element& child : parent.children) {
      if (child.name == kBands) add_bands(child, log);
      if (child.name == kPlot) {
        add_plot(child, log);
        const Element& id = *child.child("plot_id");
        const auto [first, is_new] = ids.emplace(id.text, id.source.line);
        if (!is_new) {
          throw Error(id.source, "found '" + id.text + "' again, expected an id of its own: line " +
                                     std::to_string(first->second) + " has it");
        }
      }
      if (child.name == kBox) add_box(child, log);
    }
  }

  /// `source` is the place that names the file.
  void add_file(const std::string& path, const Source& source, Log& log) {
    const Element root = read_element_file(path, source);
    if (root.children.empty()) {
      throw Error(root.source, std::string("found nothing in it, expected ") + kBands + ", " +
                                   kPlot + " or " + kBox);
    }
    add_root(root, log);
  }

  void add_root(const Element& root, Log& log) {
    for (const Element& child : root.children) {
      if (!is_part(child.name)) {
        throw Error(child.source, "found <" + child.name + ">, expected " + kBands + ", " + kPlot +
                                      " or " + kBox);
      }
    }
    add_all(root, log);
  }

  void add_plots_file(const std::string& path, const Source& source, Log& log) {
    const std::size_t before = plots.size() + boxes.size();
    add_file(path, source, log);
    if (plots.size() + boxes.size() == before) {
      throw Error(Source{path, 0, ""}, std::string("found no <") + kPlot + "> and no <" + kBox +
                                           ">, expected one or more");
    }
  }

  /// A field without a plot is open sky.
  void add_plots_beside(const std::vector<std::string>& scenery_files, const Source& source,
                        Log& log) {
    std::set<std::string> folders;
    for (const std::string& file : scenery_files) {
      if (!file.empty()) folders.insert(folder_of(file));
    }
    for (const std::string& folder : folders) {
      const std::string path = (std::filesystem::path(folder) / "plots.xacro").string();
      std::error_code error;
      if (std::filesystem::is_regular_file(path, error)) {
        add_root(read_element_file(path, source), log);
      }
    }
  }

  void add_default_bands(const ResourceLocator& locator, const Source& source, Log& log) {
    std::string path;
    try {
      path = locator.resolve("file://custom_gps_behavior.geofence", source);
    } catch (const Error&) {
      path = locator.resolve("file://default_gps_behavior.geofence", source);
    }
    add_file(path, source, log);
  }

  /// Warns in one message: a field has hundreds of similar plots.
  void warn_outside(const NoiseBands& bands, const char* band, double Plot::*quantity,
                    const char* unit, Log& log) const {
    constexpr std::size_t kMostNamed = 3;
    std::vector<const Plot*> outside;
    for (const Plot& plot : plots) {
      if (!bands.find(plot.*quantity)) outside.push_back(&plot);
    }
    if (outside.empty()) return;
    std::ostringstream text;
    text << outside.front()->source.to_string() << ": found ";
    for (std::size_t i = 0; i < std::min(outside.size(), kMostNamed); ++i) {
      text << (i > 0 ? ", " : "") << outside[i]->region.name << " of " << (*outside[i]).*quantity
           << " " << unit;
    }
    if (outside.size() > kMostNamed) text << " and " << outside.size() - kMostNamed << " more";
    text << " in no <" << band << ">, expected a band for it; "
         << (density_bands.empty() ? "the noise is the open sky's there"
                                   : "it adds no noise there");
    log.warn(text.str());
  }

  /// Bands of density are optional.
  void warn_of_plots_in_no_band(Log& log) const {
    if (!height_bands.empty() || density_bands.empty()) {
      warn_outside(height_bands, kHeightBand, &Plot::height_m, "m", log);
    }
    if (!density_bands.empty()) {
      warn_outside(density_bands, kDensityBand, &Plot::density_per_m2, "plants/m2", log);
    }
  }
};

GpsRegions::GpsRegions(const Element& plugin, const std::vector<std::string>& scenery_files,
                       const ResourceLocator& locator, Log& log) {
  Parts parts;
  parts.add_all(plugin, log);
  if (const Element* named = plugin.child("geofenceFile")) {
    parts.add_file(locator.resolve(named->text, named->source), named->source, log);
  }
  if (const Element* named = plugin.child("plotsFile")) {
    parts.add_plots_file(locator.resolve(named->text, named->source), named->source, log);
  }
  if (parts.plots.empty() && !plugin.child("plotsFile")) {
    parts.add_plots_beside(scenery_files, plugin.source, log);
  }
  if (!parts.plots.empty() && !parts.has_bands) {
    parts.add_default_bands(locator, plugin.source, log);
  }
  parts.warn_of_plots_in_no_band(log);
  regions_ = std::move(parts.boxes);
  for (Parts::Plot& plot : parts.plots) {
    plot.region.noise = combined(noise_of(parts.height_bands, plot.height_m),
                                 noise_of(parts.density_bands, plot.density_per_m2));
    regions_.push_back(plot.region);
  }
}

const GpsRegion* GpsRegions::find(const Eigen::Vector3d& point_W) const {
  for (const GpsRegion& region : regions_) {
    if (region.contains(point_W)) return &region;
  }
  return nullptr;
}

}  // namespace ardee::devices
