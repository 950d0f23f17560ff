#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/paths/distant_ports.h"
#include "plugins/network/network_element.h"

namespace runnel {

/// "//camera_box/camera/image" as it is taken of the topic "/camera_box/camera/image".
///
/// The output that stands for it has the type that the other application tells. Where that is not there yet, a connection
/// of all of its values is made for those of the input's type, which most often is the same; one of a part, by a conversion,
/// or to an input that takes anything or has a unit, waits.
///
/// Threads: under the structure lock.
class NetworkPorts final : public DistantPorts {
 public:
  explicit NetworkPorts(NetworkElement& network) : network_(&network) {}
  /// nullptr if another network has taken its place.
  [[nodiscard]] static NetworkPorts* Of(const NetworkElement& network);
  void End() noexcept { network_ = nullptr; }
  /// Tells what others offer; `expected`: the type that it is, if nothing speaks against it; optional.
  using FindType = std::function<DistantType(const std::string& path, const TypeInfo* expected)>;
  /// {}: there is nobody any more who could tell.
  void set_find_type(FindType find_type) { find_type_ = std::move(find_type); }

  [[nodiscard]] Port* Find(std::string_view path) const override;
  [[nodiscard]] DistantType TypeOf(std::string_view path) const override;
  Result<Port*> Make(std::string_view path, const Port& to, const ConnectOptions& options) override;

  /// For a connection that waits: makes the output if it is known by now of which type. Errors: why it cannot be.
  Result<void> MakeAwaited(const std::string& path);
  /// If the other application tells another type, or unit, than the output of the take has, and all its connections can be
  /// made of that, too: that one. `why_not`: set if they cannot.
  [[nodiscard]] std::optional<DistantType> OtherType(const NetworkElement::Take& take, std::string& why_not) const;
  /// Has an output of that type in place of the one that is there: its connections wait for that one from now on
  /// (LateConnections::LookAgain()). `gone`: the one of before, which the caller gives to Runtime::Destroy() in any case. In a
  /// ChangeScope, while nothing publishes there. Errors: there is none now, and the connections wait.
  Result<void> Renew(Port& output, const DistantType& type, UnlistedElement& gone);

 private:
  [[nodiscard]] DistantType Ask(const std::string& path, const TypeInfo* expected) const;
  [[nodiscard]] TakeOptions OptionsOf(const std::string& path) const;
  Result<Port*> MakeOutput(const std::string& path, const TypeInfo& type, const std::string& unit);

  NetworkElement* network_;
  FindType find_type_;
};

}  // namespace runnel
