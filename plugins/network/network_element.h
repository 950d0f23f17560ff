#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/element/framework_element.h"
#include "core/element/unlisted_element.h"
#include "core/log/logger.h"
#include "core/port/port.h"
#include "plugins/network/network_options.h"
#include "plugins/network_discovery/value_form.h"
#include "plugins/ros_services/taken_service.h"

namespace runnel {

/// The group "network" of an application that has a <network>: what the file says of it, and below it, by their topics,
/// an output for each that values are taken of.
///
/// Threads: under the structure lock.
class NetworkElement final : public FrameworkElement {
 public:
  explicit NetworkElement(const Placement& placement, NetworkOptions options);
  ~NetworkElement() override;
  /// nullptr if the application has none.
  [[nodiscard]] static NetworkElement* FindIn(const FrameworkElement& application);

  [[nodiscard]] const NetworkOptions& options() const noexcept { return options_; }
  [[nodiscard]] Logger& log() noexcept { return log_; }

  void AddOffer(OfferOptions offer);
  void set_offers(std::vector<OfferOptions> offers);
  /// Errors: the values of the port come from the network, so that they are no offer of this application.
  Result<void> CheckIsOwn(const Port& port) const;
  /// Before the link starts.
  void set_ros(RosOptions ros) { options_.ros = std::move(ros); }
  void set_security(WireSecurity security) { options_.member.security = std::move(security); }

  struct Take {
    TakeOptions options;
    Port* output;
    std::shared_ptr<const ValueForm> form;
    bool is_over = false;  ///< the output is to make room for one of another type
  };
  [[nodiscard]] const std::vector<Take>& takes() const noexcept { return takes_; }
  /// The output of the topic, for values of this type; made if there is none. Errors: there is one of another type; a
  /// type that only its module can make values of; what cannot be read as such messages; it is taken in another way, and
  /// something is connected to it; simulated time, if that is known and the options do not allow for it.
  Result<Port*> AddTake(const TakeOptions& take, const TypeInfo& type, const std::string& unit = {});
  /// Of an output without connections: it is found no more, and the network's thread drops it. Nothing of what is not taken.
  void GiveUp(const Port& output);
  /// The topic of that output is taken no more; its connections are cut. Returns the output, for Runtime::Destroy(). In a
  /// ChangeScope, while nothing publishes there. Errors: of Runtime::Unlist(); it is taken still then.
  Result<UnlistedElement> DropTake(Port& output);
  /// Errors: simulated time, if that is known and the options do not allow for it.
  Result<void> CheckLiveness(const TakeOptions& take) const;

  struct ServiceTake {
    ServiceTakeOptions options;
    Port* output;
    std::string path;  ///< of the output
    std::shared_ptr<DistantService> service;
  };
  [[nodiscard]] const std::vector<ServiceTake>& service_takes() const noexcept { return service_takes_; }
  void AddServiceOffer(ServiceOfferOptions offer);
  /// The same ones in the same order; their ports may have other paths now.
  void set_services(std::vector<ServiceOfferOptions> services);
  /// The output that stands for the service elsewhere, of the type of the client's port; made if there is none. Errors: there is
  /// one of another type; what is no client; what does not fit.
  Result<Port*> AddServiceTake(const ServiceTakeOptions& take, const Port& client);

  /// Those that may be taken back, the last one last.
  [[nodiscard]] std::vector<OfferRenaming>& renamings() noexcept { return renamings_; }

  /// Makes all types known that modules here have ports of.
  void set_know_types(std::function<void()> know_types) { know_types_ = std::move(know_types); }
  [[nodiscard]] const std::function<void()>& know_types() const noexcept { return know_types_; }

  /// Time is simulated, so that what comes when it likes has to be meant.
  void set_simulated() { is_simulated_ = true; }

  /// Who is told that there is more to offer or to take.
  void set_on_change(std::function<void()> on_change) { on_change_ = std::move(on_change); }
  /// Who is told that what was at this path, and below it, has another one now.
  void set_on_renamed(std::function<void(const std::string& from)> on_renamed) { on_renamed_ = std::move(on_renamed); }
  void NoteRenamed(const std::string& from) const {
    if (on_renamed_) on_renamed_(from);
  }

 private:
  /// An output of this type below the groups that the name says; where one of these has a name that is taken, of one with "_"
  /// behind it. `finish`: while nobody can find it.
  Result<Port*> MakeOutput(
      const std::string& name, const TypeInfo& type, const std::string& unit,
      const std::function<void(Port&)>& finish = [](Port&) {});
  [[nodiscard]] Result<std::shared_ptr<const ValueForm>> ValueFormOf(const TakeOptions& take,
                                                                     const TypeInfo& type) const;
  Result<void> TakeOtherwise(Take& known, const TakeOptions& take);

  NetworkOptions options_;
  std::vector<Take> takes_;
  std::vector<ServiceTake> service_takes_;
  std::vector<OfferRenaming> renamings_;
  std::function<void()> on_change_;
  std::function<void(const std::string& from)> on_renamed_;
  std::function<void()> know_types_;
  bool is_simulated_ = false;
  Logger log_{*this};
};

}  // namespace runnel
