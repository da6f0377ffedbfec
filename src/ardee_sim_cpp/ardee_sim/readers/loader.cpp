// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/loader.h"

#include "ardee_sim/core/text_file.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/limits.h"
#include "ardee_sim/readers/sdf_reader.h"
#include "ardee_sim/readers/urdf.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace ardee {
namespace {

std::string read_description(const std::string& path) {
  return read_text_file(path, Source{path, 0, ""}, kMaxXmlBytes);
}

/// Returns the memory of a large parsed document to the system; the C library would keep it.
void release_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

bool is_sdf(const Node& root) { return root.name() == "sdf" || root.name() == "gazebo"; }

}  // namespace

struct Loader::Impl {
  Impl(ResourceLocator locator, Log given_log, BadParts bad_parts)
      : log(std::move(given_log)), assets(std::move(locator), log, bad_parts), sdf(assets) {}

  World read_world(const XmlFile& document);
  std::shared_ptr<const Model> read_model(const XmlFile& document);

  Log log;
  Assets assets;
  SdfReader sdf;
};

Loader::Loader(ResourceLocator locator, Log log, BadParts bad_parts)
    : impl_(std::make_unique<Impl>(std::move(locator), std::move(log), bad_parts)) {}
Loader::~Loader() = default;
Loader::Loader(Loader&&) noexcept = default;

World Loader::Impl::read_world(const XmlFile& document) {
  assets.begin();
  const Node root = document.root();
  if (!is_sdf(root)) throw root.error("found this root element, expected <sdf> with a <world>");
  return sdf.read_world(root);
}

std::shared_ptr<const Model> Loader::Impl::read_model(const XmlFile& document) {
  assets.begin();
  const Node root = document.root();
  if (is_sdf(root)) return sdf.read_model(root);
  if (root.name() == "robot") return read_urdf(root, assets);
  throw root.error("found this root element, expected <sdf> or <robot>");
}

World Loader::load_world(const std::string& path) {
  const LogGroup group(impl_->log);
  World world = impl_->read_world(XmlFile::read(path, Source{path, 0, ""}));
  release_free_memory();
  return world;
}

World Loader::load_world_text(const std::string& xml, const std::string& name) {
  const LogGroup group(impl_->log);
  return impl_->read_world(XmlFile(xml, name));
}

std::shared_ptr<const Model> Loader::load_model(const std::string& path) {
  return load_model_text(read_description(path), path);
}

std::shared_ptr<const Model> Loader::load_model_text(const std::string& xml,
                                                     const std::string& name) {
  const LogGroup group(impl_->log);
  return impl_->read_model(XmlFile(xml, name));
}

std::variant<std::shared_ptr<const Model>, Light> Loader::load_model_or_light_text(
    const std::string& xml, const std::string& name) {
  const LogGroup group(impl_->log);
  const XmlFile document(xml, name);
  const Node root = document.root();
  if (is_sdf(root) && root.child("light") && !root.child("model")) {
    return impl_->sdf.read_light(root);
  }
  return impl_->read_model(document);
}

}  // namespace ardee
