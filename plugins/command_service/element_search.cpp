#include "plugins/command_service/element_search.h"

#include "plugins/structure/structure_overlay.h"

namespace runnel {

using internal::StructureOverlay;

Result<FrameworkElement*> FindMeant(Runtime& runtime, std::string_view path) {
  const StructureOverlay structure(runtime);
  const auto found = structure.Find(path);
  if (found) return found;
  const auto port = structure.FindPort(path, StructureOverlay::End::kSends);
  if (port) return static_cast<FrameworkElement*>(*port);
  return found;
}

Result<Port*> FindMeantPort(Runtime& runtime, std::string_view path) {
  const StructureOverlay structure(runtime);
  const auto output = structure.FindPort(path, StructureOverlay::End::kSends);
  if (output) return output;
  const auto input = structure.FindPort(path, StructureOverlay::End::kReceives);
  return input ? input : output;
}

PublicationCounts CountPublications(FrameworkElement& start) {
  PublicationCounts counts;
  start.Visit([&](FrameworkElement& element) {
    if (const auto* const port = dynamic_cast<const Port*>(&element)) {
      counts.emplace(port->path(), port->publications());
    }
  });
  return counts;
}

}  // namespace runnel
