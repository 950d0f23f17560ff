#pragma once

#include <string>
#include <string_view>

#include "core/element/annotation.h"
#include "core/element/runtime.h"
#include "core/port/port.h"

namespace runnel {

/// Ports of other applications, "//camera_box/camera/image", as this one has them: outputs that are made when something is
/// first connected to them. Whoever reaches other applications keeps one with the root of the tree.
///
/// Threads: under the structure lock.
class DistantPorts : public Annotation {
 public:
  /// nullptr if nobody reaches other applications.
  [[nodiscard]] static DistantPorts* FindIn(const FrameworkElement& any) {
    return any.runtime().root().FindAnnotation<DistantPorts>();
  }

  /// nullptr: nothing has been connected to it.
  [[nodiscard]] virtual Port* Find(std::string_view path) const = 0;
  /// For values of the type of `to`. Errors: there is one for values of another type; why it cannot be.
  virtual Result<Port*> Make(std::string_view path, const Port& to) = 0;
};

/// Kept with each of them: its path, for files.
struct DistantPort final : Annotation {
  explicit DistantPort(std::string of) : path(std::move(of)) {}
  const std::string path;
};

[[nodiscard]] inline bool IsDistantPath(std::string_view path) { return path.starts_with("//"); }

/// Makes the port of another application, unless it is there or the path is none of such a port. Errors: as Make(); there is
/// nobody who could.
Result<void> BringDistantPort(std::string_view path, const Port& to);

}  // namespace runnel
