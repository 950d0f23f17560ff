#pragma once

#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/runtime.h"
#include "core/paths/late_connections.h"
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
  Result<void> Replace(FrameworkElement& gone, FrameworkElement& element,
                       const std::vector<std::pair<Port*, Port*>>& ports);

  /// Errors: what Port::Connect() and Disconnect() would say.
  Result<void> Connect(Port& from, Port& to, const ConnectOptions& options);
  /// `stays_cut`: once its ends are there again, too.
  Result<void> Disconnect(Port& from, Port& to, bool stays_cut);

  /// What waits by then, and what is connected since it waited.
  [[nodiscard]] const std::vector<LateConnection>& late() const { return Late(); }
  [[nodiscard]] const LateConnection* FindLate(std::string_view from, std::string_view to) const;
  /// By paths of which one is not there yet, or not any more.
  void ConnectLate(const std::string& from, const std::string& to, const ConnectOptions& options);
  /// False: there is no such connection.
  bool DisconnectLate(std::string_view from, std::string_view to);

  [[nodiscard]] bool HasSource(const Port& port) const;
  /// From and to the port, with the options that they have by then; of those of a composite, if `module` is one, not what is within it.
  [[nodiscard]] std::vector<Connection> EdgesOf(Port& port, const FrameworkElement* module = nullptr) const;
  /// Likewise. Who only probes the port does not count: a recorder can do without.
  [[nodiscard]] bool IsConnected(const Port& port, const FrameworkElement* module) const;

  [[nodiscard]] std::vector<FrameworkElement*> Children(const FrameworkElement& parent) const override;

 private:
  [[nodiscard]] FrameworkElement* Child(const FrameworkElement& parent, std::string_view name) const override;
  [[nodiscard]] bool IsGone(const FrameworkElement& element) const;
  [[nodiscard]] std::vector<Connection> Targets(Port& from) const;
  [[nodiscard]] Port& NowFor(Port& port) const;
  [[nodiscard]] std::vector<LateConnection>& Late() const;
  [[nodiscard]] bool IsInCycle(Port& port) const;
  [[nodiscard]] bool Reaches(Port& from, const Port& to) const;

  Runtime& runtime_;
  std::vector<FrameworkElement*> added_;
  std::vector<FrameworkElement*> removed_;
  std::map<const FrameworkElement*, FrameworkElement*> successors_;
  std::map<const Port*, Port*> replaced_;            // a port, and that which stands in its place
  std::vector<const FrameworkElement*> composites_;  // that have been replaced, with what is connected within
  std::vector<Connection> connected_;
  std::vector<Connection> disconnected_;
  mutable std::optional<std::vector<LateConnection>> late_;  // copied when it is first asked for, under the lock
};

}  // namespace runnel::internal
