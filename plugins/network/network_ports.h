#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/paths/distant_ports.h"
#include "plugins/network/network_element.h"
#include "plugins/network_discovery/distant_type.h"

namespace runnel {

/// "//camera_box/camera/image" as it is taken of the topic "/camera_box/camera/image".
///
/// The output that stands for it has the type that the other application tells. Where that is not there yet, a connection
/// of all of its values is made for those of the input's type, which most often is the same; one of a part, by a conversion,
/// or to an input that takes anything or has a unit, waits. Messages of ROS 2 become values of the input's type, if they can.
/// An output that nobody is connected to any more stays, and makes room for one of another type if that is wanted.
///
/// Threads: under the structure lock.
class NetworkPorts final : public DistantPorts {
 public:
  explicit NetworkPorts(NetworkElement& network) : network_(&network) {}
  /// nullptr if another network has taken its place.
  [[nodiscard]] static NetworkPorts* Of(const NetworkElement& network);
  void End() noexcept { network_ = nullptr; }
  /// Tells what others offer; `expected`: the type that it is, if nothing speaks against it; optional.
  using FindType = std::function<OfferedType(const std::string& path, const TypeInfo* expected)>;
  /// {}: there is nobody any more who could tell.
  void set_find_type(FindType find_type) { find_type_ = std::move(find_type); }

  [[nodiscard]] Port* Find(std::string_view path) const override;
  [[nodiscard]] DistantType TypeOf(std::string_view path) const override;
  Result<Port*> Make(std::string_view path, const Port& to, const ConnectOptions& options) override;

  /// For a connection that waits: makes the output if it is known by now of which type. Errors: why it cannot be.
  Result<void> MakeAwaited(const std::string& path);
  /// If the other application tells another type, or unit, than the output of the take has, and all its connections can be
  /// made of that, too: that one; also if it is to make room (NetworkElement::Take::is_over), of no type then. `why_not`: set
  /// if they cannot.
  [[nodiscard]] std::optional<OfferedType> OtherType(const NetworkElement::Take& take, std::string& why_not) const;
  /// Has an output of that type in place of the one that is there: its connections wait for that one from now on
  /// (LateConnections::LookAgain()). `gone`: the one of before, which the caller gives to Runtime::Destroy() in any case. In a
  /// ChangeScope, while nothing publishes there. Errors: there is none now, and the connections wait.
  Result<void> Renew(Port& output, const OfferedType& type, UnlistedElement& gone);

 private:
  [[nodiscard]] const NetworkElement::Take* FindTake(std::string_view path) const;
  [[nodiscard]] OfferedType Ask(const std::string& path, const TypeInfo* expected) const;
  [[nodiscard]] TakeOptions OptionsOf(const std::string& path) const;
  Result<Port*> MakeOutput(const std::string& path, const OfferedType& offered);

  NetworkElement* network_;
  FindType find_type_;
};

}  // namespace runnel
