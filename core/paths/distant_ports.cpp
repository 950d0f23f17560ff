#include "core/paths/distant_ports.h"

#include <utility>

namespace runnel {

const std::string& DistantPathOf(const Port& port) {
  static const std::string none;
  const auto* const distant = port.FindAnnotation<DistantPort>();
  return distant != nullptr ? distant->path : none;
}

PortPathPart SplitPortPath(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  const std::size_t begin = slash == std::string_view::npos ? 0 : slash + 1;
  const std::size_t end = path.find_first_of(".[", begin + 1);
  if (end == std::string_view::npos) return {std::string(path), {}};
  return {std::string(path.substr(0, end)), std::string(path.substr(path[end] == '.' ? end + 1 : end))};
}

Result<void> BringDistantPort(std::string_view path, const Port& to, ConnectOptions options) {
  if (!IsDistantPath(path)) return {};
  DistantPorts* const ports = DistantPorts::FindIn(to);
  if (ports == nullptr) {
    return Error{.message = "'" + std::string(path) + "' is a port of another application, and this one has no network",
                 .hint = "add <network/> to the application, and to the other one what it offers"};
  }
  PortPathPart split = SplitPortPath(path);
  if (!split.part.empty()) options.part = std::move(split.part);
  const auto made = ports->Make(split.path, to, options);
  return made ? Result<void>() : made.error();
}

}  // namespace runnel
