// A plugin whose registration fails after it has added a tag.

#include <stdexcept>

#include "core/plugin/plugin_entry.h"
#include "plugins/application_files/xml_tag.h"

RUNNEL_PLUGIN(refused_plugin, registry) {
  auto* const tags = registry.Find<runnel::XmlTagRegistry>();
  if (tags != nullptr) tags->AddTag({.name = "ruin", .parents = {"application"}, .handle = {}});
  throw std::runtime_error("no licence");
}
