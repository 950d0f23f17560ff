#pragma once

#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/runtime.h"
#include "core/paths/path_search.h"

namespace runnel::internal {

/// A preview of the structure as it will be when the changes so far have been made: what is still beside the tree is
/// found in its place, what will go is not found. Nothing is changed.
///
/// Threads:  under the structure lock.
class StructureOverlay final : public PathSearch {
 public:
  explicit StructureOverlay(Runtime& runtime) : PathSearch(runtime), runtime_(runtime) {}

  /// Where an element called by the last part of `path` would go. Errors: a bad or taken name, no
  /// parent.
  Result<Placement> PlaceFor(std::string_view path) const;

  void Add(FrameworkElement& element);
  void Remove(FrameworkElement& element);
  /// `element` stands in the place of `gone` from now on, and its ports in that of the others. Errors: this closes a cycle of
  /// interface ports.
  Result<void> Replace(FrameworkElement& gone, FrameworkElement& element, const std::vector<std::pair<Port*, Port*>>& ports);

  /// Errors: what Port::Connect() and Disconnect() would say.
  Result<void> Connect(Port& from, Port& to, const ConnectOptions& options);
  Result<void> Disconnect(Port& from, Port& to);

  [[nodiscard]] bool HasSource(const Port& port) const;
  /// From and to the port; of those of a composite, if `module` is one, not what is within it.
  [[nodiscard]] std::vector<std::pair<Port*, Port*>> EdgesOf(Port& port, const FrameworkElement* module = nullptr) const;
  /// Likewise. Who only probes the port does not count: a recorder can do without.
  [[nodiscard]] bool IsConnected(const Port& port, const FrameworkElement* module) const;

 private:
  using Edge = std::pair<Port*, Port*>;

  [[nodiscard]] FrameworkElement* Child(const FrameworkElement& parent,
                                        std::string_view name) const override;
  [[nodiscard]] std::vector<FrameworkElement*> Children(
      const FrameworkElement& parent) const override;
  [[nodiscard]] bool IsGone(const FrameworkElement& element) const;
  [[nodiscard]] std::vector<Port*> Targets(const Port& from) const;
  [[nodiscard]] Port& NowFor(Port& port) const;
  [[nodiscard]] bool IsInCycle(const Port& port) const;
  [[nodiscard]] bool Reaches(const Port& from, const Port& to) const;

  Runtime& runtime_;
  std::vector<FrameworkElement*> added_;
  std::vector<FrameworkElement*> removed_;
  std::map<const Port*, Port*> replaced_;  // a port, and that which stands in its place
  std::vector<const FrameworkElement*> composites_;  // that have been replaced, with what is connected within
  std::vector<Edge> connected_;
  std::vector<Edge> disconnected_;
};

}  // namespace runnel::internal
