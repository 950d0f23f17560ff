#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/element/configurable.h"
#include "core/element/runtime.h"
#include "core/port/port.h"

namespace runnel {

/// As what a path is followed: decides which groups may be left out in it, and which of two ports of one
/// name is meant.
enum class PathKind {
  kElement,    ///< anything
  kOutput,     ///< a port that can send
  kInput,      ///< a port that can receive
  kParameter,  ///< anything; in a module, what can be set
};

/// What came of following a path.
struct PathEnd {
  FrameworkElement* found = nullptr;         ///< nullptr: there is no such element
  FrameworkElement* at = nullptr;            ///< the last element on the way that is there
  std::string missing = {};                  ///< the first name that is not there; "" if all are
  std::vector<std::string> candidates = {};  ///< what `at` has instead
  Error error = {};                          ///< if nothing was found; its path is that of `at`
};

/// A port, and which part of its values is meant: "x", "ranges[0]"; "" for all of them (value_part.h).
struct PortPart {
  Port* port = nullptr;
  std::string part = {};
};

/// Finds what people name by paths, in files, on command lines, in browsers and in code. In all of them
///
///     robot/laser    begins at the base, ".." being the parent; with a '/' in front at the root
///     laser/scan     is short for laser/output/scan or laser/input/scan,
///     guard/speed    for guard/parameter/speed
///     laser/scan     from the root: also /application/laser/scan, if there is one application only
///
/// Threads: under the structure lock.
class PathSearch {
 public:
  /// From the root; the name of the only application may be left out.
  explicit PathSearch(Runtime& runtime) : base_(runtime.root()), may_leave_out_application_(true) {}
  /// From `base`.
  explicit PathSearch(FrameworkElement& base) : base_(base), may_leave_out_application_(false) {}
  virtual ~PathSearch() = default;
  PathSearch(const PathSearch&) = delete;
  PathSearch& operator=(const PathSearch&) = delete;

  [[nodiscard]] PathEnd Follow(std::string_view path, PathKind kind) const;

  /// Errors: which name is not there, and the nearest.
  [[nodiscard]] Result<FrameworkElement*> Find(std::string_view path, PathKind kind = PathKind::kElement) const;
  /// As an input, a parameter is the input by which it is fed (Configurable::Feed()).
  /// Errors: besides, that it is no port; that two ports fit. If none fits the kind, one that does not is
  /// found: connecting says why not.
  [[nodiscard]] Result<Port*> FindPort(std::string_view path, PathKind kind) const;
  /// The same for "world/pose.x" and "laser/scan.ranges[0]", too. Names may have dots and brackets: of two ways
  /// to understand a path, the one with the longer name counts. Whether there is such a part is not looked at.
  [[nodiscard]] Result<PortPart> FindPortPart(std::string_view path, PathKind kind) const;

 protected:
  /// What the search sees of the tree.
  [[nodiscard]] virtual FrameworkElement* Child(const FrameworkElement& parent, std::string_view name) const;
  [[nodiscard]] virtual std::vector<FrameworkElement*> Children(const FrameworkElement& parent) const;
  /// nullptr if there are none, or several.
  [[nodiscard]] FrameworkElement* OnlyApplication() const;

 private:
  [[nodiscard]] PathEnd FollowFrom(FrameworkElement& start, std::string_view path, PathKind kind) const;
  [[nodiscard]] PathEnd FollowShort(FrameworkElement& module, std::string_view name, PathKind kind) const;

  FrameworkElement& base_;
  const bool may_leave_out_application_;
};

/// Something that can be set, as an element and as what sets it.
struct ConfigurableElement {
  FrameworkElement* element = nullptr;
  Configurable* configurable = nullptr;

  explicit operator bool() const noexcept { return configurable != nullptr; }
};

/// What can be set of a module: what is directly below it or in one of its groups.
[[nodiscard]] std::vector<ConfigurableElement> ConfigurablesOf(const FrameworkElement& module);
[[nodiscard]] ConfigurableElement FindConfigurable(const FrameworkElement& module, std::string_view name);

/// The ports of a module, or of the interface of a group: directly below it or in one of its groups.
[[nodiscard]] std::vector<Port*> PortsOf(const FrameworkElement& module);

/// The path by which the port is found again, even after what it is part of has been made anew: of the input by
/// which a parameter is fed, that of the parameter; else its own.
[[nodiscard]] const std::string& LastingPath(const Port& port);

/// `name`, or with a number behind it, such that nothing in `parent` is called so.
[[nodiscard]] std::string FreeName(const FrameworkElement& parent, const std::string& name);

}  // namespace runnel
