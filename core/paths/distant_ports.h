#pragma once

#include <string>
#include <string_view>

#include "core/element/annotation.h"
#include "core/element/runtime.h"
#include "core/port/port.h"

namespace runnel {

/// What is told of the values of a port of another application.
struct DistantType {
  const TypeInfo* type = nullptr;  ///< nullptr: it is not known here
  std::string unit = {};           ///< of numbers; "" if nobody said
  std::string why_not = {};        ///< it is not known
};

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

  /// Without a part. nullptr: nothing has been connected to it.
  [[nodiscard]] virtual Port* Find(std::string_view path) const = 0;
  /// Of a port without a part, whether anything has been connected to it or not.
  [[nodiscard]] virtual DistantType TypeOf(std::string_view path) const = 0;
  /// For what is to be connected to `to` in that way. nullptr: which type its values have will be told by the other
  /// application only, and a connection to it has to wait (LateConnections). Errors: why it cannot be.
  virtual Result<Port*> Make(std::string_view path, const Port& to, const ConnectOptions& options) = 0;
};

/// Kept with each of them: its path, for files.
struct DistantPort final : Annotation {
  explicit DistantPort(std::string of) : path(std::move(of)) {}
  const std::string path;
};

/// "//camera_box/camera/image" if the port is one of them; else "".
[[nodiscard]] const std::string& DistantPathOf(const Port& port);

[[nodiscard]] inline bool IsDistantPath(std::string_view path) { return path.starts_with("//"); }

/// A path without the part of the values that is meant, as far as that can be told when the port is not there.
struct PortPathPart {
  std::string path;
  std::string part;
};
[[nodiscard]] PortPathPart SplitPortPath(std::string_view path);

/// Makes the port of another application, unless it is there, the path is none of such a port, or has to be waited for: see
/// DistantPorts::Make(), also for errors; there is nobody who could. `path`: may end with a part of the values.
Result<void> BringDistantPort(std::string_view path, const Port& to, ConnectOptions options);

}  // namespace runnel
